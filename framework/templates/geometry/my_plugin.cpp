// The plugin geometry "my_plugin".
#include "my_plugin.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::geometry, lab::MyPlugin, "my_plugin", "A ball")
