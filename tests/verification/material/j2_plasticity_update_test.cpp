// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One step of J2 plasticity: the equation it solves, its limits, and what its parameters must be.
#include "j2_clay.hpp"
#include "periporo/material_kit.hpp"
#include "refusal_of_not_finite.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Clay clay(const std::map<std::string, double>& changes = {})
{
    return Clay(clay_parameters(changes));
}

// Laws from mild to as extreme as their parameters may be.
const Hardening curves[] = {{0.0, 25e3, 40.0},   {3e5, 25e3, 40.0},
                            {0.0, 25e3, 1e9},    {0.0, 1e9, 1e6},
                            {0.0, 2e3, 20.0},    {0.0, 0.0, 0.999999 * 3.0 * shear_modulus / yield_stress},
                            {1e5, 9999.0, 1.0e7}};

// A point inside, on or outside a surface that has hardened by up to 0.1, in a strain of any size.
LawInput<double, 2> random_input(Random& random)
{
    LawInput<double, 2> input{};
    input.stress = random.tensor(random.number(0.0, 2.0) * yield_stress) + Stress::isotropic(random.number(-1e5, 1e4));
    input.strain_increment = random.tensor(std::pow(10.0, random.number(-7.0, 0.0)));
    const double hardening = std::pow(10.0, random.number(-14.0, -1.0));
    input.state = {hardening, 0.5 * hardening};
    input.time_step = 1e-4;
    return input;
}

Stress trial_stress(const LawInput<double, 2>& input)
{
    return elastic_stress(input.stress, input.strain_increment, bulk_modulus, shear_modulus);
}

} // namespace

TEST_CASE(
    "a step that yields satisfies q_trial - 3 G de = sigma_y(e + de) + 3 eta de/dt, whatever the law and the step")
{
    Random random;
    for (const Hardening& curve : curves)
        for (const double viscosity : {0.0, 1.0, 1e4, 1e12}) {
            CAPTURE(curve.saturation_stress);
            CAPTURE(curve.rate);
            CAPTURE(viscosity);
            std::map<std::string, double> changes = curve.parameters();
            changes["viscosity"] = viscosity;
            const Clay law = clay(changes);
            int yielding = 0;
            for (int n = 0; n < 500; ++n) {
                const LawInput<double, 2> before = random_input(random);
                const auto after = law.update(before);
                REQUIRE_FALSE(after.failed);
                const double trial = deviator_stress(trial_stress(before));
                const double strain = before.state[Clay::hardening_strain];
                const double increment = after.state[Clay::hardening_strain] - strain;
                const double stress = deviator_stress(after.stress);
                const double largest = norm(trial_stress(before)) + curve.yield(strain);
                if (trial <= curve.yield(strain)) {
                    CHECK(increment == 0.0);
                    continue;
                }
                ++yielding;
                // the solver stops within 1e-14 of these; e + de is rounded, too
                const double over = viscosity / before.time_step;
                CHECK(std::abs(stress - (trial - 3.0 * shear_modulus * increment)) <=
                      1e-13 * (largest + curve.saturation_stress) + 3.0 * shear_modulus * epsilon * strain);
                const double slope = std::abs(curve.saturation_stress - yield_stress) * curve.rate + curve.modulus;
                CHECK(std::abs(stress - curve.yield(strain + increment) - 3.0 * over * increment) <=
                      1e-13 * (largest + curve.saturation_stress) * (1.0 + over / shear_modulus) +
                          (slope + 3.0 * over) * epsilon * strain);
            }
            CHECK(yielding > 100);
        }
}

TEST_CASE("the stress returns along its own deviator")
{
    const Clay law = clay(curves[1].parameters());
    Random random;
    for (int n = 0; n < 500; ++n) {
        const LawInput<double, 2> before = random_input(random);
        const auto after = law.update(before);
        const Stress trial = trial_stress(before);
        const Stress turned =
            deviator(after.stress) * deviator_stress(trial) - deviator(trial) * deviator_stress(after.stress);
        CHECK(norm(turned) <= 1e-14 * norm(trial) * deviator_stress(trial));
        CHECK(std::abs(mean_pressure(after.stress) - mean_pressure(trial)) <= 1e-15 * norm(trial));
    }
}

TEST_CASE("a step of a hundred million ends on the surface")
{
    Random random;
    const Clay law = clay(curves[4].parameters());
    for (int n = 0; n < 200; ++n) {
        LawInput<double, 2> input = random_input(random);
        input.strain_increment = deviator(random.tensor(1e8));
        const auto after = law.update(input);
        REQUIRE_FALSE(after.failed);
        // all of the saturation stress, 2 kPa; the deviator of a trial stress of 1e15 Pa keeps a mean of 1e15 epsilon
        CHECK(std::abs(deviator_stress(after.stress) - curves[4].saturation_stress) <=
              1e-12 * curves[4].saturation_stress);
    }
}

TEST_CASE("without time a viscous clay does not flow, and one without viscosity does")
{
    LawInput<double, 2> input{};
    input.strain_increment = simple_shear(0.01);
    for (const Hardening& curve : {curves[0], Hardening{}}) {
        std::map<std::string, double> viscous = curve.parameters();
        viscous["viscosity"] = 1e3;
        const auto rigid = clay(viscous).update(input);
        CHECK(rigid.state[Clay::shear_strain] == 0.0);
        CHECK(rigid.stress.xy == doctest::Approx(shear_modulus * 0.01).epsilon(1e-15));
        CHECK(clay(curve.parameters()).update(input).state[Clay::shear_strain] > 0.0);
    }
}

TEST_CASE("a clay so viscous that it hardly flows flows by (q - sigma_y)/(3 eta) dt")
{
    const double viscosity = 1e18;
    LawInput<double, 2> input{};
    input.stress.xy = 2.0 * yield_stress / std::sqrt(3.0);
    input.time_step = 1e-4;
    for (const Hardening& curve : {curves[0], curves[4], Hardening{}}) {
        std::map<std::string, double> changes = curve.parameters();
        changes["viscosity"] = viscosity;
        const double expected = yield_stress / (3.0 * viscosity) * input.time_step;
        // the flow of 3e-19 moves neither q nor sigma_y
        CHECK(clay(changes).update(input).state[Clay::shear_strain] / expected == doctest::Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("viscosity that tends to nothing is no viscosity")
{
    Random random;
    std::map<std::string, double> changes = curves[1].parameters();
    const Clay inviscid = clay(changes);
    changes["viscosity"] = 1e-9;
    const Clay viscous = clay(changes);
    for (int n = 0; n < 200; ++n) {
        const LawInput<double, 2> input = random_input(random);
        // eta/(G dt) = 2e-12 of the overstress is left
        CHECK(norm(viscous.update(input).stress - inviscid.update(input).stress) <= 4e-12 * norm(trial_stress(input)));
    }
}

TEST_CASE("a step without strain leaves a stress on the surface as it is")
{
    const Clay law = clay(curves[1].parameters());
    Random random;
    for (int n = 0; n < 500; ++n) {
        LawInput<double, 2> input = random_input(random);
        const auto on_surface = law.update(input);
        input.stress = on_surface.stress;
        input.state = on_surface.state;
        input.strain_increment = {};
        const auto after = law.update(input);
        CHECK(components(after.stress) == components(input.stress));
        CHECK(after.state == input.state);
    }
}

TEST_CASE("it passes the checks of the material kit, with and without hardening, softening and viscosity")
{
    kit::Range metal;
    metal.stress_ratio = 0.05; // 5 kPa at the largest pressure, half the yield stress
    metal.tension_limit = std::numeric_limits<double>::infinity();
    for (const double viscosity : {0.0, 50.0})
        for (const Hardening& curve : {Hardening{}, curves[1], curves[4]}) {
            CAPTURE(viscosity);
            CAPTURE(curve.saturation_stress);
            std::map<std::string, double> changes = curve.parameters();
            changes["viscosity"] = viscosity;
            metal.rate_dependent = viscosity > 0.0;
            for (const std::string& fault : kit::check_law<Clay>(clay_parameters(changes), metal))
                FAIL_CHECK(fault);
        }
}

TEST_CASE("input that is not a number is refused with a reason")
{
    LawInput<double, 2> good{};
    good.strain_increment = simple_shear(0.01);
    good.time_step = 1e-4;
    check_refuses_what_is_not_finite(clay(curves[1].parameters()), good);
}

TEST_CASE("the hardening outlives the release and the strain of the pictures does not")
{
    const auto variables = Clay::state_variables();
    REQUIRE(variables.size() == Clay::state_count);
    CHECK(variables[Clay::hardening_strain].name == "hardening_strain");
    CHECK_FALSE(variables[Clay::hardening_strain].reset_on_release);
    CHECK(variables[Clay::hardening_strain].of_point);
    CHECK(variables[Clay::shear_strain].name == "equivalent_plastic_shear_strain");
    CHECK(variables[Clay::shear_strain].reset_on_release);

    const ClayMaterial material(clay_parameters({{"hardening_modulus", 1e6}}));
    MaterialPoint point(material);
    REQUIRE(point.step(simple_shear(0.02), 1e-3).converged);
    const double hardened = point.state(Clay::hardening_strain);
    CHECK(hardened > 0.005);
    point.initialize(1.0);
    CHECK(point.state(Clay::hardening_strain) == hardened);
    CHECK(point.state(Clay::shear_strain) == 0.0);
}

TEST_CASE("saturation stress and rate are refused one without the other")
{
    for (const char* name : {"saturation_stress", "saturation_rate"})
        CHECK_THROWS_WITH_AS(clay({{name, 100.0}}), doctest::Contains("belong together"), std::invalid_argument);
}

TEST_CASE("softening that would snap back is refused")
{
    const double steepest = 3.0 * shear_modulus / yield_stress; // down to nothing
    CHECK_NOTHROW(clay({{"saturation_stress", 0.0}, {"saturation_rate", 0.99 * steepest}}));
    CHECK_THROWS_WITH_AS(clay({{"saturation_stress", 0.0}, {"saturation_rate", 1.01 * steepest}}),
                         doctest::Contains("lower the rate"), std::invalid_argument);
}
