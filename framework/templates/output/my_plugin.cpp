// The plugin output "my_plugin".
#include "my_plugin.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::output, lab::MyPlugin, "my_plugin",
                "Where the highest point is, as comma-separated values")
