// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A sand for Drucker-Prager and Mohr-Coulomb, and paths that shear it under a held stress.
#pragma once

#include "law_driver.hpp"
#include "material/drucker_prager/drucker_prager.hpp"
#include "material/mohr_coulomb/mohr_coulomb.hpp"

#include <numbers>

namespace periporo::test {

inline constexpr double bulk_modulus = 25e6;
inline constexpr double shear_modulus = 15e6;
inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr double time_step = 1e-4;

/// A sand with phi = 35 and psi = 10 degrees, no cohesion; angles in `changes` are in degrees.
template <class Law>
Parameters sand(std::map<std::string, double> changes = {}, const std::string& match = "compression")
{
    changes.insert({{"bulk_modulus", bulk_modulus},
                    {"shear_modulus", shear_modulus},
                    {"friction_angle", 35.0},
                    {"dilatancy_angle", 10.0},
                    {"cohesion", 0.0}});
    for (const char* angle : {"friction_angle", "dilatancy_angle"})
        changes[angle] *= degree;
    Parameters values = parameter_values(Law::parameters(), changes);
    if constexpr (std::is_same_v<Law, DruckerPrager>)
        values.set("match", match);
    return values;
}

/// The isotropic strain of Hooke's law: C^-1 sigma.
inline Strain elastic_strain(const Stress& stress)
{
    return deviator(stress) * (0.5 / shear_modulus) + Strain::isotropic(trace(stress) / (9.0 * bulk_modulus));
}

inline constexpr Strain radial = {1.0, 1.0, 0.0, 0.0, 0.0, 0.0};   // free in a triaxial test about zz
inline constexpr Strain in_plane = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}; // free in plane strain, yy fixed

/// One step of `axial` strain along zz and of that much along `free` which leaves the stress xx where it is.
/// Both laws are piecewise linear, so the secant method ends in a few iterations.
inline void step_holding_xx(MaterialPoint& point, double axial, const Strain& free)
{
    const double held = point.stress().xx;
    const auto strain = [&](double x) { return Strain{0.0, 0.0, axial, 0.0, 0.0, 0.0} + free * x; };
    const auto off = [&](double x) {
        MaterialPoint probe = point;
        if (const MaterialStatus status = probe.step(strain(x), time_step); !status.converged)
            throw std::runtime_error(status.reason);
        return probe.stress().xx - held;
    };
    double x0 = -0.1 * axial, x1 = -0.5 * axial;
    double r0 = off(x0), r1 = off(x1);
    for (int iteration = 0; iteration < 50 && std::abs(r1) > 1e-12 * std::abs(held); ++iteration) {
        const double next = x1 - r1 * (x1 - x0) / (r1 - r0);
        x0 = x1, r0 = r1;
        x1 = next, r1 = off(next);
    }
    if (!(std::abs(r1) <= 1e-12 * std::abs(held)))
        throw std::runtime_error("the held stress was not found");
    point.step(strain(x1), time_step);
}

/// A point that has been sheared from 1 kPa of pressure until it has long yielded: 200 steps of `axial` strain.
inline MaterialPoint sheared(const Material& material, double axial, const Strain& free)
{
    MaterialPoint point(material, Stress::isotropic(-1000.0));
    for (int n = 0; n < 200; ++n)
        step_holding_xx(point, axial, free);
    return point;
}

/// A point of any stress and opening in a step of any size, most of them beyond the surface.
template <class Law>
LawInput<double, 3> random_input(Random& random)
{
    LawInput<double, 3> input{};
    const double shear = std::pow(10.0, random.number(-1.5, 0.5)); // beside volume
    const double strain = std::pow(10.0, random.number(-6.0, -2.0));
    input.stress = Stress::isotropic(random.number(-2000.0, 100.0)) + deviator(random.tensor(1000.0 * shear));
    input.strain_increment =
        Strain::isotropic(random.number(-strain, strain)) + deviator(random.tensor(strain * shear));
    input.state = {std::max(0.0, random.number(-1e-4, 1e-4)), random.number(0.0, 1.0), random.number(-0.1, 0.1)};
    input.time_step = time_step;
    return input;
}

/// The elastic stress after the step, and its size with what the opening takes from it: round-off is relative to that.
inline Stress trial_stress(const LawInput<double, 3>& input)
{
    return elastic_stress(input.stress, input.strain_increment, bulk_modulus, shear_modulus);
}
inline double size_of(const LawInput<double, 3>& input)
{
    return norm(trial_stress(input)) + 2.0 * bulk_modulus * input.state[FrictionalSoil::opening] + 1.0;
}

} // namespace periporo::test
