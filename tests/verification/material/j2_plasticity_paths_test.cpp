// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// J2 plasticity along paths whose whole course is known exactly.
#include "j2_clay.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

TEST_CASE("uniaxial stress grows with Young's modulus to the yield stress and stays, in tension and in compression")
{
    const ClayMaterial clay(clay_parameters());
    for (const double sign : {1.0, -1.0}) {
        MaterialPoint point(clay);
        for (int n = 1; n <= 20; ++n) {
            step_triaxial(point, sign * 1e-4);
            // the driver leaves 1e-7 Pa of lateral stress in each of 20 steps
            CHECK(sign * point.stress().xx ==
                  doctest::Approx(std::min(young_modulus * 1e-4 * n, yield_stress)).epsilon(1e-8));
        }
        CHECK(young_modulus * 20e-4 > 2.0 * yield_stress);
    }
}

TEST_CASE("linear hardening gives the uniaxial slope E H/(E + H)")
{
    const double modulus = 2e6;
    const ClayMaterial clay(clay_parameters({{"hardening_modulus", modulus}}));
    MaterialPoint point(clay);
    const double slope = young_modulus * modulus / (young_modulus + modulus);
    for (int n = 1; n <= 40; ++n) {
        step_triaxial(point, 2e-4);
        const double beyond = 2e-4 * n - yield_stress / young_modulus;
        if (beyond > 0.0) // the driver leaves 1e-7 Pa in each of 40 steps
            CHECK(point.stress().xx == doctest::Approx(yield_stress + slope * beyond).epsilon(1e-8));
    }
}

TEST_CASE("pure shear yields at the yield stress over sqrt(3)")
{
    const ClayMaterial clay(clay_parameters());
    MaterialPoint point(clay);
    for (int n = 1; n <= 20; ++n) {
        step(point, simple_shear(3e-4));
        CHECK(point.stress().xy ==
              doctest::Approx(std::min(shear_modulus * 3e-4 * n, yield_stress / std::sqrt(3.0))).epsilon(1e-13));
    }
    CHECK(shear_modulus * 20 * 3e-4 > 2.0 * yield_stress);
}

TEST_CASE("proportional shear follows the hardening curve exactly, in steps of any size")
{
    // backward Euler is exact where the direction of flow does not turn
    const Strain direction = Strain{0.7, -0.4, -0.3, 0.5, -0.2, 0.1};
    for (const Hardening& hardening : {Hardening{0.0, 25e3, 40.0}, Hardening{3e5, 25e3, 40.0},
                                       Hardening{0.0, 2e3, 20.0}, Hardening{1e5, 2e3, 20.0}}) {
        CAPTURE(hardening.modulus);
        CAPTURE(hardening.saturation_stress);
        const ClayMaterial clay(clay_parameters(hardening.parameters()));
        for (const double factor : {1.01, 2.0, 100.0}) {
            CAPTURE(factor);
            MaterialPoint point(clay);
            double reached = 0.0;
            for (double plastic = 1e-4; plastic < 2.0; plastic *= factor) {
                const double stress = hardening.yield(plastic);
                const double total = plastic + stress / (3.0 * shear_modulus);
                step(point, direction * ((total - reached) / equivalent_shear_strain(direction)));
                reached = total;
                // some hundred strains, each rounded to 1e-16 of the sum
                CHECK(point.state(Clay::hardening_strain) / plastic == doctest::Approx(1.0).epsilon(1e-11));
                CHECK(deviator_stress(point.stress()) == doctest::Approx(stress).epsilon(1e-11));
            }
        }
    }
}

TEST_CASE("the mean stress is elastic along any path, in tension too")
{
    const ClayMaterial clay(clay_parameters(Hardening{1e5, 25e3, 40.0}.parameters()));
    Random random;
    MaterialPoint point(clay);
    for (int n = 0; n < 200; ++n) {
        step(point, random.tensor(1e-2) + Strain::isotropic(1e-3));
        // stresses of up to some 1e7 Pa are summed 200 times
        CHECK(std::abs(mean_pressure(point.stress()) + bulk_modulus * trace(point.strain())) <= 1e-6);
    }
    CHECK(mean_pressure(point.stress()) < -1e6);
    CHECK(point.state(Clay::shear_strain) > 0.1);
}

TEST_CASE("unloading and reloading inside the surface closes, with the state untouched")
{
    const ClayMaterial clay(clay_parameters(Hardening{1e5, 25e3, 40.0}.parameters()));
    MaterialPoint point(clay);
    for (int n = 0; n < 20; ++n)
        step(point, simple_shear(1e-3));
    const Stress loaded = point.stress();
    const double hardening = point.state(Clay::hardening_strain);
    const double elastic = loaded.xy / shear_modulus;         // shear strain from the surface to no stress
    for (const double part : {-1.0, -0.99, 0.5, 0.4, 1.09}) { // sums to zero
        step(point, simple_shear(part * elastic));
        CHECK(point.state(Clay::hardening_strain) == hardening);
    }
    CHECK(norm(point.stress() - loaded) <= 1e-14 * norm(loaded));
}

TEST_CASE("hardening is the same in the opposite direction")
{
    const ClayMaterial clay(clay_parameters({{"hardening_modulus", 1e6}}));
    MaterialPoint point(clay);
    step(point, simple_shear(0.02));
    const double forth = point.stress().xy;
    step(point, simple_shear(-2.0 * forth / shear_modulus * 1.0001));
    CHECK(point.stress().xy == doctest::Approx(-forth).epsilon(1e-4)); // the ten-thousandth beyond is plastic
    CHECK(forth > 1.5 * yield_stress / std::sqrt(3.0));
}

TEST_CASE("a turning direction of shear converges with the step to the exact solution")
{
    // Krieg and Krieg (1977): at constant strain rate the angle psi between s and the rate obeys
    // tan(psi/2) = tan(psi0/2) exp(-2 G |eps|/R), with R = sqrt(2/3) sigma_y the length of s
    const ClayMaterial clay(clay_parameters());
    const double radius = std::sqrt(2.0 / 3.0) * yield_stress;
    const double length = radius / (2.0 * shear_modulus);
    const double exact = 2.0 * std::atan(std::exp(-1.0)); // from a right angle
    const auto error = [&](int steps) {
        MaterialPoint point(clay, Stress{2.0, -1.0, -1.0, 0.0, 0.0, 0.0} * (radius / std::sqrt(6.0)));
        for (int n = 0; n < steps; ++n)
            step(point, Strain{0.0, 0.0, 0.0, length / std::sqrt(2.0) / steps, 0.0, 0.0});
        return std::acos(std::sqrt(2.0) * point.stress().xy / radius) - exact;
    };
    // e = c h + d h^2 gives 2 + O(h)
    CHECK(error(40) / error(80) == doctest::Approx(2.0).epsilon(0.05));
    CHECK(std::abs(error(80)) < 0.01);
}

TEST_CASE("steady simple shear is the Bingham fluid tau = sigma_y/sqrt(3) + eta d gamma/dt")
{
    const double viscosity = 5e4; // relaxes in eta/G = 10 ms
    const ClayMaterial clay(clay_parameters({{"viscosity", viscosity}}));
    for (const double rate : {1e-3, 1e-1, 1e1}) {
        CAPTURE(rate);
        MaterialPoint point(clay);
        for (int n = 0; n < 200; ++n) // the distance halves in each step of 10 ms, once yielding
            step(point, simple_shear(rate * (rate < 1e-2 ? 1.0 : 0.01)), rate < 1e-2 ? 1.0 : 0.01);
        CHECK(point.stress().xy == doctest::Approx(yield_stress / std::sqrt(3.0) + viscosity * rate).epsilon(1e-12));
    }
}

TEST_CASE("without a yield stress it is a Newtonian fluid")
{
    const ClayMaterial fluid(clay_parameters({{"viscosity", 5e4}, {"yield_stress", 0.0}}));
    MaterialPoint point(fluid);
    for (int n = 0; n < 200; ++n)
        step(point, simple_shear(0.1), 0.01);
    CHECK(point.stress().xy == doctest::Approx(5e4 * 10.0).epsilon(1e-12));
}

TEST_CASE("an overstress at held strain fades in the time eta/G")
{
    const double viscosity = 5e4, time = viscosity / shear_modulus;
    const ClayMaterial clay(clay_parameters({{"viscosity", viscosity}}));
    for (const int steps : {10, 100, 1000}) {
        CAPTURE(steps);
        MaterialPoint point(clay, Stress{0.0, 0.0, 0.0, 2.0 * yield_stress / std::sqrt(3.0), 0.0, 0.0});
        for (int n = 0; n < steps; ++n)
            step(point, Strain{}, time / steps);
        const double left = (deviator_stress(point.stress()) - yield_stress) / yield_stress;
        // backward Euler: (1 + h)^(-1/h) = exp(-1) (1 + h/2 - 5/24 h^2 + ...)
        const double h = 1.0 / steps;
        CHECK(std::abs(left * std::exp(1.0) - (1.0 + 0.5 * h)) <= 0.25 * h * h);
    }
}
