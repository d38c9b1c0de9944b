// The plugin contact "my_plugin".
#include "my_plugin.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::contact, lab::MyPlugin, "my_plugin", "Linear spring and dashpot between points")
