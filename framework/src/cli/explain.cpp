// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo explain CASE`: the case in plain words.
#include "preview/explain.hpp"
#include "cli/command.hpp"
#include "cli/threads.hpp"
#include "preview/set_up_picture.hpp"

#include <fmt/core.h>

#include <memory>

namespace periporo::cli {

void add_explain_command(CLI::App& program, Action& action)
{
    CLI::App* command = program.add_subcommand(
        "explain", "Say in plain words what a case is: points, memory, stages, time step, duration");
    const auto arguments = std::make_shared<CaseArguments>();
    const auto threads = std::make_shared<int>(0);
    const auto picture = std::make_shared<std::string>();
    add_case_arguments(*command, *arguments);
    add_threads(*command, *threads);
    command->add_option("--picture", *picture, "Draw bodies, obstacles, boundaries, axes and sizes into this SVG file")
        ->check([](const std::string& file) {
            return file.ends_with(".svg") ? std::string() : fmt::format("{}: the name must end in .svg", file);
        });
    command->footer("Example:\n  periporo explain my_case.toml --picture set_up.svg");
    command->callback([arguments, threads, picture, &action] {
        action = [arguments, threads, picture] {
            use_threads(*threads);
            PluginRegistry registry;
            const CaseDescription description = read_case_loudly(*arguments, registry);
            fmt::print("{}\n", explain_case(description, registry));
            if (!picture->empty()) {
                draw_case(description, registry, *picture);
                fmt::print("  drawn in {}\n", *picture);
            }
            return ExitStatus::done;
        };
    });
}

} // namespace periporo::cli
