// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/rest.hpp"

#include "assembly/held_points.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {
namespace {

/// Does an obstacle or a region of points move as the case says?
bool is_driven(const Model& model, const CaseDescription& description, const StageDescription& stage)
{
    return std::ranges::any_of(model.state.obstacles, [](const Obstacle& o) { return !o.velocity.isZero(0.0); }) ||
           std::ranges::any_of(description.held_regions, [&stage](const HeldRegionDescription& region) {
               return !region.velocity.isZero(0.0) && applies_in(region.stages, stage);
           });
}

/// Time of a free fall over the height of the model [s].
double time_of_fall(const Model& model, const Vector3& gravity)
{
    const double g = gravity.norm();
    double lowest = INFINITY, highest = -INFINITY;
    for (const Vector3& x : model.state.points.initial_position) {
        const double height = -x.dot(gravity) / g;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    return std::sqrt(2.0 * std::max(highest - lowest, model.state.spacing) / g);
}

} // namespace

RestRule rest_rule(const Model& model, const CaseDescription& description, const StageDescription& stage, double from)
{
    constexpr double windows_of_fall = 8.0, spacings_of_window = 0.1;
    RestRule rule{stage.rest_speed.value(), stage.residual, 0.0, from, INFINITY};
    if (!(description.gravity.norm() > 0.0)) {
        rule.window = spacings_of_window * model.state.spacing / rule.speed;
        return rule;
    }
    const double fall = time_of_fall(model, description.gravity);
    rule.window = fall / windows_of_fall;
    if (!is_driven(model, description, stage))
        rule.believed_from = from + fall;
    return rule;
}

} // namespace periporo
