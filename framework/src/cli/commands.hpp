// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The commands of the program, each with its arguments as the command line gives them (command_line.hpp).
#pragma once

#include "case/reader.hpp"
#include "cli/exit_status.hpp"
#include "scheduler/run.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace periporo::cli {

/// What every command about a case understands.
struct CaseArguments {
    std::filesystem::path file;
    CaseOptions options;
};

/// Reads and checks the case and prints its warnings to standard error.
CaseDescription read_case_loudly(const CaseArguments& arguments, PluginRegistry& registry);

struct RunArguments {
    CaseArguments the_case;
    RunOptions options;
    bool overwrite = false;
};
ExitStatus run(RunArguments arguments);

ExitStatus check(const CaseArguments& arguments);

struct ExplainArguments {
    CaseArguments the_case;
    int threads = 0;     ///< 0 for as many as OpenMP offers
    std::string picture; ///< an SVG file to draw; empty for none
};
ExitStatus explain(const ExplainArguments& arguments);

struct InspectArguments {
    std::string name; ///< of a plugin; empty for all
    bool markdown = false;
    bool json = false;
    std::vector<std::filesystem::path> plugin_folders;
};
ExitStatus inspect(const InspectArguments& arguments);

struct DispersionArguments {
    CaseArguments the_case;
    int cells = 12; ///< points of a curve
};
ExitStatus print_dispersion(const DispersionArguments& arguments);

struct DriveArguments {
    CaseArguments path;
    std::filesystem::path folder; ///< of the results; empty for the one named after the path
};
ExitStatus drive(DriveArguments arguments);

struct SchemaArguments {
    std::vector<std::filesystem::path> plugin_folders;
};
ExitStatus print_schema(const SchemaArguments& arguments);

struct NewArguments {
    std::string kind;
    std::string name;
    std::filesystem::path folder; ///< empty for ./NAME
    std::vector<std::filesystem::path> plugin_folders;
};
ExitStatus write_new_plugin(const NewArguments& arguments);

} // namespace periporo::cli
