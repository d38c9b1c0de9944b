// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo schema`: the shape of a case file for editors.
#include "case/json_schema.hpp"
#include "case/plugin_paths.hpp"
#include "cli/commands.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace periporo::cli {

ExitStatus print_schema(const SchemaArguments& arguments)
{
    PluginRegistry registry;
    registry.load_folders(plugin_search_path(arguments.plugin_folders, {}));
    fmt::print("{}\n", json_schema(case_rules(), registry).dump(2));
    return ExitStatus::done;
}

} // namespace periporo::cli
