// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stages of a case in order, with everything that happens between steps.
#pragma once

#include "assembly/build_model.hpp"
#include "assembly/geometries.hpp"
#include "contact/contact_forces.hpp"
#include "io/archive.hpp"
#include "io/input_hashes.hpp"
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
    /// Builds the model.
    /// @param geometries of the case, where some are made already; none: the model makes its own
    /// @throws CaseError, PluginError
    Simulation(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options,
               InterruptionGuard& interruption, std::shared_ptr<spdlog::logger> log, Geometries* geometries = nullptr);

    /// Checks the model and does all that comes before the first step: families, initial stress, stable step; or what a
    /// checkpoint restores. Writes nothing.
    /// @throws CaseError, ForeignCheckpoint, ArchiveError, or FolderError when results are gone that the checkpoint
    /// counts on
    void prepare(std::optional<ArchiveReader> checkpoint = {});
    /// Runs all stages, or those that a checkpoint left over. To be called after prepare().
    RunOutcome run();

    const Model& model() const { return model_; }
    const InputHashes& inputs() const { return inputs_; }
    /// What a user should know of the model as built.
    const std::vector<std::string>& remarks() const { return remarks_; }
    /// The stable step of a dynamic stage, of the model as prepare() leaves it.
    StableStep step_of_motion();
    /// Makes steps for about `budget` seconds and returns the time that one takes, without the first ones, in which
    /// caches and threads are cold. The simulation serves for nothing else afterwards.
    double seconds_of_a_step(double budget);

private:
    /// Looks for what would go wrong, and warns of what is suspicious.
    void check(const BuiltModel& built, Geometries& geometries);
    RunDescription describe_run();
    /// About the step of dynamic stages, from the one of the stage that has begun [s].
    double step_of_dynamic_stages() const;
    RunState state(RunPosition& position);
    void restore(ArchiveReader& checkpoint);
    RunOutcome stop();
    /// Gives the model the images and obstacles of a stage.
    void enter_stage(const StageDescription& stage);
    void begin_stage();
    /// Opens the energy ledger and writes the first snapshot when the first dynamic stage begins.
    void open_history();
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
    /// Writes a checkpoint. @throws FileError
    void checkpoint();
    /// Writes a checkpoint that is not due by the clock: without room for it the run goes on with the earlier one.
    void checkpoint_if_possible();
    void store_state();
    double wall_seconds() const;
    std::string stage_line(double fraction) const;
    void write_summary(const std::string& outcome, const std::string& message);
    /// Why a run fails: by what it computes, or because the system refuses a file or memory.
    enum class Cause { run, outside };
    [[noreturn]] void fail(const std::string& what, Cause cause = Cause::run);

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
    InputHashes inputs_;
    std::string stage_end_; ///< why the stage that has just ended did
    OutputSchedule outputs_;
    Progress progress_;
    std::vector<std::string> remarks_;
    nlohmann::json reports_ = nlohmann::json::array();
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point last_checkpoint_;
    std::chrono::duration<double> checkpoint_took_{0.0};
    std::optional<std::uint64_t> checkpoint_step_; ///< of the last checkpoint
    std::uint64_t steps_here_ = 0;                 ///< in this process, for the speed
    bool resumed_ = false;
    bool writes_ = false; ///< results have been begun: failures leave a snapshot
};

} // namespace periporo
