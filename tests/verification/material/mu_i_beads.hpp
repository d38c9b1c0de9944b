// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Glass beads, as the tests of the mu(I) law use them.
#pragma once

#include "law_driver.hpp"
#include "material/mu_i_rheology/mu_i_rheology.hpp"

namespace periporo::test {

inline constexpr double bulk_modulus = 2.5e6;
inline constexpr double shear_modulus = 1.5e6;
// Jop, Forterre and Pouliquen (2006): tan 20.9 and tan 32.76 degrees
inline constexpr double static_friction = 0.3819;
inline constexpr double limiting_friction = 0.6435;
inline constexpr double reference_number = 0.279;
inline constexpr double grain_diameter = 0.53e-3;
inline constexpr double solid_density = 2450.0;

using Beads = MuIRheology;
using BeadMaterial = LawMaterial<Beads>;

inline Parameters bead_parameters(std::map<std::string, double> changes = {})
{
    changes.insert({{"bulk_modulus", bulk_modulus},
                    {"shear_modulus", shear_modulus},
                    {"static_friction", static_friction},
                    {"limiting_friction", limiting_friction},
                    {"reference_inertial_number", reference_number},
                    {"grain_diameter", grain_diameter},
                    {"solid_density", solid_density}});
    return parameter_values(Beads::parameters(), changes);
}

/// mu_s + (mu_2 - mu_s)/(1 + I_0/I)
inline double friction(double inertial_number)
{
    return static_friction + (limiting_friction - static_friction) / (1.0 + reference_number / inertial_number);
}

/// The shear rate at which beads under p [Pa] have an inertial number: I sqrt(p/rho_s)/d [1/s].
inline double shear_rate(double inertial_number, double pressure)
{
    return inertial_number * std::sqrt(pressure / solid_density) / grain_diameter;
}

/// A strain of simple shear by gamma = 2 eps_xy.
inline Strain simple_shear(double gamma)
{
    return {0.0, 0.0, 0.0, 0.5 * gamma, 0.0, 0.0};
}

/// sqrt(s:s/2) [Pa], which is |sigma_xy| in simple shear.
inline double flow_stress(const Stress& stress)
{
    return norm(deviator(stress)) / std::sqrt(2.0);
}

} // namespace periporo::test
