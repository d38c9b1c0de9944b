// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The command-line program.
#include "cli/command_line.hpp"

#include <cstdio>
#include <exception>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

periporo::cli::ExitStatus run_program(int count, char** arguments)
{
    using namespace periporo::cli;
    const std::variant<Action, ExitStatus> asked_for = parse_command_line(count, arguments);
    const Action* action = std::get_if<Action>(&asked_for);
    return report_unwritten_output(action != nullptr ? report_faults(*action) : std::get<ExitStatus>(asked_for));
}

} // namespace

int main(int count, char** arguments)
{
#ifdef __GLIBC__
    // Families are found anew all the time. Their memory stays with the process instead of going back to the system,
    // which would hand it out again page by page.
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
    try {
        return static_cast<int>(run_program(count, arguments));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "periporo: %s\n", error.what());
        return static_cast<int>(periporo::cli::ExitStatus::failed);
    }
}
