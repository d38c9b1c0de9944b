// The plugin material "my_plugin".
#include "my_plugin.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::LawMaterial<lab::MyPlugin>, "my_plugin",
                "Elastic, with viscous flow beyond a yield stress")
