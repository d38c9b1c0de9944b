// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/rest.hpp"

#include "scheduler/held_points.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {
namespace {

/// Does an obstacle or a region of points move as the case says?
bool is_driven(const Model& model, const CaseDescription& description, const StageDescription& stage)
{
    return std::ranges::any_of(model.obstacles, [](const Obstacle& o) { return !o.velocity.isZero(0.0); }) ||
           std::ranges::any_of(description.held_regions, [&stage](const HeldRegionDescription& region) {
               return !region.velocity.isZero(0.0) && applies_in(region.stages, stage);
           });
}

} // namespace

double time_to_get_going(const Model& model, const CaseDescription& description, const StageDescription& stage)
{
    const double g = description.gravity.norm();
    if (!(g > 0.0) || is_driven(model, description, stage))
        return INFINITY;
    double lowest = INFINITY, highest = -INFINITY;
    for (const Vector3& x : model.points.initial_position) {
        const double height = -x.dot(description.gravity) / g;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    return std::sqrt(2.0 * (highest - lowest) / g);
}

} // namespace periporo
