// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo explain CASE`: the case in plain words.
#include "cli/command.hpp"
#include "scheduler/run.hpp"

#include <fmt/core.h>

#include <memory>

namespace periporo::cli {

void add_explain_command(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("explain", "Say in plain words what a case is: points, stages, time step, memory");
    const auto arguments = std::make_shared<CaseArguments>();
    add_case_arguments(*command, *arguments);
    command->footer("Example:\n  periporo explain my_case.toml");
    command->callback([arguments, &action] {
        action = [arguments] {
            PluginRegistry registry;
            const CaseDescription description = read_case_loudly(*arguments, registry);
            fmt::print("{}\n", explain_case(description, registry));
            return ExitStatus::done;
        };
    });
}

} // namespace periporo::cli
