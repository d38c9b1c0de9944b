// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The soil of the paper, as the tests of the critical-state law use it.
#pragma once

#include "law_driver.hpp"
#include "material/viscoplastic_critical_state/viscoplastic_critical_state.hpp"

namespace periporo::test {

inline constexpr double bulk_modulus = 25e6;
inline constexpr double shear_modulus = 15e6;
inline constexpr double critical_slope = 1.1;
inline constexpr double plastic_index = 0.12 - 0.04; // lambda - kappa
inline constexpr double floor_pressure = 20.0;

using Soil = ViscoplasticCriticalState;
using SoilMaterial = LawMaterial<Soil>;

inline Parameters soil_parameters(std::map<std::string, double> changes = {})
{
    changes.insert({{"bulk_modulus", bulk_modulus},
                    {"shear_modulus", shear_modulus},
                    {"critical_state_slope", critical_slope},
                    {"compression_index", 0.12},
                    {"swelling_index", 0.04},
                    {"viscosity", 0.0}});
    return parameter_values(Soil::parameters(), changes);
}

inline Soil soil(const std::map<std::string, double>& changes = {})
{
    return Soil(soil_parameters(changes));
}

/// What the law is given of a point under isotropic pressure p0 with preconsolidation pressure pc0 [Pa].
inline LawInput<double, 3> isotropic_input(double p0, double pc0)
{
    LawInput<double, 3> input{};
    input.stress = Stress::isotropic(-p0);
    input.state[Soil::log_preconsolidation] = std::log(pc0);
    input.time_step = 1e-4;
    return input;
}

/// A point of a soil under isotropic pressure p0 with preconsolidation pressure pc0 [Pa].
inline MaterialPoint isotropic_point(const SoilMaterial& soil, double p0, double pc0)
{
    MaterialPoint point(soil, Stress::isotropic(-p0));
    point.set_state(Soil::log_preconsolidation, std::log(pc0));
    return point;
}

inline double preconsolidation(const MaterialPoint& point)
{
    return std::exp(point.state(Soil::log_preconsolidation));
}

/// f = q^2/M^2 + p (p - pc) [Pa2] of a dry soil without tensile strength.
inline double yield_function(const Stress& stress, double pc)
{
    const double p = mean_pressure(stress);
    const double q = deviator_stress(stress);
    return q * q / (critical_slope * critical_slope) + p * (p - pc);
}

} // namespace periporo::test
