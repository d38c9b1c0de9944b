// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the commands share. Each command adds itself to the program and, when it is the one that was asked for, leaves
// its action behind.
#pragma once

#include "case/reader.hpp"
#include "cli/exit_status.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace periporo::cli {

/// What the chosen command will do once the command line is understood.
using Action = std::function<ExitStatus()>;

void add_run_command(CLI::App& program, Action& action);
void add_check_command(CLI::App& program, Action& action);
void add_explain_command(CLI::App& program, Action& action);
void add_inspect_command(CLI::App& program, Action& action);
void add_dispersion_command(CLI::App& program, Action& action);
void add_drive_command(CLI::App& program, Action& action);
void add_schema_command(CLI::App& program, Action& action);
void add_new_command(CLI::App& program, Action& action);

/// What every command about a case understands.
struct CaseArguments {
    std::filesystem::path file;
    CaseOptions options;
};

/// Adds CASE, --set and --plugin-path.
void add_case_arguments(CLI::App& command, CaseArguments& arguments);

/// Adds --plugin-path.
void add_plugin_path(CLI::App& command, std::vector<std::filesystem::path>& folders);

/// Reads and checks the case and prints its warnings to standard error.
CaseDescription read_case_loudly(const CaseArguments& arguments, PluginRegistry& registry);

} // namespace periporo::cli
