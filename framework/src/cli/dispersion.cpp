// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo dispersion CASE`: how fast waves of each length run in the lattice of a case.
#include "cli/commands.hpp"
#include "diagnostics/dispersion_table.hpp"

#include <fmt/core.h>

namespace periporo::cli {

ExitStatus print_dispersion(const DispersionArguments& arguments)
{
    PluginRegistry registry;
    const CaseDescription description = read_case_loudly(arguments.the_case, registry);
    fmt::print("{}", dispersion_table(description, registry, arguments.cells));
    return ExitStatus::done;
}

} // namespace periporo::cli
