// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs the stages of a case in order, and turns any failure into a message with stage, step and time.
#pragma once

#include "assembly/geometries.hpp"
#include "io/input_hashes.hpp"
#include "scheduler/interruption.hpp"
#include "scheduler/progress.hpp"
#include "scheduler/run.hpp"
#include "scheduler/run_checkpoints.hpp"
#include "scheduler/run_report.hpp"
#include "scheduler/run_state.hpp"
#include "scheduler/stage_stepper.hpp"

#include <memory>
#include <optional>
#include <spdlog/logger.h>
#include <string>
#include <vector>

namespace periporo {

class Simulation {
public:
    /// Builds the model.
    /// @param geometries of the case, when some exist already; null: the model makes its own
    /// @throws CaseError, PluginError
    Simulation(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options,
               InterruptionGuard& interruption, std::shared_ptr<spdlog::logger> log, Geometries* geometries = nullptr);

    /// Checks the model and does all that precedes the first step: families, initial stress, stable step; or restores
    /// them from a checkpoint. Writes nothing.
    /// @throws CaseError, ForeignCheckpoint, ArchiveError, or FolderError when results are gone that the checkpoint
    /// counts on
    void prepare(std::optional<ArchiveReader> checkpoint = {});
    /// Runs all stages, or those that follow the checkpoint. To be called after prepare().
    RunOutcome run();

    const Model& model() const { return state_.model; }
    const InputHashes& inputs() const { return inputs_; }
    /// Remarks on the model as built, for the user.
    const std::vector<std::string>& remarks() const { return remarks_; }
    /// The stable step of a dynamic stage, of the model as prepare() leaves it.
    StableStep step_of_motion() const { return stepper_.step_of_motion(); }
    /// Makes steps for about `budget` seconds and returns the time of one, without the first ones, in which caches and
    /// threads are cold. Afterwards the simulation cannot be run.
    double seconds_of_a_step(double budget);

private:
    /// Refuses a model that cannot run as the case says, and warns of what is suspicious.
    void check(const BuiltModel& built, Geometries& geometries);
    RunDescription describe_run();
    /// All stages from the present position. Returns false when interrupted.
    bool run_stages();
    void begin_stage();
    /// Families and initial stress of the first stage.
    void begin_first_stage();
    /// Opens the energy ledger and writes the first snapshot when the first dynamic stage begins.
    void open_history();
    void end_stage();
    /// Steps to equilibrium. Returns false when interrupted.
    bool run_quasi_static(const StageDescription& stage);
    /// Steps until the duration is over or the bodies rest. Returns false when interrupted.
    bool run_dynamic(const StageDescription& stage);
    /// Writes a checkpoint when one is due. Returns whether the run has to stop.
    bool stop_here();
    /// Why the run has to stop now; empty when it has not.
    std::string reason_to_stop() const;
    RunOutcome stop();
    RunOutcome complete();
    void write_summary(const std::string& outcome, const std::string& message);
    /// The kind of a failure: of the computation, or of the system, which refuses a file or memory.
    enum class Cause { run, outside };
    [[noreturn]] void fail(const std::string& what, Cause cause = Cause::run);

    const CaseDescription& description_;
    const PluginRegistry& registry_;
    const RunOptions& options_;
    InterruptionGuard& interruption_;
    std::shared_ptr<spdlog::logger> log_;
    Progress progress_;
    RunState state_;
    StageStepper stepper_;
    RunReport report_;
    InputHashes inputs_;
    RunCheckpoints checkpoints_;
    std::string stage_end_; ///< why the last stage ended
    std::vector<std::string> remarks_;
    bool resumed_ = false;
};

} // namespace periporo
