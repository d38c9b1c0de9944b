// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs a checked case from its first stage to its last.
#pragma once

#include "case/description.hpp"
#include "io/input_hashes.hpp"
#include "plugins/registry.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace periporo {

struct RunOptions {
    std::filesystem::path directory; ///< results; made when missing
    int threads = 0;                 ///< 0 takes what OpenMP offers
    bool resume = false;             ///< go on from the checkpoint in `directory`
    bool without_lost = false;       ///< go on although results are gone that the checkpoint counts on
    bool quiet = false;              ///< no progress on the terminal; the log file is written all the same
    bool stand_in = false; ///< the case on a coarser lattice, to measure times: no look at what the user meant
    /// Called when nothing is wrong with the case and its model is built, before anything is written: frees the folder.
    std::function<void(const InputHashes& inputs)> take_folder;
    /// Stop with a checkpoint after so many steps of all stages; none: run to the end.
    std::optional<std::uint64_t> stop_after = {};
};

enum class RunOutcome {
    complete,   ///< exit status 0
    interrupted ///< stopped by a signal or as asked; a checkpoint was written, exit status 130
};

/// Runs the case. Writes log, results, checkpoint and summary into the directory.
/// @throws std::exception with stage, step, time, point and position when the run goes wrong (exit status 1).
/// @throws PluginError or CaseError when the fault is the user's (exit status 2), ForeignCheckpoint when `resume` finds
/// the run of another case, version or input; nothing has been written then.
RunOutcome run_case(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options);

/// Builds all that a run of the case would build, short of its first step, and writes nothing.
/// @param quiet shows no progress on the terminal
/// @return what is suspicious, a text each
/// @throws CaseError, PluginError as a run of the case would.
std::vector<std::string> check_case(const CaseDescription& description, const PluginRegistry& registry, bool quiet);

} // namespace periporo
