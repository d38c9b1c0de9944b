// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What two runs of one case leave behind, to be compared to the last bit.
#pragma once

#include "cli/program.hpp"
#include "unit/output/result_content.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace periporo::test {

/// All that results.h5 holds but the number of threads.
inline std::map<std::string, std::string> results_of(const std::filesystem::path& folder)
{
    std::map<std::string, std::string> content = content_of(folder / "results.h5");
    content.erase("/provenance/threads");
    return content;
}

/// summary.json without what belongs to a process: times on the clock, threads, and memory, which follows from the
/// growth of lists.
inline nlohmann::json summary_of(const std::filesystem::path& folder)
{
    nlohmann::json summary = nlohmann::json::parse(ProgramFolder::read(folder / "summary.json"));
    for (const char* key : {"wall_seconds", "point_steps_per_second", "phase_seconds", "bytes_per_point"})
        summary.erase(key);
    summary["provenance"].erase("threads");
    return summary;
}

/// Names of what differs between two runs, in their results, history and summary.
inline std::set<std::string> differences_of(const std::filesystem::path& one, const std::filesystem::path& other)
{
    std::set<std::string> differences;
    if (std::filesystem::exists(one / "results.h5")) {
        const auto a = results_of(one), b = results_of(other);
        for (const auto* side : {&a, &b})
            for (const auto& [path, value] : *side)
                if (!a.contains(path) || !b.contains(path) || a.at(path) != b.at(path))
                    differences.insert("results.h5" + path);
    }
    if (ProgramFolder::read(one / "history.csv") != ProgramFolder::read(other / "history.csv"))
        differences.insert("history.csv");
    const nlohmann::json a = summary_of(one).flatten(), b = summary_of(other).flatten();
    for (const auto* side : {&a, &b})
        for (const auto& [path, value] : side->items())
            if (!a.contains(path) || !b.contains(path) || a.at(path) != b.at(path))
                differences.insert("summary.json" + path);
    return differences;
}

/// Does the environment ask for the long test? PERIPORO_LONG_TESTS=1 does.
inline bool long_tests()
{
    const char* value = std::getenv("PERIPORO_LONG_TESTS");
    return value != nullptr && std::string(value) == "1";
}

} // namespace periporo::test
