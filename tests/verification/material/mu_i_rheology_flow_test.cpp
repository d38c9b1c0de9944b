// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The mu(I) law in flow: steady shear, rest, relaxation and opening against closed forms.
#include "mu_i_beads.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

// tau/p of simple shear at a rate [1/s], begun from isotropic pressure [Pa] and long since steady.
double steady_friction(const BeadMaterial& beads, double pressure, double rate)
{
    MaterialPoint point(beads, Stress::isotropic(-pressure));
    // an elastic stress of 15 times p a step: what was before is forgotten at once
    const double strain = 15.0 * pressure / shear_modulus;
    for (int n = 0; n < 200; ++n)
        step(point, simple_shear(strain), strain / rate);
    return point.stress().xy / mean_pressure(point.stress());
}

} // namespace

TEST_CASE("steady simple shear gives tau/p = mu(I), over eight decades of I")
{
    const BeadMaterial beads(bead_parameters());
    for (double number = 1e-5; number < 2e3; number *= 10.0) {
        CAPTURE(number);
        // steady, the implicit step is exact; 200 steps are rounded
        CHECK(steady_friction(beads, 1000.0, shear_rate(number, 1000.0)) ==
              doctest::Approx(friction(number)).epsilon(1e-12));
    }
}

TEST_CASE("the slowest flow has the static friction whatever its rate, the fastest the limiting one")
{
    const BeadMaterial beads(bead_parameters());
    for (const double number : {1e-8, 1e-10, 1e-12})
        CHECK(steady_friction(beads, 1000.0, shear_rate(number, 1000.0)) ==
              doctest::Approx(static_friction).epsilon(2.0 * number / reference_number + 1e-12));
    CHECK(steady_friction(beads, 1000.0, shear_rate(1e8, 1000.0)) ==
          doctest::Approx(limiting_friction).epsilon(reference_number / 1e8));
}

TEST_CASE("the rate of a friction grows as sqrt(p), and falls as d and as sqrt(rho_s)")
{
    const double rate = shear_rate(0.1, 1000.0);
    const double expected = steady_friction(BeadMaterial(bead_parameters()), 1000.0, rate);
    // 200 steps are rounded
    CHECK(steady_friction(BeadMaterial(bead_parameters()), 4000.0, 2.0 * rate) ==
          doctest::Approx(expected).epsilon(1e-12));
    CHECK(steady_friction(BeadMaterial(bead_parameters({{"grain_diameter", 3.0 * grain_diameter}})), 1000.0,
                          rate / 3.0) == doctest::Approx(expected).epsilon(1e-12));
    CHECK(steady_friction(BeadMaterial(bead_parameters({{"solid_density", 4.0 * solid_density}})), 1000.0,
                          rate / 2.0) == doctest::Approx(expected).epsilon(1e-12));
}

TEST_CASE("friction is the same in triaxial compression, q = sqrt(3) mu_s p")
{
    const double p0 = 1000.0, slope = std::sqrt(3.0) * static_friction;
    const BeadMaterial beads(bead_parameters());
    MaterialPoint point(beads, Stress::isotropic(-p0));
    for (int n = 0; n < 100; ++n)
        step_triaxial(point, -1e-4, 10.0);
    // with p = p0 + q/3; I is 1e-8, and the driver leaves 1e-7 Pa in each of 100 steps
    CHECK(mean_pressure(point.stress()) == doctest::Approx(3.0 * p0 / (3.0 - slope)).epsilon(1e-6));
    CHECK(deviator_stress(point.stress()) / mean_pressure(point.stress()) == doctest::Approx(slope).epsilon(1e-6));
}

TEST_CASE("below the static friction nothing flows, however long it waits")
{
    const BeadMaterial beads(bead_parameters());
    MaterialPoint point(beads, Stress::isotropic(-1000.0));
    step(point, simple_shear(0.999 * static_friction * 1000.0 / shear_modulus));
    const Stress loaded = point.stress();
    CHECK(loaded.xy == doctest::Approx(381.9 * 0.999).epsilon(1e-12));
    for (int n = 0; n < 100; ++n)
        step(point, Strain{}, 1e3);
    CHECK(components(point.stress()) == components(loaded));
    CHECK(point.state(Beads::shear_strain) == 0.0);
}

TEST_CASE("at held strain the stress falls to the static friction in the time that mu(I) gives")
{
    // x = tau - mu_s p obeys dx/dt = -a x/(m - x), a = G I_0 sqrt(p/rho_s)/d, m = (mu_2 - mu_s) p, so
    // m ln(x0/x) - (x0 - x) = a t
    const double p = 1000.0, x0 = 0.8 * (limiting_friction - static_friction) * p;
    const double a = shear_modulus * shear_rate(reference_number, p), m = (limiting_friction - static_friction) * p;
    const BeadMaterial beads(bead_parameters());
    const double duration = 2.0 * m / a;
    const auto error = [&](int steps) {
        Stress stress = Stress::isotropic(-p);
        stress.xy = static_friction * p + x0;
        MaterialPoint point(beads, stress);
        for (int n = 0; n < steps; ++n)
            step(point, Strain{}, duration / steps);
        const double x = point.stress().xy - static_friction * p;
        return (m * std::log(x0 / x) - (x0 - x)) / (a * duration) - 1.0;
    };
    // e = c h + d h^2 gives 2 + O(h)
    CHECK(error(400) / error(800) == doctest::Approx(2.0).epsilon(0.05));
    CHECK(std::abs(error(800)) < 0.01);
}

TEST_CASE("the plastic shear strain is the total less the elastic one, gamma over sqrt(3) in simple shear")
{
    const BeadMaterial beads(bead_parameters());
    MaterialPoint point(beads, Stress::isotropic(-1000.0));
    for (int n = 0; n < 100; ++n)
        step(point, simple_shear(1e-3));
    CHECK(point.state(Beads::shear_strain) ==
          doctest::Approx((0.1 - point.stress().xy / shear_modulus) / std::sqrt(3.0)).epsilon(1e-12).scale(0.0));
}

TEST_CASE("flow does not change the volume: the pressure is elastic while the mass is closed")
{
    const BeadMaterial beads(bead_parameters());
    Random random;
    MaterialPoint point(beads, Stress::isotropic(-1000.0));
    for (int n = 0; n < 500; ++n) {
        step(point, deviator(random.tensor(1e-2)) + Strain::isotropic(random.number(-1e-4, 0.9e-4)));
        // stresses of up to 1e5 Pa are summed 500 times
        REQUIRE(mean_pressure(point.stress()) > 0.0);
        CHECK(std::abs(mean_pressure(point.stress()) - (1000.0 - bulk_modulus * trace(point.strain()))) <= 1e-8);
        CHECK(point.state(Beads::opening) == 0.0);
    }
    CHECK(point.state(Beads::shear_strain) > 1.0);
}

TEST_CASE("a mass that has come apart carries nothing until it has closed, and then K times the rest")
{
    const BeadMaterial beads(bead_parameters());
    MaterialPoint point(beads, Stress::isotropic(-1000.0));
    const double elastic = 1000.0 / bulk_modulus;
    step(point, Strain::isotropic(0.05 / 3.0) + simple_shear(0.1));
    CHECK(norm(point.stress()) == 0.0);
    CHECK(point.state(Beads::opening) == doctest::Approx(0.05 - elastic).epsilon(1e-13).scale(0.0));
    for (int n = 0; n < 4; ++n) {
        step(point, Strain::isotropic(-0.01 / 3.0) + simple_shear(0.1));
        CHECK(norm(point.stress()) == 0.0);
    }
    CHECK(point.state(Beads::opening) == doctest::Approx(0.01 - elastic).epsilon(1e-12).scale(0.0));
    step(point, Strain::isotropic(-0.02 / 3.0));
    // K times 0.01, of 0.05 opened and 0.06 closed, on top of the first 1000 Pa
    CHECK(mean_pressure(point.stress()) == doctest::Approx(1000.0 + bulk_modulus * 0.01).epsilon(1e-12));
    CHECK(point.state(Beads::opening) == 0.0);
}

TEST_CASE("opening and closing is the same in one step and in many")
{
    const BeadMaterial beads(bead_parameters());
    for (const int steps : {1, 7, 1000}) {
        CAPTURE(steps);
        MaterialPoint point(beads, Stress::isotropic(-1000.0));
        for (int n = 0; n < steps; ++n)
            step(point, Strain::isotropic(0.1 / 3.0 / steps));
        CHECK(point.state(Beads::opening) == doctest::Approx(0.1 - 1000.0 / bulk_modulus).epsilon(1e-12).scale(0.0));
        for (int n = 0; n < steps; ++n)
            step(point, Strain::isotropic(-0.1 / 3.0 / steps));
        // K times 2000 strains, each rounded to 1e-17
        CHECK(mean_pressure(point.stress()) == doctest::Approx(1000.0).epsilon(1e-9));
    }
}
