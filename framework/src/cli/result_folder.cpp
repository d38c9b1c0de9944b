// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at a folder before results are written to it.
#include "cli/result_folder.hpp"

#include "cli/exit_status.hpp"
#include "io/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_names = 8; ///< of a list on the terminal

/// Where a path leads, and where it stands itself: a link may lead into a folder, or out of it.
std::vector<fs::path> places_of(const fs::path& file)
{
    std::error_code ignored;
    const fs::path whole = fs::absolute(file, ignored);
    return {fs::weakly_canonical(whole, ignored),
            fs::weakly_canonical(whole.parent_path(), ignored) / whole.filename()};
}

/// The name in a folder below which a place lies; empty when it lies elsewhere.
std::string name_below(const fs::path& folder, const fs::path& place)
{
    const fs::path way = place.lexically_relative(folder);
    return way.empty() || *way.begin() == ".." || *way.begin() == "." ? std::string() : way.begin()->string();
}

} // namespace

std::string list_of(const std::vector<std::string>& names)
{
    const std::size_t shown = std::min(names.size(), most_names);
    return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                       shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
}

fs::path default_result_folder(const fs::path& case_file)
{
    std::string name = case_file.filename().string();
    name.erase(0, std::min(name.find_first_not_of('.'), name.size()));
    name = fs::path(name).stem().string();
    if (name.empty())
        throw UsageError(fmt::format("{} gives its results no name; say --out DIR", case_file.string()));
    return fs::path("results") / name;
}

void check_result_folder(const fs::path& folder, ExistingResults existing, const std::vector<std::string>& of_writers)
{
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        throw UsageError(fmt::format("{} is a file, not a folder for results; choose another --out", folder.string()));
    require_no_run_in(folder);
    const std::vector<std::string> foreign = foreign_names(folder, of_writers);
    const std::vector<std::string> of_run = names_of_run(folder, of_writers);
    const bool empty = of_run.empty() && foreign.empty(); // but perhaps the mark of a run
    const bool run_there = !empty && holds_run(folder);
    const std::string there = list_of(foreign.empty() ? of_run : foreign);
    if (existing == ExistingResults::resume && !run_there)
        throw UsageError(fmt::format("{} holds no run to resume; leave --resume out to start one{}", folder.string(),
                                     empty ? "" : ", in a folder of its own by --out DIR"));
    if (existing == ExistingResults::refuse && !empty)
        throw UsageError(run_there ? fmt::format("{} is not empty; --resume goes on with the run there, --overwrite "
                                                 "deletes it, --out DIR writes elsewhere",
                                                 folder.string())
                                   : fmt::format("{} is not empty: it holds no run of periporo but {}; choose another "
                                                 "--out",
                                                 folder.string(), there));
    if (existing == ExistingResults::overwrite && !empty && !run_there)
        throw UsageError(
            fmt::format("{} does not look like results of periporo and is not deleted: it holds {}; choose "
                        "another --out",
                        folder.string(), there));
    for (const std::string& name : foreign)
        if (std::find(of_writers.begin(), of_writers.end(), name) != of_writers.end())
            throw UsageError(fmt::format("{} was not written by a run, and a writer of this run would replace it; move "
                                         "it away or choose another --out",
                                         (folder / name).string()));
    if (existing != ExistingResults::refuse)
        require_sound_entries(folder, of_writers, existing == ExistingResults::resume);
}

void require_no_input_in(const fs::path& folder, const std::vector<fs::path>& inputs,
                         const std::vector<std::string>& of_writers)
{
    std::error_code ignored;
    const fs::path whole = fs::weakly_canonical(fs::absolute(folder, ignored), ignored);
    const std::vector<std::string> deleted = names_of_run(folder, of_writers);
    for (const fs::path& input : inputs)
        for (const fs::path& place : places_of(input))
            if (const std::string name = name_below(whole, place);
                !name.empty() && std::find(deleted.begin(), deleted.end(), name) != deleted.end())
                throw UsageError(
                    fmt::format("--overwrite would delete {}, which this case reads; move it out of {}, or "
                                "choose another --out",
                                input.string(), folder.string()));
}

FolderLock take_result_folder(const fs::path& folder, ExistingResults existing,
                              const std::vector<std::string>& of_writers)
{
    check_result_folder(folder, existing, of_writers);
    FolderLock lock(folder);
    if (existing == ExistingResults::overwrite) {
        const std::vector<std::string> foreign = foreign_names(folder, of_writers);
        if (!foreign.empty())
            fmt::print(stderr, "{}: left alone, since no run wrote it: {}\n", folder.string(), list_of(foreign));
        delete_run(folder, of_writers);
    }
    return lock;
}

} // namespace periporo::cli
