// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo drive CASE`: a material alone along a path.
#include "cli/commands.hpp"
#include "cli/places.hpp"
#include "cli/result_folder.hpp"
#include "drive/path_reader.hpp"
#include "drive/path_results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace periporo::cli {
namespace {

/// Results may go over those of an earlier path, but not over the path itself.
void check_folder(const std::filesystem::path& folder, const std::filesystem::path& file)
{
    namespace fs = std::filesystem;
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw UsageError(fmt::format("{} is a file, not a folder for results; choose another --out", folder.string()));
    if (std::any_of(std::begin(path_result_names), std::end(path_result_names),
                    [&](const char* name) { return fs::exists(folder / name) && fs::equivalent(folder / name, file); }))
        throw UsageError(
            fmt::format("results in {} would replace {}; choose another --out", folder.string(), file.string()));
}

} // namespace

ExitStatus drive(DriveArguments arguments)
{
    PluginRegistry registry;
    const PathDescription path = read_path(arguments.path.file, arguments.path.options, registry);
    for (const std::string& warning : path.warnings)
        fmt::print(stderr, "{}\n", warning);
    if (arguments.folder.empty())
        arguments.folder = default_result_folder(arguments.path.file);
    check_folder(arguments.folder, arguments.path.file);
    require_possible_folder(arguments.folder);

    const std::unique_ptr<Material> material = registry.make_material(path.model.name, path.model.parameters);
    const std::unique_ptr<Retention> curve =
        path.retention ? registry.make_retention(path.retention->name, path.retention->parameters) : nullptr;
    const PathRecord record = drive_path(path, *material, curve.get());
    write_path_results(path, record, arguments.folder);
    fmt::print("{}\n{}\n", summary_line(path, record), (arguments.folder / "path.csv").string());
    if (!record.failure)
        return ExitStatus::done;
    fmt::print(stderr, "periporo: {}\n{} makes this step alone\n", failure_text(path, record),
               (arguments.folder / "failing_step.toml").string());
    return ExitStatus::failed;
}

} // namespace periporo::cli
