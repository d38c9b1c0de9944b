// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What Drucker-Prager and Mohr-Coulomb have in common: strength and dilation of triaxial compression, the opening, and
// what any law must do.
#include "frictional_laws.hpp"
#include "periporo/kit/packed.hpp"
#include "refusal_of_not_finite.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::size_t opening = FrictionalSoil::opening;
constexpr std::size_t shear_strain = FrictionalSoil::shear_strain;
constexpr std::size_t volumetric_strain = FrictionalSoil::volumetric_strain;

} // namespace

TEST_CASE_TEMPLATE("triaxial compression ends at s_1 = N s_3 + 2 c sqrt(N), N = (1 + sin phi)/(1 - sin phi)", Law,
                   DruckerPrager, MohrCoulomb)
{
    for (const double cohesion : {0.0, 700.0}) {
        CAPTURE(cohesion);
        const LawMaterial<Law> material(sand<Law>({{"cohesion", cohesion}}));
        const MaterialPoint point = sheared(material, -1e-4, radial);
        const double ratio = (1.0 + std::sin(35 * degree)) / (1.0 - std::sin(35 * degree));
        // the driver leaves 1e-12 of the lateral stress in each of 200 steps
        CHECK(-point.stress().zz == doctest::Approx(ratio * 1000.0 + 2.0 * cohesion * std::sqrt(ratio)).epsilon(1e-9));
        CHECK(point.stress().xx == doctest::Approx(-1000.0).epsilon(1e-9));
    }
}

TEST_CASE_TEMPLATE("steady triaxial compression dilates by (1 + sin psi)/(1 - sin psi) in lateral over axial strain",
                   Law, DruckerPrager, MohrCoulomb)
{
    for (const double dilatancy : {0.0, 10.0, 35.0}) {
        CAPTURE(dilatancy);
        const LawMaterial<Law> material(sand<Law>({{"dilatancy_angle", dilatancy}}));
        MaterialPoint point = sheared(material, -1e-4, radial);
        const MaterialPoint before = point;
        step_holding_xx(point, -1e-4, radial);
        const double s = std::sin(dilatancy * degree);
        const double lateral = point.strain().xx + point.strain().yy - before.strain().xx - before.strain().yy;
        // stress is steady, so all strain of the step is plastic, up to 1e-12 of 1 kPa over the modulus: 1e-16/1e-4
        CHECK(lateral / 1e-4 == doctest::Approx((1.0 + s) / (1.0 - s)).epsilon(1e-9));
        const double shear = point.state(shear_strain) - before.state(shear_strain);
        const double volume = point.state(volumetric_strain) - before.state(volumetric_strain);
        CHECK(std::abs(volume + 6.0 * s / (3.0 - s) * shear) <= 1e-12); // M_psi, of strains of 1e-4
        CHECK(shear ==
              doctest::Approx(1e-4 * 2.0 / 3.0 * (1.0 + 0.5 * (1.0 + s) / (1.0 - s))).epsilon(1e-9).scale(0.0));
    }
}

TEST_CASE_TEMPLATE("without dilatancy, shear at constant volume leaves the pressure as it is", Law, DruckerPrager,
                   MohrCoulomb)
{
    const LawMaterial<Law> material(sand<Law>({{"dilatancy_angle", 0.0}}));
    MaterialPoint point(material, Stress::isotropic(-1000.0));
    for (int n = 0; n < 500; ++n)
        point.step(Strain{2e-4, -1e-4, -1e-4, 3e-4, 1e-4, 0.0}, time_step);
    CHECK(mean_pressure(point.stress()) == doctest::Approx(1000.0).epsilon(500 * 1e-14)); // round-off of 500 steps
    CHECK(point.state(opening) == 0.0);
    CHECK(std::abs(point.state(volumetric_strain)) <= 500 * 1e-14 * 1000.0 / bulk_modulus);
    CHECK(point.state(shear_strain) > 0.1);
}

TEST_CASE_TEMPLATE("the mean stress in tension is cut off at p_t, and what is pulled further opens", Law, DruckerPrager,
                   MohrCoulomb)
{
    for (const double strength : {0.0, 300.0}) {
        CAPTURE(strength);
        const LawMaterial<Law> material(sand<Law>({{"cohesion", 500.0}, {"tensile_strength", strength}}));
        MaterialPoint point(material, Stress::isotropic(-1000.0));
        for (int n = 0; n < 10; ++n)
            point.step(Strain::isotropic(1e-3 / 3.0), time_step);
        CHECK(point.stress().xx == doctest::Approx(strength).epsilon(1e-12));
        CHECK(deviator_stress(point.stress()) <= 1e-10); // 25 kPa a step, to round-off
        const double elastic = (1000.0 + strength) / bulk_modulus;
        CHECK(point.state(opening) == doctest::Approx(0.01 - elastic).epsilon(1e-12).scale(0.0));
        CHECK(point.state(volumetric_strain) == doctest::Approx(-(0.01 - elastic)).epsilon(1e-12).scale(0.0));
    }
}

TEST_CASE_TEMPLATE("a mass that has come apart carries nothing until it has closed, and then K times the rest", Law,
                   DruckerPrager, MohrCoulomb)
{
    const LawMaterial<Law> material(sand<Law>());
    MaterialPoint point(material);
    point.step(Strain::isotropic(1e-2), time_step);
    CHECK(point.state(opening) == doctest::Approx(3e-2).epsilon(1e-12).scale(0.0));
    for (int n = 0; n < 99; ++n) {
        point.step(Strain::isotropic(-1e-4), time_step);
        // nothing but round-off of a trial stress of 7.5 kPa
        CHECK(norm(point.stress()) <= 1e-11);
    }
    CHECK(point.state(opening) == doctest::Approx(3e-4).epsilon(1e-10).scale(0.0));
    point.step(Strain::isotropic(-2e-4), time_step);
    CHECK(point.state(opening) == 0.0);
    CHECK(mean_pressure(point.stress()) == doctest::Approx(bulk_modulus * 3e-4).epsilon(1e-10));
    CHECK(std::abs(point.state(volumetric_strain)) <= 1e-15); // all of the opening was given back
}

TEST_CASE_TEMPLATE("the volume of a mass pulled along one axis closes along another", Law, DruckerPrager, MohrCoulomb)
{
    const LawMaterial<Law> material(sand<Law>({{"dilatancy_angle", 0.0}}));
    MaterialPoint point(material);
    point.step(Strain{1e-3, 0.0, 0.0, 0.0, 0.0, 0.0}, time_step);
    point.step(Strain{0.0, 0.0, -9e-4, 0.0, 0.0, 0.0}, time_step);
    CHECK(norm(point.stress()) <= 1e-10); // of trial stresses of 45 kPa
    CHECK(point.state(opening) == doctest::Approx(1e-4).epsilon(1e-10).scale(0.0));
    point.step(Strain{0.0, 0.0, -2e-4, 0.0, 0.0, 0.0}, time_step);
    CHECK(mean_pressure(point.stress()) == doctest::Approx(bulk_modulus * 1e-4).epsilon(1e-10));
}

TEST_CASE_TEMPLATE("sand without stress and cohesion shears freely, and gains pressure only by dilatancy", Law,
                   DruckerPrager, MohrCoulomb)
{
    for (const double dilatancy : {0.0, 10.0}) {
        CAPTURE(dilatancy);
        const LawMaterial<Law> material(sand<Law>({{"dilatancy_angle", dilatancy}}));
        MaterialPoint point(material);
        point.step(Strain{5e-4, 0.0, -5e-4, 0.0, 0.0, 0.0}, time_step);
        if (dilatancy == 0.0)
            CHECK(norm(point.stress()) <= 1e-11); // of a trial stress of 15 kPa
        else
            CHECK(mean_pressure(point.stress()) > 100.0);
        CHECK(point.state(opening) == 0.0);
    }
}

TEST_CASE_TEMPLATE("a closed loop inside the surface gives back the stress and leaves the state, to the last bit", Law,
                   DruckerPrager, MohrCoulomb)
{
    const LawMaterial<Law> material(sand<Law>());
    const Stress start = Stress::isotropic(-1000.0);
    MaterialPoint point(material, start);
    double work = 0.0;
    const Strain shear{1e-5, 0.0, -1e-5, 5e-6, 0.0, 0.0}, squeeze = Strain::isotropic(-5e-6);
    for (const Strain& increment : {shear, squeeze, shear * -1.0, squeeze * -1.0}) {
        const Stress before = point.stress();
        point.step(increment, time_step);
        work += 0.5 * double_contraction(before + point.stress(), increment);
    }
    for (std::size_t s = 0; s < 3; ++s)
        CHECK(point.state(s) == 0.0);
    CHECK(norm(point.stress() - start) <= 8.0 * epsilon * 1500.0); // four sums of stresses up to 1.5 kPa
    CHECK(std::abs(work) <= 8.0 * epsilon * 1500.0 * 1e-5);
}

TEST_CASE_TEMPLATE("no step creates energy: plastic work less what the opening stores is never negative", Law,
                   DruckerPrager, MohrCoulomb)
{
    const double strength = 200.0;
    const Law law(sand<Law>({{"cohesion", 500.0}, {"tensile_strength", strength}}));
    Random random;
    double total = 0.0;
    for (int n = 0; n < 5000; ++n) {
        auto input = random_input<Law>(random);
        input.state[opening] = 0.0; // a mass that is open under another stress than p = -p_t has lost that already
        const auto after = law.update(input);
        const Strain plastic = elastic_strain(trial_stress(input) - after.stress);
        const double dissipated = double_contraction(after.stress, plastic) - strength * after.state[opening];
        // the plastic strain is a difference of stresses, each rounded
        CHECK(dissipated >= -16.0 * epsilon * size_of(input) * size_of(input) / shear_modulus);
        total += dissipated;
    }
    CHECK(total > 0.0);
}

TEST_CASE_TEMPLATE("a rotated point gives the rotated stress and the same state", Law, DruckerPrager, MohrCoulomb)
{
    const Law law(sand<Law>({{"cohesion", 300.0}}));
    Random random;
    for (int n = 0; n < 1000; ++n) {
        const auto input = random_input<Law>(random);
        const Tensor<double> rotation = random.rotation();
        auto turned = input;
        turned.stress = rotated(input.stress, rotation);
        turned.strain_increment = rotated(input.strain_increment, rotation);
        const auto expected = law.update(input);
        const auto found = law.update(turned);
        // the return is a projection and amplifies round-off of the trial stress by no more than its angle to the
        // surface, a factor of a few
        const double round_off = 64.0 * epsilon * size_of(input);
        CHECK(norm(found.stress - rotated(expected.stress, rotation)) <= round_off);
        for (std::size_t s = 0; s < 3; ++s)
            CHECK(std::abs(found.state[s] - expected.state[s]) <= round_off / shear_modulus + epsilon);
    }
}

TEST_CASE_TEMPLATE("a pack gives what its lanes give one by one, whatever their neighbours do", Law, DruckerPrager,
                   MohrCoulomb)
{
    const Law law(sand<Law>({{"cohesion", 300.0}}));
    Random random;
    for (int n = 0; n < 2000; ++n) {
        std::vector<LawInput<double, 3>> lanes(pack_width);
        for (auto& lane : lanes)
            lane = random_input<Law>(random);
        const auto result = law.update(kit::packed<Pack>(lanes));
        REQUIRE_FALSE(any(result.failed));
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            // the same operations, but for the compiler's choice of fused ones; amplified as by a rotation
            const auto expected = law.update(lanes[lane]);
            const double round_off = 64.0 * epsilon * size_of(lanes[lane]);
            CHECK(norm(kit::lane_of_tensor(result.stress, lane) - expected.stress) <= round_off);
            for (std::size_t s = 0; s < 3; ++s)
                CHECK(std::abs(result.state[s][lane] - expected.state[s]) <= round_off / shear_modulus + epsilon);
        }
    }
}

TEST_CASE_TEMPLATE("any finite step is answered by a finite stress within the limits", Law, DruckerPrager, MohrCoulomb)
{
    const Law law(sand<Law>({{"cohesion", 300.0}}));
    Random random;
    for (const double size : {0.0, 1e-300, 1e-12, 1.0, 1e4, 1e12})
        for (int n = 0; n < 200; ++n) {
            CAPTURE(size);
            LawInput<double, 3> input{};
            input.strain_increment = random.tensor(size);
            input.time_step = time_step;
            const auto after = law.update(input);
            REQUIRE_FALSE(after.failed);
            CHECK(std::isfinite(norm(after.stress)));
            // round-off of the trial; below 1e-150 Pa squares vanish
            CHECK(mean_pressure(after.stress) >= -16.0 * epsilon * size * bulk_modulus - 1e-150);
            CHECK(after.state[opening] >= 0.0);
        }
}

TEST_CASE_TEMPLATE("input that is not a number is refused with a reason", Law, DruckerPrager, MohrCoulomb)
{
    LawInput<double, 3> good{};
    good.stress = Stress::isotropic(-1000.0);
    good.strain_increment = {-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0};
    good.time_step = time_step;
    check_refuses_what_is_not_finite(Law(sand<Law>()), good);
}

TEST_CASE_TEMPLATE("a settled mass starts closed and without plastic strain, in tension too", Law, DruckerPrager,
                   MohrCoulomb)
{
    const LawMaterial<Law> material(sand<Law>());
    for (const double pressure : {1000.0, -1000.0}) {
        MaterialPoint point(material, Stress::isotropic(-pressure));
        for (std::size_t s = 0; s < 3; ++s)
            point.set_state(s, 0.5);
        point.initialize(1.5);
        for (std::size_t s = 0; s < 3; ++s)
            CHECK(point.state(s) == 0.0);
    }
}

TEST_CASE_TEMPLATE("the opening belongs to the point and outlives the release, the strains of pictures do not", Law,
                   DruckerPrager, MohrCoulomb)
{
    const auto variables = Law::state_variables();
    REQUIRE(variables.size() == 3);
    CHECK(variables[opening].name == "opening");
    CHECK(variables[opening].of_point);
    CHECK_FALSE(variables[opening].reset_on_release);
    CHECK(variables[shear_strain].name == "equivalent_plastic_shear_strain");
    CHECK(variables[shear_strain].reset_on_release);
    CHECK(variables[volumetric_strain].name == "plastic_volumetric_strain");
    CHECK(variables[volumetric_strain].reset_on_release);
}

TEST_CASE_TEMPLATE("parameters that contradict each other are refused by name", Law, DruckerPrager, MohrCoulomb)
{
    CHECK_THROWS_WITH_AS(Law(sand<Law>({{"dilatancy_angle", 36.0}})),
                         doctest::Contains("dilatancy_angle (36.000000 deg) must not exceed friction_angle (35.0"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(Law(sand<Law>({{"tensile_strength", 1.0}})),
                         doctest::Contains("tensile_strength (1.000000 Pa) must not exceed cohesion cot(phi) (0.0"),
                         std::invalid_argument);
}
