// The plugin retention "my_plugin".
#include "my_plugin.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::retention, lab::MyPlugin, "my_plugin",
                "Retention curve after Brooks and Corey, without residual water")
