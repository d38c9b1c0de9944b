// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A law pulled apart carries no more tension than it claims.
#pragma once

#include "periporo/kit/points.hpp"

#include <utility>

namespace periporo::kit {

/// A thousandth of the least pressure of the range counts as no tension [Pa].
inline double tension_slack(const Range& range)
{
    return 1e-3 * *std::min_element(range.pressures.begin(), range.pressures.end());
}

/// Pulls points apart: from all sides, in one direction, and with shear, in steps of every size of the range. The mean
/// tension must stay below `Range::tension_limit`. (Not the largest principal stress: an ellipse in p and q that begins
/// at p = 0 has principal tension.) A step that the law refuses with a status ends its path.
inline Faults check_tension(const Material& material, const Range& range = {})
{
    constexpr int steps = 500; // a soil that softens by volume loses its last strength after tens of per cent
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random))
        for (const double size : range.strain_increments) {
            SymmetricTensor<double> aslant = deviator(random.tensor(1.0)) + SymmetricTensor<double>::isotropic(0.3);
            aslant *= 1.0 / norm(aslant);
            const std::pair<const char*, SymmetricTensor<double>> directions[] = {
                {"from all sides", SymmetricTensor<double>::isotropic(0.577)},
                {"in one direction", {0.0, 0.0, 1.0, 0.0, 0.0, 0.0}},
                {"with shear", aslant}};
            for (const auto& [name, direction] : directions) {
                MaterialPoint point = start;
                for (int step = 1; step <= steps; ++step) {
                    const double round_off = range.accuracy * stress_scale(material, point.stress(), direction * size);
                    if (!point.step(direction * size, range.time_step).converged)
                        break;
                    const double tension = -mean_pressure(point.stress());
                    if (!(tension <= range.tension_limit + tension_slack(range) + round_off))
                        return {sentence("tension: pulled ", name, " by ", size,
                                         " a step from p = ", mean_pressure(start.stress()),
                                         " Pa, the point bears a mean tension of ", tension, " Pa after ", step,
                                         " steps; the limit is ", range.tension_limit, " Pa")};
                }
            }
        }
    return {};
}

} // namespace periporo::kit
