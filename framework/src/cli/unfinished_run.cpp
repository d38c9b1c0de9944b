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

} // namespace

void require_unfinished_run(const fs::path& folder, const std::string& resolved_case)
{
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
    const std::string written = text_of(folder / "case.toml"); // none yet when the run was killed in its first moments
    if (!written.empty() && written != resolved_case)
        throw UsageError(fmt::format("{} holds the run of another case or with other --set values: {}; run the case "
                                     "that it was started with, or start anew with --overwrite",
                                     folder.string(), case_difference(written, resolved_case)));
}

} // namespace periporo::cli
