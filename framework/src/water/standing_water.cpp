// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The lift of standing water, with its work.
#include "water/standing_water.hpp"

#include "state/ordered_sum.hpp"

#include <array>
#include <utility>

namespace periporo {

double add_buoyancy(const Model& model, std::vector<double>& buoyancy, std::vector<Vector3>& force)
{
    const StandingWater water(model);
    if (buoyancy.empty() && !water.anywhere())
        return 0.0;
    buoyancy.resize(model.size(), 0.0);
    return ordered_sums<1>(model.size(), [&](std::size_t i, std::array<double, 1>& power) {
        const double now = water.buoyancy_of(i);
        const double before = std::exchange(buoyancy[i], now);
        power[0] += 0.5 * (before + now) * water.up().dot(model.state.points.velocity[i]);
        force[i] += now * water.up();
    })[0];
}

} // namespace periporo
