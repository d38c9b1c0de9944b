// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The state of a run: all that changes from step to step. Each part saves and restores itself by name.
#pragma once

#include "assembly/build_model.hpp"
#include "case/description.hpp"
#include "contact/contact_forces.hpp"
#include "io/archive.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "plugins/registry.hpp"
#include "scheduler/output_schedule.hpp"
#include "scheduler/run_position.hpp"
#include "time/dynamics.hpp"
#include "time/stable_step.hpp"
#include "water/water.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace periporo {

struct RunState {
    /// An empty model with the force state, the integrator and the writers of the case.
    /// @throws PluginError
    RunState(const CaseDescription& description, const PluginRegistry& registry);
    RunState(const RunState&) = delete; // the integrator refers to the other members
    RunState& operator=(const RunState&) = delete;

    /// Moves the model, its contacts and its water here.
    void set_model(BuiltModel built);

    /// The stage that the position is in, or the last stage behind it.
    const StageDescription& current_stage() const;
    /// Sets the images and the obstacles of a stage.
    void enter(const StageDescription& stage);
    /// Sets the directions in which a stage holds points.
    void hold(const StageDescription& stage);

    void save(ArchiveWriter& archive);
    /// Restores a run whose model was built from the same case.
    /// @throws ArchiveError naming the file when its content does not fit the model
    void restore(ArchiveReader& archive);

    const CaseDescription& description;
    Model model;
    std::unique_ptr<ForceState> force_state;
    ContactForces contact;
    Water water;
    std::vector<std::vector<std::uint32_t>> held_regions; ///< see BuiltModel
    Dynamics dynamics;
    FrequencyEstimate frequency;
    OutputSchedule outputs;
    RunPosition position;

private:
    void restore_parts(ArchiveReader& archive);
};

/// Does the stage seek equilibrium, while time stands still?
inline bool is_quasi_static(const StageDescription& stage)
{
    return stage.kind == StageType::quasi_static;
}

} // namespace periporo
