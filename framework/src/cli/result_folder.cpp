// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at a folder before results are written to it.
#include "cli/result_folder.hpp"

#include "cli/exit_status.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_names = 8; ///< of a list on the terminal

std::string list_of(const std::vector<std::string>& names)
{
    const std::size_t shown = std::min(names.size(), most_names);
    return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                       shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
}

/// A run writes to the folder that it was given, and not to where links in it lead.
void require_no_links(const fs::path& folder)
{
    for (const std::string& name : names_of_run(folder))
        if (fs::is_symlink(folder / name))
            throw UsageError(fmt::format("{} is a symbolic link, which a run does not follow; put the file itself in "
                                         "its place, or delete the link",
                                         (folder / name).string()));
}

void delete_run(const fs::path& folder)
{
    for (const std::string& name : names_of_run(folder))
        fs::remove_all(folder / name); // a link is deleted, and not what it points to
}

} // namespace

fs::path default_result_folder(const fs::path& case_file)
{
    std::string name = case_file.filename().string();
    name.erase(0, std::min(name.find_first_not_of('.'), name.size()));
    name = fs::path(name).stem().string();
    if (name.empty())
        throw UsageError(fmt::format("{} gives its results no name; say --out DIR", case_file.string()));
    return fs::path("results") / name;
}

void check_result_folder(const fs::path& folder, ExistingResults existing)
{
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw UsageError(fmt::format("{} is a file, not a folder for results; choose another --out", folder.string()));
    require_no_run_in(folder);
    const std::vector<std::string> foreign = foreign_names(folder);
    const bool nothing_of_run = names_of_run(folder).empty(); // but perhaps its mark
    const bool empty = nothing_of_run && foreign.empty();
    const bool run_there = !empty && holds_run(folder);
    if (existing == ExistingResults::resume && !run_there)
        throw UsageError(fmt::format("{} holds no run to resume; leave --resume out to start one{}", folder.string(),
                                     empty ? "" : ", in a folder of its own by --out DIR"));
    if (existing == ExistingResults::refuse && !empty)
        throw UsageError(run_there ? fmt::format("{} is not empty; --resume goes on with the run there, --overwrite "
                                                 "deletes it, --out DIR writes elsewhere",
                                                 folder.string())
                                   : fmt::format("{} is not empty and holds no run of periporo but {}; choose another "
                                                 "--out",
                                                 folder.string(), list_of(foreign)));
    if (existing == ExistingResults::overwrite && !empty && !run_there)
        throw UsageError(
            fmt::format("{} does not look like results of periporo and is not deleted: it holds {}; choose "
                        "another --out",
                        folder.string(), list_of(foreign.empty() ? names_of_run(folder) : foreign)));
    if (existing == ExistingResults::resume)
        require_no_links(folder);
}

FolderLock take_result_folder(const fs::path& folder, ExistingResults existing)
{
    check_result_folder(folder, existing);
    FolderLock lock(folder);
    if (existing == ExistingResults::overwrite) {
        if (const std::vector<std::string> foreign = foreign_names(folder); !foreign.empty())
            fmt::print(stderr, "{}: left alone, since no run wrote it: {}\n", folder.string(), list_of(foreign));
        delete_run(folder);
    }
    return lock;
}

} // namespace periporo::cli
