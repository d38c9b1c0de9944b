// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The law does not know directions of its own: turned stress and strain give the turned answer.
#pragma once

#include "periporo/kit/points.hpp"

namespace periporo::kit {

/// Walks random strain paths and the same paths turned by a random rotation. State variables are numbers that a
/// rotation leaves as they are; the framework turns the stress and nothing else.
inline Faults check_objectivity(const Material& material, const Range& range = {})
{
    constexpr int steps = 20;
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random)) {
        for (const double size : range.strain_increments) {
            const Tensor<double> rotation = random.rotation();
            MaterialPoint point = start;
            MaterialPoint turned = starting_point(material, range, rotated(start.stress(), rotation));
            double scale = 0.0;
            for (int step = 0; step <= steps; ++step) {
                // before the first step: the states that initialize found
                Values expected = values(point);
                expected.stress = rotated(expected.stress, rotation);
                const std::string fault =
                    difference(values(turned), expected, material,
                               range.accuracy * scale + 1e-14 * norm(start.stress()), range.accuracy);
                if (!fault.empty())
                    return {sentence("objectivity: with everything turned, after ", step, " steps of ", size,
                                     " from p = ", mean_pressure(start.stress()), " Pa ", fault)};
                const SymmetricTensor<double> strain = random.tensor(size);
                scale = std::max(scale, stress_scale(material, point.stress(), strain));
                const MaterialPoint before = point;
                if (const MaterialStatus status = point.step(strain, range.time_step); !status.converged)
                    return {stopped("objectivity", before, strain, status)};
                if (const MaterialStatus status = turned.step(rotated(strain, rotation), range.time_step);
                    !status.converged)
                    return {stopped("objectivity", turned, rotated(strain, rotation), status)};
            }
        }
    }
    return {};
}

} // namespace periporo::kit
