// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Saves the parts of a run, and restores them in the order in which they build on each other.
#include "scheduler/run_state.hpp"

#include "operator/refresh.hpp"
#include "scheduler/guards.hpp"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace periporo {
namespace {

/// @throws std::runtime_error when points, or the places of the last refresh, are so far away that no run has them
void require_near_points(const Model& model)
{
    const double far = lost_distance(model);
    for (std::size_t i = 0; i < model.size(); ++i)
        if (!((model.state.points.position[i] - model.state.points.initial_position[i]).norm() < far) ||
            !((model.neighbourhood.positions[i] - model.state.points.initial_position[i]).norm() < far))
            throw std::runtime_error("points lie where no run has them");
}

void restore(ArchiveReader& archive, const RunState& run, const std::vector<StageDescription>& stages,
             double contact_slack, const std::function<void(std::uint64_t stage)>& enter_stage)
{
    Model& model = run.model;
    const std::size_t points = model.size();
    archive.part("position", run.position, points);
    run.position.check(stages);
    enter_stage(run.position.stage_of_model());
    archive.part("model", model);
    require_near_points(model);
    model.neighbourhood.isometries.resume();
    // Families and contact candidates are those of the last refresh.
    Families::Kept families;
    archive.part("families", families, points);
    resume_families(model, run.force_state, families);
    archive.part("contact", run.contact, points, model.state.obstacles.size());
    run.contact.resume(model, contact_slack);
    archive.part("bonds", model.bonds);
    archive.part("result", model.result);
    model.gather_ends();
    archive.part("dynamics", run.dynamics);
    archive.part("step_estimate", run.frequency, points);
    archive.part("water", run.water);
    archive.part("outputs", run.outputs);
    run.outputs.check(run.position.step);
}

} // namespace

void RunPosition::check(const std::vector<StageDescription>& stages) const
{
    const bool somewhere = stage <= stages.size() && (begun ? stage < stages.size() : stage > 0) && stage_step <= step;
    bool sometime = stage_start >= 0.0 && time >= stage_start && time_step > 0.0 && wall_seconds >= 0.0;
    if (somewhere && begun && stages[stage].kind == StageType::dynamic) // a stage that is over has been ended
        sometime = sometime && time < stage_start + stages[stage].duration;
    if (!somewhere || !sometime)
        throw std::runtime_error(fmt::format("no run of {} stages stands in stage {} at step {} and time {:.4g} s",
                                             stages.size(), stage, step, time));
}

void save_run(ArchiveWriter& archive, const RunState& run)
{
    const std::size_t points = run.model.size();
    archive.part("position", run.position, points);
    archive.part("model", run.model);
    archive.part("families", run.model.neighbourhood.families.kept(), points);
    archive.part("contact", run.contact, points, run.model.state.obstacles.size());
    archive.part("bonds", run.model.bonds);
    archive.part("result", run.model.result);
    archive.part("dynamics", run.dynamics);
    archive.part("step_estimate", run.frequency, points);
    archive.part("water", run.water);
    archive.part("outputs", run.outputs);
}

void restore_run(ArchiveReader& archive, const RunState& run, const std::vector<StageDescription>& stages,
                 double contact_slack, const std::function<void(std::uint64_t stage)>& enter_stage)
{
    try {
        restore(archive, run, stages, contact_slack, enter_stage);
    } catch (const ArchiveError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw ArchiveError(fmt::format("{} does not fit this case: {}", archive.file().string(), error.what()));
    }
}

} // namespace periporo
