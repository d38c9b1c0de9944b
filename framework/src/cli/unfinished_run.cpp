// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at the marks, the summary and the case of the run in a folder.
#include "cli/unfinished_run.hpp"

#include "cli/exit_status.hpp"
#include "io/case_difference.hpp"
#include "io/checkpoint.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// How the run in the folder ended, by its summary; empty when it has none.
std::string outcome_of(const fs::path& folder)
{
    const nlohmann::json summary = nlohmann::json::parse(text_of(folder / "summary.json"), nullptr, false);
    return summary.is_object() && summary.contains("outcome") && summary["outcome"].is_string()
               ? summary["outcome"].get<std::string>()
               : std::string();
}

/// Is there nothing but what a run writes first? It may have been killed between two of these files.
bool has_just_begun(const fs::path& folder)
{
    if (!fs::is_directory(folder) || fs::is_empty(folder))
        return false;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name != "run.log" && name != "case.toml.part")
            return false;
    }
    return true;
}

} // namespace

void require_unfinished_run(const fs::path& folder, const std::string& resolved_case)
{
    if (has_just_begun(folder))
        return;
    if (!fs::is_regular_file(folder / "case.toml") || !fs::is_regular_file(folder / "run.log"))
        throw UsageError(fmt::format("{} holds no run to resume; leave --resume out to start one", folder.string()));
    const std::string outcome = outcome_of(folder);
    if (outcome == "complete")
        throw UsageError(fmt::format("the run in {} is already complete, there is nothing to resume; --overwrite runs "
                                     "it anew, --out DIR writes elsewhere",
                                     folder.string()));
    if (has_checkpoint(folder))
        return;
    if (outcome == "failed")
        throw UsageError(
            fmt::format("the run in {} failed before its first checkpoint; --overwrite runs it anew, --out "
                        "DIR writes elsewhere",
                        folder.string()));
    if (const std::string written = text_of(folder / "case.toml"); written != resolved_case)
        throw UsageError(fmt::format("{} holds the run of another case or with other --set values: {}; run the case "
                                     "that it was started with, or start anew with --overwrite",
                                     folder.string(), case_difference(written, resolved_case)));
}

} // namespace periporo::cli
