// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One step of the mu(I) law: the equation it solves, its limits, and what its parameters must be.
#include "mu_i_beads.hpp"
#include "periporo/material_kit.hpp"
#include "refusal_of_not_finite.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Beads law(const std::map<std::string, double>& changes = {})
{
    return Beads(bead_parameters(changes));
}

// A point under 1 Pa to 100 kPa, closed or opened, in a strain of any size.
LawInput<double, 2> random_input(Random& random)
{
    LawInput<double, 2> input{};
    const double p = std::pow(10.0, random.number(0.0, 5.0));
    input.stress = Stress::isotropic(-p) + deviator(random.tensor(random.number(0.0, 1.0) * p)); // tau up to 0.7 p
    input.strain_increment = random.tensor(std::pow(10.0, random.number(-7.0, 0.0)));
    input.state = {std::max(0.0, random.number(-1.0, 1.0)) * p / bulk_modulus, 0.1};
    input.time_step = 1e-4;
    return input;
}

Stress trial_stress(const LawInput<double, 2>& input)
{
    return elastic_stress(input.stress, input.strain_increment, bulk_modulus, shear_modulus);
}

} // namespace

TEST_CASE("a step that flows satisfies (tau_trial - tau)(mu_2 p - tau) = xi G dt sqrt(p) (tau - mu_s p) to round-off")
{
    const Beads beads = law();
    Random random;
    int flowing = 0;
    for (const double time_step : {1e-9, 1e-6, 1e-3, 1.0, 1e3})
        for (int n = 0; n < 2000; ++n) {
            LawInput<double, 2> before = random_input(random);
            before.time_step = time_step;
            const auto after = beads.update(before);
            REQUIRE_FALSE(after.failed);
            const double p = mean_pressure(after.stress), tau = flow_stress(after.stress);
            const double trial = flow_stress(trial_stress(before));
            if (p <= 0.0)
                continue;
            if (trial <= static_friction * p) {
                CHECK(std::abs(tau - trial) <= 1e-15 * norm(trial_stress(before)));
                continue;
            }
            ++flowing;
            CHECK(tau >= static_friction * p * (1.0 - 1e-12));
            CHECK(tau <= limiting_friction * p * (1.0 + 1e-12));
            CHECK(tau <= trial);
            // alpha = G dt I_0 sqrt(p/rho_s)/d
            const double alpha = shear_modulus * time_step * shear_rate(reference_number, p);
            const double residual = (trial - tau) * (limiting_friction * p - tau) - alpha * (tau - static_friction * p);
            // each stress is known to 1e-15 of the largest of its step
            const double round_off = 1e-15 * (norm(trial_stress(before)) + bulk_modulus * before.state[0]);
            CHECK(std::abs(residual) <= 4.0 * round_off * (trial + limiting_friction * p + alpha));
        }
    CHECK(flowing > 3000);
}

TEST_CASE("the step is the inertial number of its own plastic strain")
{
    const Beads beads = law();
    for (const double strain : {1e-3, 1e-2, 1.0}) {
        CAPTURE(strain);
        LawInput<double, 2> input{};
        input.stress = Stress::isotropic(-1000.0);
        input.strain_increment = simple_shear(strain);
        input.time_step = 1e-2;
        const auto after = beads.update(input);
        const double rate = std::sqrt(3.0) * after.state[Beads::shear_strain] / input.time_step;
        const double number = rate * grain_diameter / std::sqrt(1000.0 / solid_density);
        // the trial stress is up to 1.5 MPa, its rounding 1e-13 of the 400 Pa that are left
        CHECK(after.stress.xy / 1000.0 == doctest::Approx(friction(number)).epsilon(1e-11));
    }
}

TEST_CASE("the pressure is K times the volumetric strain beyond closure, and what is left over is opening")
{
    const Beads beads = law();
    Random random;
    int open = 0;
    for (int n = 0; n < 2000; ++n) {
        const LawInput<double, 2> before = random_input(random);
        const auto after = beads.update(before);
        const double contact = mean_pressure(trial_stress(before)) - bulk_modulus * before.state[Beads::opening];
        const double round_off =
            8.0 * epsilon * (norm(trial_stress(before)) + bulk_modulus * before.state[Beads::opening]);
        CHECK(std::abs(mean_pressure(after.stress) - std::max(contact, 0.0)) <= round_off);
        CHECK(std::abs(after.state[Beads::opening] - std::max(-contact, 0.0) / bulk_modulus) <=
              round_off / bulk_modulus);
        open += contact < 0.0;
        if (contact < -round_off)
            CHECK(norm(after.stress) == 0.0);
    }
    CHECK(open > 500);
}

TEST_CASE("an opening below none counts as none")
{
    LawInput<double, 2> input{};
    input.stress = Stress::isotropic(-1000.0);
    input.state = {-0.01, 0.0};
    input.strain_increment = Strain::isotropic(-1e-3 / 3.0);
    CHECK(mean_pressure(law().update(input).stress) == doctest::Approx(1000.0 + bulk_modulus * 1e-3).epsilon(1e-14));
}

TEST_CASE("without time the stress is cut to the limiting friction, as in a step that tends to none")
{
    LawInput<double, 2> input{};
    for (const double friction : {0.5, 5.0}) {
        input.stress = Stress::isotropic(-1000.0);
        input.stress.xy = friction * 1000.0;
        const double expected = std::min(friction, limiting_friction) * 1000.0;
        input.time_step = 0.0;
        CHECK(law().update(input).stress.xy == doctest::Approx(expected).epsilon(1e-14));
        input.time_step = 1e-20; // alpha is 1e-12 Pa
        CHECK(law().update(input).stress.xy == doctest::Approx(expected).epsilon(1e-11));
    }
}

TEST_CASE("with equal frictions it is rate-independent")
{
    LawInput<double, 2> input{};
    input.stress = Stress::isotropic(-1000.0);
    input.strain_increment = simple_shear(0.1);
    for (const double time_step : {0.0, 1e-9, 1e-3, 1e6}) {
        input.time_step = time_step;
        CHECK(law({{"limiting_friction", static_friction}}).update(input).stress.xy ==
              doctest::Approx(static_friction * 1000.0).epsilon(1e-14));
    }
}

TEST_CASE("huge steps end between the two frictions")
{
    const Beads beads = law();
    Random random;
    for (const double size : {1e2, 1e8, 1e15})
        for (const double time_step : {0.0, 1e-300, 1e-4, 1e30})
            for (int n = 0; n < 100; ++n) {
                LawInput<double, 2> input = random_input(random);
                input.strain_increment = deviator(random.tensor(size));
                input.time_step = time_step;
                const auto after = beads.update(input);
                REQUIRE_FALSE(after.failed);
                const double p = mean_pressure(after.stress);
                REQUIRE(std::isfinite(flow_stress(after.stress)));
                // the mean of the result keeps the rounding of its own deviator, that of the trial is p
                CHECK(p >= -1e-15 * flow_stress(after.stress));
                if (p > 0.0)
                    CHECK(flow_stress(after.stress) / p ==
                          doctest::Approx(0.5 * (static_friction + limiting_friction)).epsilon(0.26));
            }
}

TEST_CASE("it passes the checks of the material kit, with friction that depends on the rate and with one that does not")
{
    for (const double limit : {limiting_friction, static_friction}) {
        CAPTURE(limit);
        kit::Range sand;
        sand.rate_dependent = limit > static_friction;
        for (const std::string& fault : kit::check_law<Beads>(bead_parameters({{"limiting_friction", limit}}), sand))
            FAIL_CHECK(fault);
    }
}

TEST_CASE("input that is not a number is refused with a reason")
{
    LawInput<double, 2> good{};
    good.stress = Stress::isotropic(-1000.0);
    good.strain_increment = simple_shear(0.01);
    good.time_step = 1e-4;
    check_refuses_what_is_not_finite(law(), good);
}

TEST_CASE("the opening belongs to the place and a settled mass is closed")
{
    const auto variables = Beads::state_variables();
    REQUIRE(variables.size() == Beads::state_count);
    CHECK(variables[Beads::opening].name == "opening");
    CHECK(variables[Beads::opening].of_point);
    CHECK(variables[Beads::shear_strain].name == "equivalent_plastic_shear_strain");
    CHECK(variables[Beads::shear_strain].reset_on_release);
    LawInput<double, 2> settled{};
    settled.stress = Stress::isotropic(-1000.0);
    settled.state = {0.5, 0.5};
    CHECK(law().initial_state(settled, 1.0) == std::array{0.0, 0.0});
}

TEST_CASE("a limiting friction below the static one is refused by name")
{
    CHECK_THROWS_WITH_AS(law({{"limiting_friction", 0.3}}),
                         doctest::Contains("limiting_friction (0.300000) must not be less than static_friction"),
                         std::invalid_argument);
}
