// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes the checkpoints of a run when they are due, and resumes the run from one.
#pragma once

#include "io/archive.hpp"
#include "io/input_hashes.hpp"
#include "scheduler/run.hpp"
#include "scheduler/run_report.hpp"
#include "scheduler/run_state.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <spdlog/logger.h>

namespace periporo {

class RunCheckpoints {
public:
    /// @param inputs hashes of the files that the run read; filled before the first call
    RunCheckpoints(RunState& run, RunReport& report, const InputHashes& inputs, const RunOptions& options,
                   spdlog::logger& log);

    /// Restores the run whose model was built from the same case and files.
    /// @throws ForeignCheckpoint when a file that the run read has changed since
    /// @throws ArchiveError when the content does not fit
    /// @throws FolderError when results are gone that the checkpoint counts on
    void restore(ArchiveReader& checkpoint);

    /// The time to the next checkpoint counts from now.
    void start_clock() { last_ = std::chrono::steady_clock::now(); }
    /// Is it time for a checkpoint? At most a twentieth of the time of a run goes into checkpoints.
    bool due() const;
    /// @throws FileError
    /// @throws std::runtime_error when a point is lost: such a state does not replace an earlier one
    void write();
    /// Writes a checkpoint that is not due by the clock. When the system refuses it, the run keeps the earlier one and
    /// continues with a warning.
    void write_if_possible();

    /// Step of the last checkpoint, from which a resume continues; none: there is no checkpoint.
    std::optional<std::uint64_t> last_step() const { return last_step_; }

private:
    void store();

    RunState& run_;
    RunReport& report_;
    const InputHashes& inputs_;
    const RunOptions& options_;
    spdlog::logger& log_;
    std::chrono::steady_clock::time_point last_;
    std::chrono::duration<double> took_{0.0}; ///< the last one
    std::optional<std::uint64_t> last_step_;
};

} // namespace periporo
