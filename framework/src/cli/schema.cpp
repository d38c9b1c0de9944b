// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo schema`: the shape of a case file for editors.
#include "case/json_schema.hpp"
#include "case/plugin_paths.hpp"
#include "cli/command.hpp"

#include <fmt/core.h>

#include <memory>

namespace periporo::cli {

void add_schema_command(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("schema", "Print the JSON schema of case files, for completion and checks in an editor");
    const auto folders = std::make_shared<std::vector<std::filesystem::path>>();
    add_plugin_path(*command, *folders);
    command->footer("Example:\n  periporo schema > periporo.schema.json\n\n"
                    "An editor that knows TOML takes it from a first line like this in the case:\n"
                    "  #:schema ./periporo.schema.json");
    command->callback([folders, &action] {
        action = [folders] {
            PluginRegistry registry;
            registry.load_folders(plugin_search_path(*folders, {}));
            fmt::print("{}\n", json_schema(case_rules(), registry).dump(2));
            return ExitStatus::done;
        };
    });
}

} // namespace periporo::cli
