// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Expresses each kind of stage by controlled components.
#include "drive/stage_plan.hpp"

#include <cmath>

namespace periporo {
namespace {

enum Component : std::size_t { xx, yy, zz, xy, yz, xz };

/// Nothing moves: all strains are held.
StagePlan at_rest(const MaterialPoint& point)
{
    StagePlan plan;
    plan.start.suction = plan.target.suction = point.suction();
    plan.start.saturation = plan.target.saturation = point.saturation();
    plan.wet = point.suction() > 0.0 || point.saturation() > 0.0;
    return plan;
}

/// Puts a component under control of its stress.
void control_stress(StagePlan& plan, std::size_t component, const MaterialPoint& point, double target)
{
    plan.stress_controlled[component] = true;
    plan.start.components[component] = components(point.stress())[component];
    plan.target.components[component] = target;
}

void hold_stress(StagePlan& plan, std::size_t component, const MaterialPoint& point)
{
    control_stress(plan, component, point, components(point.stress())[component]);
}

void set_water(StagePlan& plan, const std::optional<double>& suction, const std::optional<double>& saturation)
{
    plan.target.suction = suction.value_or(plan.start.suction);
    plan.target.saturation = saturation.value_or(plan.start.saturation);
    plan.wet = plan.wet || suction || saturation;
}

/// One overload for each kind of stage.
struct Planner {
    const MaterialPoint& point;

    StagePlan operator()(const IsotropicStage& stage) const
    {
        StagePlan plan = at_rest(point);
        const double pressure_change = stage.target.value - mean_pressure(point.stress());
        for (const std::size_t c : {xx, yy, zz}) {
            if (stage.target.is_stress)
                control_stress(plan, c, point, components(point.stress())[c] - pressure_change);
            else
                plan.target.components[c] = -stage.target.value / 3.0;
        }
        return plan;
    }

    StagePlan operator()(const OedometricStage& stage) const
    {
        StagePlan plan = at_rest(point);
        move_axially(plan, stage.target.is_stress, -stage.target.value);
        return plan;
    }

    StagePlan operator()(const DrainedTriaxialStage& stage) const
    {
        StagePlan plan = at_rest(point);
        hold_stress(plan, xx, point);
        hold_stress(plan, yy, point);
        const double lateral = 0.5 * (point.stress().xx + point.stress().yy);
        move_axially(plan, stage.target.is_stress, (stage.target.is_stress ? lateral : 0.0) - stage.target.value);
        return plan;
    }

    StagePlan operator()(const UndrainedTriaxialStage& stage) const
    {
        StagePlan plan = at_rest(point);
        plan.target.components[xx] = plan.target.components[yy] = 0.5 * stage.axial_compression;
        plan.target.components[zz] = -stage.axial_compression;
        return plan;
    }

    StagePlan operator()(const SimpleShearStage& stage) const
    {
        StagePlan plan = at_rest(point);
        plan.simple_shear = true;
        if (!stage.constant_height)
            hold_stress(plan, zz, point);
        if (stage.target.is_stress)
            control_stress(plan, xz, point, stage.target.value);
        else
            plan.target.components[xz] = 0.5 * stage.target.value;
        return plan;
    }

    StagePlan operator()(const TrueTriaxialStage& stage) const
    {
        StagePlan plan = at_rest(point);
        for (const std::size_t c : {xx, yy, zz}) {
            if (stage.stress_controlled)
                control_stress(plan, c, point, -stage.targets[c]);
            else
                plan.target.components[c] = -stage.targets[c];
        }
        return plan;
    }

    StagePlan operator()(const SuctionStage& stage) const
    {
        StagePlan plan = at_rest(point);
        set_water(plan, stage.suction, stage.saturation);
        plan.total_stress = stage.total_stress_held;
        const double of_water = plan.total_stress ? point.saturation() * point.suction() : 0.0;
        for (std::size_t c = 0; c < 6; ++c) {
            hold_stress(plan, c, point);
            if (c <= zz)
                for (StageValues* values : {&plan.start, &plan.target})
                    values->components[c] += of_water;
        }
        return plan;
    }

    StagePlan operator()(const MixedStage& stage) const
    {
        StagePlan plan = at_rest(point);
        set_water(plan, stage.suction, stage.saturation);
        plan.simple_shear = stage.simple_shear;
        for (std::size_t c = 0; c < 6; ++c) {
            if (stage.stress[c])
                control_stress(plan, c, point, *stage.stress[c]);
            else if (stage.stress_held[c])
                hold_stress(plan, c, point);
            else
                plan.target.components[c] = stage.strain[c];
        }
        return plan;
    }

private:
    void move_axially(StagePlan& plan, bool is_stress, double target) const
    {
        if (is_stress)
            control_stress(plan, zz, point, target);
        else
            plan.target.components[zz] = target;
    }
};

} // namespace

StageValues StagePlan::at(double way) const
{
    // std::lerp ends exactly at its ends
    StageValues values;
    for (std::size_t c = 0; c < 6; ++c)
        values.components[c] = std::lerp(start.components[c], target.components[c], way);
    values.suction = std::lerp(start.suction, target.suction, way);
    values.saturation = std::lerp(start.saturation, target.saturation, way);
    return values;
}

StagePlan plan_stage(const StageKind& kind, const MaterialPoint& point)
{
    return std::visit(Planner{point}, kind);
}

} // namespace periporo
