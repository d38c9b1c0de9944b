// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo check CASE`: every error of a case at once.
#include "cli/commands.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <unistd.h>

namespace periporo::cli {

CaseDescription read_case_loudly(const CaseArguments& arguments, PluginRegistry& registry)
{
    CaseDescription description = read_case(arguments.file, arguments.options, registry);
    for (const std::string& warning : description.warnings)
        fmt::print(stderr, "{}\n", warning);
    return description;
}

ExitStatus check(const CaseArguments& arguments)
{
    PluginRegistry registry;
    const CaseDescription description = read_case_loudly(arguments, registry);
    for (const std::string& warning : check_case(description, registry, isatty(STDERR_FILENO) == 0))
        fmt::print(stderr, "{}", warning);
    fmt::print("{}: no errors\n", arguments.file.string());
    return ExitStatus::done;
}

} // namespace periporo::cli
