// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Names of the plugin kinds.
#include "periporo/plugin.hpp"

namespace periporo {

const char* kind_name(PluginKind kind)
{
    switch (kind) {
    case PluginKind::geometry:
        return "geometry";
    case PluginKind::material:
        return "material";
    case PluginKind::contact:
        return "contact";
    case PluginKind::retention:
        return "retention";
    case PluginKind::output:
        return "output";
    }
    return "unknown kind"; // a descriptor of another version may hold any number
}

} // namespace periporo
