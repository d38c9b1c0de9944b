// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Saves the parts of a run, and restores them in the order in which they build on each other.
#include "scheduler/run_state.hpp"

#include "assembly/held_points.hpp"
#include "operator/refresh.hpp"
#include "scheduler/guards.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace periporo {
namespace {

DynamicsSettings settings_of(const CaseDescription& description)
{
    return {description.discretization.skin(), description.discretization.refresh == RefreshRule::every_step};
}

/// @throws std::runtime_error when points, or their places at the last refresh, are too far away for any run
void require_near_points(const Model& model)
{
    const double far = lost_distance(model);
    for (std::size_t i = 0; i < model.size(); ++i)
        if (!((model.state.points.position[i] - model.state.points.initial_position[i]).norm() < far) ||
            !((model.neighbourhood.positions[i] - model.state.points.initial_position[i]).norm() < far))
            throw std::runtime_error("points lie where no run has them");
}

} // namespace

RunState::RunState(const CaseDescription& description_, const PluginRegistry& registry)
    : description(description_),
      force_state(
          make_force_state(description.operators.force_state,
                           Influence::by_name(description.operators.influence, description.discretization.horizon()))),
      contact(std::vector<ContactAssignment>{}), dynamics(model, *force_state, contact, settings_of(description)),
      outputs(description, registry)
{
}

void RunState::set_model(BuiltModel built)
{
    model = std::move(built.model);
    contact = ContactForces(std::move(built.contacts));
    water = std::move(built.water);
    held_regions = std::move(built.held_regions);
}

const StageDescription& RunState::current_stage() const
{
    return description.stages[std::min<std::size_t>(position.stage, description.stages.size() - 1)];
}

void RunState::enter(const StageDescription& stage)
{
    model.neighbourhood.isometries.set_generators(image_generators(description, stage));
    set_obstacles(model, description, stage);
}

void RunState::hold(const StageDescription& stage)
{
    dynamics.hold(held_directions(model, description, held_regions, stage));
}

void RunState::save(ArchiveWriter& archive)
{
    const std::size_t points = model.size();
    archive.part("position", position, points);
    archive.part("model", model);
    archive.part("families", model.neighbourhood.families.kept(), points);
    archive.part("contact", contact, points, model.state.obstacles.size());
    archive.part("bonds", model.bonds);
    archive.part("result", model.result);
    archive.part("dynamics", dynamics);
    archive.part("step_estimate", frequency, points);
    archive.part("water", water);
    archive.part("outputs", outputs);
}

void RunState::restore(ArchiveReader& archive)
{
    try {
        restore_parts(archive);
    } catch (const ArchiveError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw ArchiveError(fmt::format("{} does not fit this case: {}", archive.file().string(), error.what()));
    }
    const StageDescription& stage = description.stages.at(position.stage_of_model());
    water.resume(model, stage);
    hold(stage);
}

void RunState::restore_parts(ArchiveReader& archive)
{
    const std::size_t points = model.size();
    archive.part("position", position, points);
    position.check(description.stages);
    enter(description.stages.at(position.stage_of_model()));
    archive.part("model", model);
    require_near_points(model);
    model.neighbourhood.isometries.resume();
    // Families and contact candidates are those of the last refresh.
    Families::Kept families;
    archive.part("families", families, points);
    resume_families(model, *force_state, families);
    archive.part("contact", contact, points, model.state.obstacles.size());
    contact.resume(model, settings_of(description).skin);
    archive.part("bonds", model.bonds);
    archive.part("result", model.result);
    model.gather_ends();
    archive.part("dynamics", dynamics);
    archive.part("step_estimate", frequency, points);
    archive.part("water", water);
    archive.part("outputs", outputs);
    outputs.check(position.step);
}

void RunPosition::check(const std::vector<StageDescription>& stages) const
{
    const bool somewhere = stage <= stages.size() && (begun ? stage < stages.size() : stage > 0) && stage_step <= step;
    bool sometime = stage_start >= 0.0 && time >= stage_start && time_step > 0.0;
    if (somewhere && begun && stages[stage].kind == StageType::dynamic) // a stage that is over has been ended
        sometime = sometime && time < stage_start + stages[stage].duration;
    if (!somewhere || !sometime)
        throw std::runtime_error(fmt::format("no run of {} stages stands in stage {} at step {} and time {:.4g} s",
                                             stages.size(), stage, step, time));
}

} // namespace periporo
