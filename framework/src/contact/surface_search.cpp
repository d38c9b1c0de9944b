// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures how far points and obstacles have moved since a search.
#include "contact/surface_search.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {

SurfaceSearch SurfaceSearch::at_present(const Model& model)
{
    SurfaceSearch search;
    search.positions = model.state.points.position;
    search.shifts.resize(model.state.obstacles.size());
    std::ranges::transform(model.state.obstacles, search.shifts.begin(), &Obstacle::shift);
    return search;
}

bool SurfaceSearch::is_outdated(const Model& model) const
{
    if (!fits(model))
        return true;
    const std::vector<Vector3>& now = model.state.points.position;
    double points = 0.0;
#pragma omp parallel for schedule(static) reduction(max : points)
    for (std::size_t i = 0; i < now.size(); ++i)
        points = std::max(points, (now[i] - positions[i]).squaredNorm());
    double obstacles = 0.0;
    for (std::size_t o = 0; o < shifts.size(); ++o)
        obstacles = std::max(obstacles, (model.state.obstacles[o].shift - shifts[o]).norm());
    return std::sqrt(points) + obstacles > skin * model.state.spacing;
}

} // namespace periporo
