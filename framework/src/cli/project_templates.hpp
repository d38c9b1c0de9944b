// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The projects that `periporo new` writes, kept in the program. Each folder framework/templates/<kind> is such a
// project, of a plugin that is called my_plugin.
#pragma once

#include <span>
#include <string_view>

namespace periporo::cli {

/// One file of the project of one kind of plugin.
struct ProjectTemplate {
    std::string_view kind; ///< "material", ...
    std::string_view file; ///< its name, "my_plugin_test.cpp"
    std::string_view text;
};

/// The files of all kinds. Defined in a source that the build makes from framework/templates.
std::span<const ProjectTemplate> project_templates();

} // namespace periporo::cli
