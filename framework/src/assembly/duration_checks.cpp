// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/duration_checks.hpp"

#include "assembly/held_points.hpp"
#include "case/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace periporo {
namespace {

constexpr double most_steps = 1e9; ///< a million points take years for them
/// A stage much shorter than a step: nothing moves in it. Stages of a part of a step serve to store a settled state.
constexpr double part_of_step = 0.01;
constexpr double one_look = 50.0; ///< steps of a run that only stores what has settled before
constexpr double round_off = 1e-9;

using Texts = std::vector<std::string>;

bool is_dynamic(const StageDescription& stage)
{
    return stage.kind == StageType::dynamic;
}

void check_length(const CaseDescription& description, double step, Texts& suspicions)
{
    for (std::size_t s = 0; s < description.stages.size(); ++s) {
        const StageDescription& stage = description.stages[s];
        const std::string key = fmt::format("stage.{}.duration", s);
        const double steps = stage.duration / step;
        if (is_dynamic(stage) && steps > most_steps)
            suspicions.push_back(suspicion(description, key,
                                           fmt::format("stage '{}' lasts {:.4g} s, which are about {:.2g} steps of "
                                                       "{:.3g} s; runs of 1e4 to 1e7 steps are usual",
                                                       stage.name, stage.duration, steps, step)));
        if (is_dynamic(stage) && steps < part_of_step)
            suspicions.push_back(suspicion(description, key,
                                           fmt::format("stage '{}' lasts {:.4g} s, far less than a step of {:.3g} s: "
                                                       "nothing moves in it",
                                                       stage.name, stage.duration, step)));
        for (std::size_t w = 0; w < stage.water_changes.size(); ++w)
            if (is_dynamic(stage) && stage.water_changes[w].over > stage.duration * (1.0 + round_off))
                suspicions.push_back(suspicion(
                    description, fmt::format("stage.{}.water.{}.over", s, w),
                    fmt::format("the water of '{}' changes over {:.4g} s, and stage '{}' lasts {:.4g} s: the "
                                "change is cut short",
                                stage.water_changes[w].body, stage.water_changes[w].over, stage.name, stage.duration)));
    }
}

void check_snapshots(const CaseDescription& description, double run, double step, Texts& suspicions)
{
    for (std::size_t o = 0; o < description.outputs.size(); ++o) {
        const OutputDescription& output = description.outputs[o];
        if (run == 0.0) {
            suspicions.push_back(suspicion(description, fmt::format("output.{}", o),
                                           fmt::format("there is no dynamic stage, and writer '{}' stores snapshots in "
                                                       "those only; a last stage of type \"dynamic\" with a duration "
                                                       "of \"0.1 ms\" stores what has settled",
                                                       output.writer.name)));
            continue;
        }
        if (output.every > run * (1.0 + round_off) && run > one_look * step)
            suspicions.push_back(suspicion(description, fmt::format("output.{}.every", o),
                                           fmt::format("snapshots every {:.4g} s of a run of {:.4g} s: only beginnings "
                                                       "and ends of stages are stored; a tenth to a hundredth of the "
                                                       "run is usual",
                                                       output.every, run)));
        std::vector<double> late;
        std::ranges::copy_if(output.times, std::back_inserter(late),
                             [&](double time) { return time > run * (1.0 + round_off); });
        if (!late.empty())
            suspicions.push_back(suspicion(description, fmt::format("output.{}.times", o),
                                           fmt::format("no snapshot is stored at {:.4g} s: the dynamic stages end at "
                                                       "{:.4g} s",
                                                       fmt::join(late, " s, "), run)));
    }
    if (!description.outputs.empty() && description.history_every > run * (1.0 + round_off) && run > one_look * step)
        suspicions.push_back(suspicion(description, "run.history_every",
                                       fmt::format("rows of history every {:.4g} s of a run of {:.4g} s: only its "
                                                   "first and last rows are stored",
                                                   description.history_every, run)));
}

/// Is what is held and present the same in two stages, and does nothing drive the second one?
bool holds_the_same(const CaseDescription& description, const StageDescription& before, const StageDescription& after)
{
    const auto same = [&](const Texts& stages) { return applies_in(stages, before) == applies_in(stages, after); };
    const auto same_region = [&](const HeldRegionDescription& region) {
        return same(region.stages) && (region.velocity.isZero() || !applies_in(region.stages, after));
    };
    const auto same_obstacle = [&](const ObstacleDescription& obstacle) {
        const bool moves =
            obstacle.moves_in && std::ranges::find(*obstacle.moves_in, after.name) != obstacle.moves_in->end();
        return same(obstacle.stages) && !moves;
    };
    const auto same_plane = [](const PlaneDescription& a, const PlaneDescription& b) {
        return a.axis == b.axis && a.offset == b.offset;
    };
    return std::ranges::all_of(description.held_regions, same_region) &&
           std::ranges::all_of(description.obstacles, same_obstacle) &&
           std::ranges::equal(before.rollers, after.rollers, same_plane);
}

void check_repetition(const CaseDescription& description, Texts& suspicions)
{
    for (std::size_t s = 1; s < description.stages.size(); ++s) {
        const StageDescription& before = description.stages[s - 1];
        const StageDescription& stage = description.stages[s];
        if (!is_dynamic(before) && !is_dynamic(stage) && stage.water_changes.empty() &&
            stage.response == before.response && stage.residual >= before.residual &&
            holds_the_same(description, before, stage))
            suspicions.push_back(suspicion(description, fmt::format("stage.{}", s),
                                           fmt::format("stage '{}' does nothing: '{}' before it has settled under the "
                                                       "same conditions to a residual of {:.1e}",
                                                       stage.name, before.name, before.residual)));
    }
}

} // namespace

Texts check_durations(const CaseDescription& description, double step)
{
    double run = 0.0;
    for (const StageDescription& stage : description.stages)
        run += stage.duration;
    Texts suspicions;
    check_length(description, step, suspicions);
    check_snapshots(description, run, step, suspicions);
    check_repetition(description, suspicions);
    return suspicions;
}

} // namespace periporo
