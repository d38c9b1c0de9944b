// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A clay of von Mises type, as the tests of J2 plasticity use it.
#pragma once

#include "law_driver.hpp"
#include "material/j2_plasticity/j2_plasticity.hpp"

namespace periporo::test {

inline constexpr double bulk_modulus = 20e6;
inline constexpr double shear_modulus = 5e6;
inline constexpr double young_modulus = 9.0 * bulk_modulus * shear_modulus / (3.0 * bulk_modulus + shear_modulus);
inline constexpr double yield_stress = 10e3;

using Clay = J2Plasticity;
using ClayMaterial = LawMaterial<Clay>;

/// A clay with these parameters; without any it is perfectly plastic.
inline Parameters clay_parameters(std::map<std::string, double> changes = {})
{
    changes.insert({{"bulk_modulus", bulk_modulus}, {"shear_modulus", shear_modulus}, {"yield_stress", yield_stress}});
    return parameter_values(Clay::parameters(), changes);
}

/// yield_stress + H e + (saturation_stress - yield_stress)(1 - exp(-saturation_rate e)) [Pa]
struct Hardening {
    double modulus = 0.0;
    double saturation_stress = yield_stress;
    double rate = 1.0;

    double yield(double strain) const
    {
        return yield_stress + modulus * strain + (saturation_stress - yield_stress) * (1.0 - std::exp(-rate * strain));
    }
    std::map<std::string, double> parameters() const
    {
        return {{"hardening_modulus", modulus}, {"saturation_stress", saturation_stress}, {"saturation_rate", rate}};
    }
};

/// A strain of simple shear by gamma = 2 eps_xy.
inline Strain simple_shear(double gamma)
{
    return {0.0, 0.0, 0.0, 0.5 * gamma, 0.0, 0.0};
}

} // namespace periporo::test
