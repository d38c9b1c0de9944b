// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stages of a case in order, with everything that happens between steps.
#pragma once

#include "contact/contact_forces.hpp"
#include "io/archive.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "scheduler/interruption.hpp"
#include "scheduler/output_schedule.hpp"
#include "scheduler/progress.hpp"
#include "scheduler/run.hpp"
#include "scheduler/run_position.hpp"
#include "scheduler/run_state.hpp"
#include "time/dynamics.hpp"
#include "time/stable_step.hpp"
#include "water/water.hpp"

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/logger.h>
#include <string>

namespace periporo {

class Simulation {
public:
    Simulation(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options,
               InterruptionGuard& interruption, std::shared_ptr<spdlog::logger> log);

    /// Runs all stages, or those that a checkpoint left over.
    RunOutcome run(std::optional<ArchiveReader> checkpoint);

private:
    RunDescription describe_run(bool resumed) const;
    RunState state(RunPosition& position);
    void restore(ArchiveReader& checkpoint);
    RunOutcome stop();
    /// Gives the model the images and obstacles of a stage.
    void enter_stage(const StageDescription& stage);
    void begin_stage();
    void end_stage();
    /// Warns of points that lay deep in what they touched.
    void report_contacts();
    /// Returns false when interrupted.
    bool quasi_static(const StageDescription& stage);
    bool dynamic(const StageDescription& stage);
    void renew_step();
    /// Does a contact, present or soon to begin, need a shorter step than that of the last estimate?
    bool contact_asks_for_shorter_step();
    /// @param end of a dynamic stage, which no step may overrun [s]; none: time stands still
    void take_step(const StepOptions& options, std::optional<double> end = {});
    /// Stops the run when points are lost, or speed or energy come from nowhere.
    void check_motion();
    /// Fails, or warns of points that went through an obstacle in the last step.
    void check_crossings();
    /// Why the run has to stop now, or nothing.
    std::string reason_to_stop() const;
    /// Writes a checkpoint when it is time for one. Does the run have to stop?
    bool stop_here();
    void checkpoint();
    double wall_seconds() const;
    std::string stage_line(double fraction) const;
    void write_summary(const std::string& outcome, const std::string& message);
    [[noreturn]] void fail(const std::string& what);

    const CaseDescription& description_;
    const PluginRegistry& registry_;
    const RunOptions& options_;
    InterruptionGuard& interruption_;
    std::shared_ptr<spdlog::logger> log_;
    Model model_;
    std::unique_ptr<ForceState> force_state_;
    ContactForces contact_;
    Water water_;
    std::vector<std::vector<std::uint32_t>> held_regions_; ///< see BuiltModel
    Dynamics dynamics_;
    FrequencyEstimate frequency_;
    RunPosition at_;
    std::string stage_end_; ///< why the stage that has just ended did
    OutputSchedule outputs_;
    Progress progress_;
    nlohmann::json reports_ = nlohmann::json::array();
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point last_checkpoint_;
    std::chrono::duration<double> checkpoint_took_{0.0};
    std::uint64_t steps_here_ = 0; ///< in this process, for the speed
};

} // namespace periporo
