// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The account of a run: its stages, its speed, its line of progress and its summary.
#pragma once

#include "io/archive.hpp"
#include "io/input_hashes.hpp"
#include "scheduler/run_state.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <spdlog/logger.h>
#include <string>

namespace periporo {

class RunReport {
public:
    explicit RunReport(const RunState& run);

    /// Time that the run has taken so far, in all processes [s].
    double wall_seconds() const;
    /// The present moment of a dynamic stage, for a terminal.
    /// @param fraction of the duration of the stage that is over, 0 to 1
    std::string progress_line(double fraction) const;

    /// Adds the stage that has just ended, and logs it.
    /// @param end why the stage ended
    void add_stage(const std::string& end, spdlog::logger& log);
    void save(ArchiveWriter& archive) const;
    /// Restores the stages and the time so far, after the position of the run.
    /// @throws ArchiveError naming the file when its content is no report
    void restore(ArchiveReader& archive);

    /// Writes summary.json into the folder and logs the outcome.
    /// @throws FileError
    void write_summary(const std::string& outcome, const std::string& message, const InputHashes& inputs, int threads,
                       const std::filesystem::path& folder, spdlog::logger& log) const;

private:
    double steps_per_second() const;
    /// Warns of contacts in which a point lay far too deep.
    void warn_of_overlaps(spdlog::logger& log) const;

    const RunState& run_;
    nlohmann::json stages_ = nlohmann::json::array();
    std::chrono::steady_clock::time_point started_; ///< this process
    double wall_before_ = 0.0;                      ///< time of the processes before this one [s]
    std::uint64_t first_step_ = 0;                  ///< of this process
};

} // namespace periporo
