// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at a folder before results are written to it.
#include "cli/result_folder.hpp"

#include "cli/exit_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

/// Every run writes these into its folder before anything else.
constexpr std::array result_marks{"run.log", "case.toml"};

bool holds_results(const fs::path& folder)
{
    return std::all_of(result_marks.begin(), result_marks.end(),
                       [&](const char* mark) { return fs::exists(folder / mark); });
}

} // namespace

fs::path default_result_folder(const fs::path& case_file)
{
    return fs::path("results") / case_file.stem();
}

void check_result_folder(const fs::path& folder, ExistingResults existing)
{
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw UsageError(fmt::format("{} is a file, not a folder for results; choose another --out", folder.string()));
    const bool empty = !fs::exists(folder) || fs::is_empty(folder);
    if (existing == ExistingResults::resume && empty)
        throw UsageError(fmt::format("{} holds no run to resume; leave --resume out to start one", folder.string()));
    if (existing == ExistingResults::resume || empty)
        return;
    if (existing == ExistingResults::refuse)
        throw UsageError(fmt::format("{} is not empty; --resume goes on with the run there, --overwrite deletes it, "
                                     "--out DIR writes elsewhere",
                                     folder.string()));
    if (!holds_results(folder))
        throw UsageError(fmt::format("{} does not look like results of periporo ({} are not there) and is not "
                                     "deleted; choose another --out",
                                     folder.string(), fmt::join(result_marks, " and ")));
}

void prepare_result_folder(const fs::path& folder, ExistingResults existing)
{
    check_result_folder(folder, existing);
    if (existing != ExistingResults::overwrite || !fs::exists(folder))
        return;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        fs::remove_all(entry.path());
}

} // namespace periporo::cli
