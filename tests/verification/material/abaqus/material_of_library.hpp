// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials made of the routines in this folder.
#pragma once

#include "periporo/material_point.hpp"
#include "support/plugins.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace periporo::test {

using Values = std::map<std::string, ParameterValue>;

/// The shared library that was built of one source of this folder.
inline std::string routine_library(const std::string& name)
{
    return (std::filesystem::path(PERIPORO_TEST_ROUTINES) / (name + ".so")).string();
}

/// The material "abaqus_user_material" with a library of this folder; `given` may replace anything.
inline std::unique_ptr<Material> material_of_library(const std::string& name, const std::string& interface,
                                                     Values given)
{
    given.merge(Values{{"library", routine_library(name)},
                       {"interface", interface},
                       {"properties", std::vector<double>{}},
                       {"state_variables", std::int64_t{0}},
                       {"bulk_modulus", 20e6},
                       {"shear_modulus", 10e6}});
    return built_plugins().make_material("abaqus_user_material",
                                         parameters_of(PluginKind::material, "abaqus_user_material", given));
}

} // namespace periporo::test
