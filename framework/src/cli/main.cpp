// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The command-line program.
#include "cli/command.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using periporo::cli::Action;
using periporo::cli::ExitStatus;

int run_program(int count, char** arguments)
{
    CLI::App program("Large-deformation simulation of unsaturated soil by stabilized periporomechanics", "periporo");
    program.set_version_flag("--version", "periporo " PERIPORO_VERSION, "Print the version and exit");
    program.require_subcommand(1);
    program.footer("Example:\n  periporo run cases/column_collapse/quickstart.toml\n\n"
                   "Exit status: 0 done, 1 failed while running, 2 wrong input, 130 interrupted.");
    Action action;
    periporo::cli::add_run_command(program, action);
    periporo::cli::add_check_command(program, action);
    periporo::cli::add_explain_command(program, action);
    periporo::cli::add_inspect_command(program, action);
    periporo::cli::add_dispersion_command(program, action);
    periporo::cli::add_drive_command(program, action);
    periporo::cli::add_schema_command(program, action);
    periporo::cli::add_new_command(program, action);
    try {
        program.parse(count, arguments);
    } catch (const CLI::Success& request) { // --help and --version
        return program.exit(request);
    } catch (const CLI::ParseError& error) {
        program.exit(error);
        return static_cast<int>(ExitStatus::wrong_input);
    }
    return static_cast<int>(periporo::cli::report_faults(action));
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
        return run_program(count, arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "periporo: %s\n", error.what());
        return static_cast<int>(ExitStatus::failed);
    }
}
