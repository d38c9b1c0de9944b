// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Makes the steps of a stage: keeps the step stable, and stops a run whose motion is wrong.
#pragma once

#include "scheduler/progress.hpp"
#include "scheduler/run_state.hpp"
#include "time/dynamics.hpp"
#include "time/stable_step.hpp"

#include <cstdint>
#include <optional>
#include <spdlog/logger.h>

namespace periporo {

/// Number of steps between two estimates of the stable step, and between two looks at the motion.
inline constexpr std::uint64_t steps_per_check = 50;

class StageStepper {
public:
    StageStepper(RunState& run, Progress& progress, spdlog::logger& log) : run_(run), progress_(progress), log_(log) {}

    /// Damping and response of materials in the present stage; the length of the step is left to take().
    StepOptions options() const;
    /// One step, with the changes of water and contact that belong to it.
    /// @param end of a dynamic stage, which no step may pass [s]; none: time stands still
    /// @throws MaterialFailure
    /// @throws std::runtime_error when a given step is not stable, or the motion is wrong
    void take(const StepOptions& options, std::optional<double> end = {});
    /// Estimates the stable step again.
    /// @throws std::runtime_error when a given step is not stable
    void renew_step();
    /// @throws std::runtime_error when points are lost, or speed or energy come from nowhere
    void check_motion() const;

    /// The stable step of a dynamic stage, of the model at present.
    StableStep step_of_motion() const;
    /// The step of dynamic stages, about, from the step of the present stage [s].
    double step_of_dynamic_stages() const;

private:
    /// Does a contact, present or soon to begin, need a shorter step than the last estimate gave?
    bool contact_needs_shorter_step() const;
    /// Stops at points that went through an obstacle in the last step, or warns of them.
    void check_crossings() const;

    RunState& run_;
    Progress& progress_;
    spdlog::logger& log_;
};

} // namespace periporo
