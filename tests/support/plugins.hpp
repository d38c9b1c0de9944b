// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugins of this build, as a case would get them.
#pragma once

#include "plugins/registry.hpp"

#include <map>
#include <string>
#include <utility>

namespace periporo::test {

/// All plugins of the build tree. A test that uses one depends on its target in CMake.
inline const PluginRegistry& built_plugins()
{
    static const PluginRegistry registry = [] {
        PluginRegistry loaded;
        loaded.load_folders({std::filesystem::path(PERIPORO_BUILD_DIR) / "lib" / "periporo"});
        return loaded;
    }();
    return registry;
}

/// The parameters of a plugin with its defaults, and `given` in their place.
inline Parameters parameters_of(PluginKind kind, const std::string& name,
                                const std::map<std::string, ParameterValue>& given)
{
    Parameters parameters;
    for (const Parameter& record : built_plugins().require(kind, name).parameters) {
        if (const auto value = given.find(record.name); value != given.end())
            parameters.set(record.name, value->second);
        else if (record.default_value)
            parameters.set(record.name, *record.default_value);
    }
    return parameters;
}

inline std::unique_ptr<Geometry> geometry(const std::string& name, const std::map<std::string, ParameterValue>& given)
{
    return built_plugins().make_geometry(name, parameters_of(PluginKind::geometry, name, given));
}

inline std::unique_ptr<OutputWriter> output(const std::string& name,
                                            const std::map<std::string, ParameterValue>& given = {})
{
    return built_plugins().make_output(name, parameters_of(PluginKind::output, name, given));
}

} // namespace periporo::test
