// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Controlled stresses along an edge of a yield surface, where many strains give one stress and the tangent is singular.
#include "material/mohr_coulomb/mohr_coulomb.hpp"
#include "periporo/material_point.hpp"
#include "support/paths.hpp"

using namespace periporo;
using namespace periporo::test;

TEST_CASE("drained triaxial compression and extension of an ideally plastic soil run along the edge of its pyramid")
{
    const double friction_angle = 34.0 / 180.0 * std::acos(-1.0);
    const double dilatancy_angle = 4.0 / 180.0 * std::acos(-1.0);
    Parameters parameters;
    for (const Parameter& record : MohrCoulomb::parameters())
        if (record.default_value)
            parameters.set(record.name, *record.default_value);
    for (const auto& [name, value] : {std::pair("bulk_modulus", 25e6), std::pair("shear_modulus", 15e6),
                                      std::pair("friction_angle", friction_angle),
                                      std::pair("dilatancy_angle", dilatancy_angle), std::pair("cohesion", 0.0)})
        parameters.set(name, value);
    const LawMaterial<MohrCoulomb> soil(parameters);
    const double ratio = (1.0 + std::sin(friction_angle)) / (1.0 - std::sin(friction_angle));
    for (const double direction : {-1.0, 1.0}) {
        CAPTURE(direction);
        MaterialPoint point(soil, SymmetricTensor<double>::isotropic(-20e3));
        MixedStep step{{true, true, false, false, false, false}, {0.0, 0.0, direction * 5e-4, 0.0, 0.0, 0.0}, 1.0};
        for (int n = 0; n < 40; ++n)
            REQUIRE(point.step(step).converged);
        CHECK(point.stress().zz == doctest::Approx(direction < 0.0 ? -20e3 * ratio : -20e3 / ratio).epsilon(1e-9));
        // of all pairs of lateral strains the least: the two alike. Each step leaves what differences of a stress of
        // 20 kPa over strains of 1e-10 make of round-off
        CHECK(point.strain().xx == doctest::Approx(point.strain().yy).epsilon(1e-6).scale(0.0));
    }
}
