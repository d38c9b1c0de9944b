// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A small run that the system fails at a chosen call, and what stands in its results.
#pragma once

#include "cli/program.hpp"
#include "unit/output/result_content.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <unistd.h>

#include <cstdlib>
#include <map>
#include <string>

namespace periporo::test {

/// Some twenty steps with both writers.
inline const std::string run_of_twenty_steps =
    "run case.toml --quiet --threads 1 --set 'time.step=0.1 ms' "
    "--set 'stage.0.duration=2 ms' --set 'run.history_every=0.1 ms' --set 'output.0.every=0.4 ms' ";

/// Lets temporary folders lie in memory where the system has such a place: bringing files to a disk takes its time.
struct TemporaryFoldersInMemory {
    TemporaryFoldersInMemory()
    {
        if (::access("/dev/shm", W_OK) == 0)
            ::setenv("TMPDIR", "/dev/shm", 1);
    }
};

class FaultyRun : private TemporaryFoldersInMemory {
public:
    FaultyRun() { folder_.write("case.toml", small_case); }

    std::filesystem::path out() const { return folder_.path() / "out"; }
    std::string below; ///< beginning of the names in the folder that the fault is for, "/results"; all when empty
    std::string checkpoint_every = "0 s"; ///< after each step

    /// The run without a fault, or what is left of it.
    ProgramResult run(const std::string& more) const { return folder_.run(arguments(more)); }
    /// @param kind, at as in fault_at_call.c
    ProgramResult run_with_fault(const std::string& kind, long at, const std::string& more = "", int error = 0) const
    {
        ::setenv("FAULT_FOLDER", (out().string() + below).c_str(), 1);
        ::setenv("FAULT_KIND", kind.c_str(), 1);
        ::setenv("FAULT_AT", std::to_string(at).c_str(), 1);
        ::setenv("FAULT_ERROR", std::to_string(error).c_str(), 1);
        ::setenv("FAULT_COUNT", (folder_.path() / "calls").c_str(), 1);
        const ProgramResult result = folder_.run(arguments(more), "LD_PRELOAD='" PERIPORO_FAULT_LIBRARY "'");
        for (const char* name : {"FAULT_FOLDER", "FAULT_KIND", "FAULT_AT", "FAULT_ERROR", "FAULT_COUNT"})
            ::unsetenv(name);
        return result;
    }
    /// Calls of the last run that came to its end.
    long calls() const { return std::atol(ProgramFolder::read(folder_.path() / "calls").c_str()); }

    /// Goes on with what is there. A folder in which no run began, and one that failed before its first checkpoint, are
    /// refused with exit status 2 and a way out, which is taken.
    ProgramResult go_on() const
    {
        const ProgramResult resumed = run("--resume");
        if (resumed.status != 2)
            return resumed;
        if (contains(resumed.error, "already complete"))
            return {0, resumed.out, resumed.error};
        CHECK_FALSE(std::filesystem::exists(out() / "checkpoint.bin"));
        return run("--overwrite");
    }

    /// All of results.h5, and history.csv.
    std::map<std::string, std::string> results() const
    {
        std::map<std::string, std::string> content = content_of(out() / "results.h5");
        content["history.csv"] = ProgramFolder::read(out() / "history.csv");
        return content;
    }

private:
    std::string arguments(const std::string& more) const
    {
        return fmt::format("{} --set 'run.checkpoint_every={}' {} --out '{}'", run_of_twenty_steps, checkpoint_every,
                           more, out().string());
    }

    ProgramFolder folder_;
};

/// Compares by name, and names the first that differs.
inline void check_same_results(const std::map<std::string, std::string>& found,
                               const std::map<std::string, std::string>& expected)
{
    for (const auto& [name, value] : expected) {
        INFO(name);
        REQUIRE(found.contains(name));
        REQUIRE((found.at(name) == value)); // parentheses: the values are not for printing
    }
    CHECK(found.size() == expected.size());
}

/// Is every call to be tried, and not a spread of them?
inline bool every_call()
{
    return std::getenv("PERIPORO_LONG_TESTS") != nullptr;
}

} // namespace periporo::test
