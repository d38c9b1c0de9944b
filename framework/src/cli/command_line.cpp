// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Arguments that several commands share.
#include "cli/command.hpp"

#include <fmt/core.h>

#include <cstdio>

namespace periporo::cli {
namespace {

/// An option that may be repeated and takes one text each time, so that it never swallows the case file.
template <class Member>
CLI::Option* add_repeatable(CLI::App& command, const std::string& name, std::vector<Member>& values,
                            const std::string& documentation)
{
    return command.add_option(name, values, documentation)->type_size(1)->allow_extra_args(false)->take_all();
}

} // namespace

void add_plugin_path(CLI::App& command, std::vector<std::filesystem::path>& folders)
{
    add_repeatable(command, "--plugin-path", folders, "Folder of plugin libraries, searched first; may be repeated")
        ->type_name("DIR");
}

void add_case_arguments(CLI::App& command, CaseArguments& arguments)
{
    command.add_option("CASE", arguments.file, "The case file")->required()->type_name("FILE");
    add_repeatable(
        command, "--set", arguments.options.overrides,
        "Override a value of the case; may be repeated. Entries of lists go by name, stage.collapse.duration, "
        "or by number from 0, contact.0.friction")
        ->type_name("KEY=VALUE");
    add_plugin_path(command, arguments.options.command_line_plugins);
}

CaseDescription read_case_loudly(const CaseArguments& arguments, PluginRegistry& registry)
{
    CaseDescription description = read_case(arguments.file, arguments.options, registry);
    for (const std::string& warning : description.warnings)
        fmt::print(stderr, "{}\n", warning);
    return description;
}

} // namespace periporo::cli
