// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Everything that a run needs to go on as if it had never stopped, to the last bit: each part saves itself by name.
#pragma once

#include "contact/contact_forces.hpp"
#include "io/archive.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "scheduler/output_schedule.hpp"
#include "scheduler/run_position.hpp"
#include "time/dynamics.hpp"
#include "time/stable_step.hpp"
#include "water/water.hpp"

#include <cstdint>
#include <functional>

namespace periporo {

struct RunState {
    Model& model;
    const ForceState& force_state;
    ContactForces& contact;
    Dynamics& dynamics;
    FrequencyEstimate& frequency;
    Water& water;
    OutputSchedule& outputs;
    RunPosition& position;
};

void save_run(ArchiveWriter& archive, const RunState& run);

/// Restores the state of a run whose model was built from the same case. What a stage holds, moves and changes remains
/// to be set.
/// @param contact_slack as for ContactForces::find_candidates [m]
/// @param enter_stage gives the model the images and obstacles of the stage that its families belong to
/// @throws ArchiveError naming the file when what it holds does not fit the model
void restore_run(ArchiveReader& archive, const RunState& run, const std::vector<StageDescription>& stages,
                 double contact_slack, const std::function<void(std::uint64_t stage)>& enter_stage);

} // namespace periporo
