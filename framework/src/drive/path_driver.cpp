// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Makes the steps of a path; one that fails is made in halves before it is given up.
#include "drive/path_driver.hpp"

#include "drive/stage_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace periporo {
namespace {

/// One step: stresses to be reached, strains to be added, water as it is at the end.
struct Increment {
    std::array<bool, 6> stress_controlled{};
    StageValues values; ///< stresses and water at the end; strains of this step
    double time_step = 0.0;
    bool simple_shear = false;

    /// The first half of the step, from the point where it begins.
    Increment first_half(const MaterialPoint& point) const
    {
        Increment half = second_half();
        const std::array<double, 6> stress = components(point.stress());
        for (std::size_t c = 0; c < 6; ++c)
            if (stress_controlled[c])
                half.values.components[c] = std::midpoint(stress[c], values.components[c]);
        half.values.suction = std::midpoint(point.suction(), values.suction);
        half.values.saturation = std::midpoint(point.saturation(), values.saturation);
        return half;
    }

    Increment second_half() const
    {
        Increment half = *this;
        half.time_step *= 0.5;
        for (std::size_t c = 0; c < 6; ++c)
            if (!stress_controlled[c])
                half.values.components[c] *= 0.5;
        return half;
    }
};

MixedStep mixed_step(const MaterialPoint& point, const Increment& increment)
{
    MixedStep step;
    step.stress_controlled = increment.stress_controlled;
    step.increment = increment.values.components;
    step.time_step = increment.time_step;
    step.simple_shear = increment.simple_shear;
    const std::array<double, 6> stress = components(point.stress());
    double largest = 1e3; // [Pa]: below, differences of a millionth of a pascal mean nothing
    for (std::size_t c = 0; c < 6; ++c) {
        largest = std::max(largest, std::abs(stress[c]));
        if (!step.stress_controlled[c])
            continue;
        largest = std::max(largest, std::abs(increment.values.components[c]));
        step.increment[c] -= stress[c];
    }
    step.tolerance = 1e-9 * largest;
    return step;
}

/// Moves the point by a step, in halves of halves where it must. A failed step leaves the point somewhere on the way.
MaterialStatus advance(MaterialPoint& point, const Increment& increment, std::int64_t halvings)
{
    MaterialPoint next = point;
    next.set_water(increment.values.suction, increment.values.saturation);
    MaterialStatus status = next.step(mixed_step(point, increment));
    if (status.converged) {
        point = next;
        return status;
    }
    if (halvings == 0)
        return status;
    status = advance(point, increment.first_half(point), halvings - 1);
    return status.converged ? advance(point, increment.second_half(), halvings - 1) : status;
}

/// Fractions of the way to the target between which a stage goes to and fro.
std::vector<double> turning_points(const PathStage& stage)
{
    if (stage.cycles == 0)
        return {0.0, 1.0};
    std::vector<double> points{0.0};
    for (std::int64_t n = 0; n < stage.cycles; ++n) {
        points.push_back(1.0);
        points.push_back(stage.two_way ? -1.0 : 0.0);
    }
    if (stage.two_way)
        points.push_back(0.0);
    return points;
}

/// S_r of the curve at the porosity of the point.
double saturation_of(const Retention& curve, double suction, const PathDescription& path, const MaterialPoint& point)
{
    return curve.saturation(suction, std::max(0.0, 1.0 - 1.0 / specific_volume(path, point).value()));
}

/// A path with what it is made of.
struct Drive {
    const PathDescription& path;
    const Retention* curve; ///< or null
    PathRecord& record;

    Increment increment_between(const StagePlan& plan, double from, double to, double time_step) const
    {
        Increment increment{plan.stress_controlled, plan.at(to), time_step, plan.simple_shear};
        StageValues& values = increment.values;
        if (curve != nullptr && plan.wet)
            values.saturation = saturation_of(*curve, values.suction, path, record.rows.back().point);
        for (std::size_t c = 0; c < 6; ++c) {
            if (!plan.stress_controlled[c])
                values.components[c] = plan.target.components[c] * (to - from);
            else if (plan.total_stress && c < 3)
                values.components[c] -= values.saturation * values.suction;
        }
        return increment;
    }

    bool make(const PathStage& stage, std::size_t number);
};

MixedStage as_stage(const Increment& increment)
{
    MixedStage stage;
    for (std::size_t c = 0; c < 6; ++c) {
        if (increment.stress_controlled[c])
            stage.stress[c] = increment.values.components[c];
        else
            stage.strain[c] = increment.values.components[c];
    }
    stage.simple_shear = increment.simple_shear;
    stage.suction = increment.values.suction;
    stage.saturation = increment.values.saturation;
    return stage;
}

/// Makes one stage; false when a step failed.
bool Drive::make(const PathStage& stage, std::size_t number)
{
    const StagePlan plan = plan_stage(stage.kind, record.rows.back().point);
    const double time_step = stage.duration / static_cast<double>(stage.steps);
    const std::vector<double> turns = turning_points(stage);
    for (std::size_t leg = 1; leg < turns.size(); ++leg) {
        const double from = turns[leg - 1];
        const auto steps = static_cast<std::int64_t>(std::abs(turns[leg] - from)) * stage.steps;
        for (std::int64_t n = 0; n < steps; ++n) {
            const auto way = [&](std::int64_t k) {
                return std::lerp(from, turns[leg], static_cast<double>(k) / static_cast<double>(steps));
            };
            const Increment increment = increment_between(plan, way(n), way(n + 1), time_step);
            PathRow row = record.rows.back();
            ++row.step;
            row.stage = number;
            row.time += time_step;
            const MaterialStatus status = advance(row.point, increment, stage.halvings);
            if (!status.converged) {
                record.failure = {row.step, number, as_stage(increment), time_step,
                                  status.reason == nullptr ? "the law gives no reason" : status.reason};
                return false;
            }
            record.rows.push_back(std::move(row));
        }
    }
    return true;
}

} // namespace

std::optional<double> specific_volume(const PathDescription& path, const MaterialPoint& point)
{
    if (!path.porosity)
        return std::nullopt;
    return std::exp(trace(point.strain())) / (1.0 - *path.porosity);
}

MaterialPoint initial_point(const PathDescription& path, const Material& material, const Retention* curve)
{
    MaterialPoint point(material, path.stress);
    const double suction = path.suction.value_or(0.0);
    point.set_water(suction, curve != nullptr && path.suction ? saturation_of(*curve, suction, path, point)
                                                              : path.saturation.value_or(0.0));
    point.initialize(path.overconsolidation_ratio);
    const std::vector<StateVariable>& variables = material.state_variables();
    for (std::size_t s = 0; s < variables.size(); ++s) {
        if (const auto given = path.state.find(variables[s].name); given != path.state.end())
            point.set_state(s, given->second);
        if (!std::isfinite(point.state(s)))
            throw std::runtime_error(
                fmt::format("the law makes no finite '{}' of the stress at the start; give it in [initial.state]",
                            variables[s].name));
    }
    return point;
}

PathRecord drive_path(const PathDescription& path, const Material& material, const Retention* curve)
{
    PathRecord record;
    record.rows.push_back({0, 0, 0.0, initial_point(path, material, curve)});
    Drive drive{path, curve, record};
    for (std::size_t s = 0; s < path.stages.size(); ++s)
        if (!drive.make(path.stages[s], s + 1))
            break;
    return record;
}

} // namespace periporo
