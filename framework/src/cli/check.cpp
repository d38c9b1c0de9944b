// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo check CASE`: every error of a case at once.
#include "cli/command.hpp"
#include "scheduler/run.hpp"

#include <fmt/core.h>

#include <memory>
#include <unistd.h>

namespace periporo::cli {

void add_check_command(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("check", "Build what a run would build and report what is wrong; run and write nothing");
    const auto arguments = std::make_shared<CaseArguments>();
    add_case_arguments(*command, *arguments);
    command->footer("Example:\n  periporo check my_case.toml --set discretization.spacing=\"5 mm\"\n\n"
                    "Exit status 0 when the case is sound, 2 when it is not.");
    command->callback([arguments, &action] {
        action = [arguments] {
            PluginRegistry registry;
            const CaseDescription description = read_case_loudly(*arguments, registry);
            for (const std::string& warning : check_case(description, registry, isatty(STDERR_FILENO) == 0))
                fmt::print(stderr, "{}", warning);
            fmt::print("{}: no errors\n", arguments->file.string());
            return ExitStatus::done;
        };
    });
}

} // namespace periporo::cli
