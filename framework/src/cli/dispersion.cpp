// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo dispersion CASE`: how fast waves of each length run in the lattice of a case.
#include "cli/command.hpp"
#include "diagnostics/dispersion_table.hpp"

#include <fmt/core.h>

#include <memory>

namespace periporo::cli {

void add_dispersion_command(CLI::App& program, Action& action)
{
    struct Arguments {
        CaseArguments the_case;
        int cells = 12;
    };
    CLI::App* command = program.add_subcommand(
        "dispersion", "Print as CSV how fast plane waves run in the lattice of a case, for every force state");
    const auto arguments = std::make_shared<Arguments>();
    add_case_arguments(*command, arguments->the_case);
    command->add_option("--cells", arguments->cells, "Points of a curve, up to the corner of the zone")
        ->check(CLI::Range(2, 50))
        ->capture_default_str()
        ->type_name("N");
    command->footer("Example:\n  periporo dispersion my_case.toml > dispersion.csv");
    command->callback([arguments, &action] {
        action = [arguments] {
            PluginRegistry registry;
            const CaseDescription description = read_case_loudly(arguments->the_case, registry);
            fmt::print("{}", dispersion_table(description, registry, arguments->cells));
            return ExitStatus::done;
        };
    });
}

} // namespace periporo::cli
