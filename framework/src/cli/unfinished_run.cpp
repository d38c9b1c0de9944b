// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at the marks, the summary and the case of the run in a folder.
#include "cli/unfinished_run.hpp"

#include "cli/exit_status.hpp"
#include "cli/result_folder.hpp"
#include "io/case_difference.hpp"
#include "io/checkpoint.hpp"
#include "io/folder_error.hpp"
#include "io/folder_lock.hpp"
#include "io/run_folder.hpp"
#include "periporo/file.hpp"
#include "scheduler/earlier_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

/// Content of a file; empty when there is none. @throws FolderError when it cannot be read
std::string text_of(const fs::path& file)
{
    std::string text;
    if (fs::exists(fs::symlink_status(file)))
        as_fault_of_folder([&] { text = read_whole(file); });
    return text;
}

/// How the run in the folder ended, by its summary; empty when it has none.
std::string outcome_of(const fs::path& folder)
{
    const nlohmann::json summary = nlohmann::json::parse(text_of(folder / "summary.json"), nullptr, false);
    return summary.is_object() && summary.contains("outcome") && summary["outcome"].is_string()
               ? summary["outcome"].get<std::string>()
               : std::string();
}

/// Deletes what a complete run has left. @return words that name it, or nothing
std::string clean_up(const fs::path& folder)
{
    const std::vector<std::string> left = leftovers(folder);
    if (left.empty())
        return {};
    as_fault_of_folder([&] {
        const FolderLock lock(folder);
        delete_leftovers(folder);
    });
    return fmt::format("; left over from it and deleted now: {}", list_of(left));
}

} // namespace

void require_unfinished_run(const fs::path& folder, const CaseDescription& description, const PluginRegistry& registry)
{
    const std::string outcome = outcome_of(folder);
    const std::string written = text_of(folder / "case.toml"); // none yet when the run was killed in its first moments
    if (outcome == "complete") {
        std::vector<std::string> gone;
        const bool same = give_same_results(written, description.resolved); // another case may have other writers
        if (same)
            gone = earlier_results(description, registry, folder).missing;
        const std::string left = same && gone.empty() ? clean_up(folder) : "";
        throw UsageError(
            fmt::format("the run in {} is already complete, {}; --overwrite runs it anew, --out DIR writes "
                        "elsewhere",
                        folder.string(),
                        gone.empty() ? "there is nothing to resume" + left
                                     : fmt::format("but {} is gone or damaged", fmt::join(gone, ", "))));
    }
    if (has_checkpoint(folder))
        return;
    if (!written.empty() && !give_same_results(written, description.resolved))
        throw UsageError(fmt::format("{} holds the run of another case or with other --set values: {}; run the case "
                                     "that it was started with, or start anew with --overwrite",
                                     folder.string(), case_difference(written, description.resolved)));
    const EarlierResults earlier = earlier_results(description, registry, folder);
    if (earlier.complete)
        throw UsageError(
            fmt::format("the run in {} is already complete, as its results say, but its summary.json is {}; "
                        "nothing is changed; --overwrite runs it anew, --out DIR writes elsewhere",
                        folder.string(),
                        !fs::exists(folder / "summary.json") ? "missing"
                        : outcome.empty()                    ? "damaged"
                                                             : fmt::format("of a run that was {}", outcome)));
    // A run that failed before its first checkpoint has not made a step and holds nothing yet.
    if ((!outcome.empty() && outcome != "failed") || !earlier.holds.empty())
        throw UsageError(fmt::format(
            "{} holds no checkpoint to go on from, but a run was there: {}; bring the checkpoint back, write elsewhere "
            "with --out DIR, or start anew with --overwrite, which deletes these results",
            folder.string(),
            earlier.holds.empty() ? fmt::format("its summary.json says {}", outcome)
                                  : fmt::format("{}", fmt::join(earlier.holds, ", "))));
}

} // namespace periporo::cli
