// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The states that checks start from, and how two outcomes are compared.
#pragma once

#include "periporo/kit/random.hpp"
#include "periporo/kit/range.hpp"
#include "periporo/kit/text.hpp"
#include "periporo/material_point.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace periporo::kit {

/// Stress and state variables of one point.
struct Values {
    SymmetricTensor<double> stress;
    std::vector<double> state;
};

inline Values values(const MaterialPoint& point)
{
    Values result{point.stress(), {}};
    for (std::size_t s = 0; s < point.material().state_variables().size(); ++s)
        result.state.push_back(point.state(s));
    return result;
}

inline bool finite(const SymmetricTensor<double>& a)
{
    return std::isfinite(a.xx) && std::isfinite(a.yy) && std::isfinite(a.zz) && std::isfinite(a.xy) &&
           std::isfinite(a.yz) && std::isfinite(a.xz);
}

/// Largest factor between the norms of a strain and of its elastic stress, max(3 K, 2 G) [Pa].
inline double largest_stiffness(const Material& material)
{
    return std::max(3.0 * material.bulk_modulus(), 2.0 * material.shear_modulus());
}

/// The size of the stresses that a step handles [Pa]; round-off is relative to it.
inline double stress_scale(const Material& material, const SymmetricTensor<double>& stress,
                           const SymmetricTensor<double>& strain_increment)
{
    return norm(stress) + largest_stiffness(material) * norm(strain_increment);
}

/// Says what differs by more than `stress_tolerance` [Pa], or by more than `state_tolerance` times (1 + |value|) for a
/// state variable; empty when nothing does. Zero tolerances ask for the same bits.
inline std::string difference(const Values& found, const Values& expected, const Material& material,
                              double stress_tolerance, double state_tolerance)
{
    if (!(norm(found.stress - expected.stress) <= stress_tolerance))
        return sentence("the stress is ", text(found.stress), " Pa and not ", text(expected.stress), " Pa, off by ",
                        norm(found.stress - expected.stress), " Pa where ", stress_tolerance, " Pa are round-off");
    for (std::size_t s = 0; s < expected.state.size(); ++s)
        if (!(std::abs(found.state[s] - expected.state[s]) <= state_tolerance * (1.0 + std::abs(expected.state[s]))))
            return sentence("the state variable ", material.state_variables()[s].name, " is ", found.state[s],
                            " and not ", expected.state[s], ", off by ", found.state[s] - expected.state[s]);
    return {};
}

/// An isotropic stress of the mean pressure p [Pa] with a deviator of any direction, q/p up to `stress_ratio`.
inline SymmetricTensor<double> random_stress(Random& random, double pressure, double stress_ratio)
{
    const SymmetricTensor<double> direction = deviator(random.tensor(1.0));
    const double shear = random.number(0.0, stress_ratio) * pressure;
    return SymmetricTensor<double>::isotropic(-pressure) + direction * (shear / deviator_stress(direction));
}

/// A point under a stress, with the water and the overconsolidation ratio of the range.
inline MaterialPoint starting_point(const Material& material, const Range& range, const SymmetricTensor<double>& stress)
{
    MaterialPoint point(material, stress);
    point.set_water(range.suction, range.saturation);
    point.initialize(range.overconsolidation_ratio);
    return point;
}

/// For each pressure a point under isotropic stress and four under a deviator too.
inline std::vector<MaterialPoint> starting_points(const Material& material, const Range& range, Random& random)
{
    std::vector<MaterialPoint> points;
    for (const double pressure : range.pressures)
        for (int n = 0; n < 5; ++n) {
            const double stress_ratio = n == 0 ? 0.0 : range.stress_ratio;
            points.push_back(starting_point(material, range, random_stress(random, pressure, stress_ratio)));
        }
    return points;
}

/// A check stopped because an ordinary step failed.
inline std::string stopped(const char* check, const MaterialPoint& before, const SymmetricTensor<double>& strain,
                           const MaterialStatus& status)
{
    return sentence(check, ": a step of ordinary size fails (", reason_text(status.reason), ") at the stress ",
                    text(before.stress()), " Pa with the strain increment ", text(strain));
}

} // namespace periporo::kit
