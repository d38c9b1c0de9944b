// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One step of the critical-state law: consistency, viscosity, dissipation, objectivity, order and hostile input.
#include "critical_state_soil.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace periporo;
using namespace periporo::test;

namespace {

// A random point on, inside or outside the surface of a soil with p of 20 Pa to 20 kPa, and a strain of any size.
LawInput<double, 3> random_input(Random& random)
{
    const double p = std::exp(random.number(3.0, 10.0));
    LawInput<double, 3> input = isotropic_input(p, p * random.number(0.8, 4.0));
    input.stress += deviator(random.tensor(random.number(0.0, 1.5) * p)); // q up to 1.8 p
    input.strain_increment = random.tensor(std::pow(10.0, random.number(-6.0, -1.0)));
    return input;
}

// p dx + q d(eps_s) of a step [J/m3], the plastic work of associated isotropic flow.
double plastic_work(const LawInput<double, 3>& before, const LawResult<double, 3>& after)
{
    return mean_pressure(after.stress) *
               (after.state[Soil::volumetric_strain] - before.state[Soil::volumetric_strain]) +
           deviator_stress(after.stress) * (after.state[Soil::shear_strain] - before.state[Soil::shear_strain]);
}

// The undrained and shearing path of convergence tests, 1 per cent in `steps` steps.
Stress end_of_path(int steps)
{
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, 1000.0, 1200.0);
    for (int n = 0; n < steps; ++n)
        step(point, Strain{-6e-3, 1e-3, 2e-3, 5e-3, 0.0, 2e-3} * (1.0 / steps));
    return point.stress();
}

} // namespace

TEST_CASE("without viscosity a step that yields ends on the surface")
{
    const Soil law = soil();
    Random random;
    int yielding = 0;
    double worst = 0.0;
    for (int n = 0; n < 20000; ++n) {
        const LawInput<double, 3> before = random_input(random);
        const auto after = law.update(before);
        REQUIRE_FALSE(after.failed);
        const double pc = std::max(std::exp(after.state[Soil::log_preconsolidation]), floor_pressure);
        const double relative = yield_function(after.stress, pc) / (0.25 * pc * pc);
        if (after.state[Soil::shear_strain] == 0.0) {
            CHECK(relative <= 1e-11);
            continue;
        }
        ++yielding;
        worst = std::max(worst, std::abs(relative));
    }
    CHECK(yielding > 5000);
    // what the return map promises for any step; f is evaluated here from components that are up to 1e3 times p
    CHECK(worst <= 1e-10);
}

TEST_CASE("the new stress is the elastic one less the elastic part of the plastic strain")
{
    const Soil law = soil();
    Random random;
    for (int n = 0; n < 2000; ++n) {
        const LawInput<double, 3> before = random_input(random);
        const auto after = law.update(before);
        REQUIRE_FALSE(after.failed);
        const Stress trial = elastic_stress(before.stress, before.strain_increment, bulk_modulus, shear_modulus);
        const double tolerance = 1e-13 * norm(trial);
        CHECK(std::abs(mean_pressure(after.stress) -
                       (mean_pressure(trial) - bulk_modulus * after.state[Soil::volumetric_strain])) <= tolerance);
        CHECK(std::abs(deviator_stress(after.stress) -
                       (deviator_stress(trial) - 3.0 * shear_modulus * after.state[Soil::shear_strain])) <= tolerance);
    }
}

TEST_CASE("ln pc grows by the plastic volumetric strain over lambda - kappa")
{
    const Soil law = soil();
    Random random;
    for (int n = 0; n < 2000; ++n) {
        const LawInput<double, 3> before = random_input(random);
        const auto after = law.update(before);
        const double growth = after.state[Soil::log_preconsolidation] - before.state[Soil::log_preconsolidation];
        // both logarithms are about 10, rounded to 2e-15 of it
        CHECK(std::abs(growth - after.state[Soil::volumetric_strain] / plastic_index) <=
              1e-14 + 1e-14 * std::abs(growth));
    }
}

TEST_CASE("a viscous step satisfies f = eta dl/dt with the multiplier that the flow shows")
{
    Random random;
    for (const double viscosity : {1e3, 1e9, 1e12}) {
        CAPTURE(viscosity);
        const Soil law = soil({{"viscosity", viscosity}});
        for (int n = 0; n < 500; ++n) {
            const LawInput<double, 3> before = random_input(random);
            const auto after = law.update(before);
            REQUIRE_FALSE(after.failed);
            if (after.state[Soil::shear_strain] == 0.0)
                continue;
            const double pc = std::max(std::exp(after.state[Soil::log_preconsolidation]), floor_pressure);
            const double multiplier = after.state[Soil::shear_strain] * critical_slope * critical_slope /
                                      (2.0 * deviator_stress(after.stress));
            const double f = yield_function(after.stress, pc);
            const double strength = 0.25 * pc * pc + viscosity * multiplier / before.time_step;
            CHECK(std::abs(f - viscosity * multiplier / before.time_step) <= 1e-10 * strength);
        }
    }
}

TEST_CASE("an overstressed point at rest relaxes at first with the rate f/eta df/dsigma")
{
    const double viscosity = 1e12, p = 900.0, q = 1500.0, pc = 1500.0;
    const double f = q * q / (critical_slope * critical_slope) + p * (p - pc);
    REQUIRE(f > 0.0);
    const double mean_rate = -bulk_modulus * f / viscosity * (2.0 * p - pc);
    const double shear_rate = -3.0 * shear_modulus * f / viscosity * 2.0 * q / (critical_slope * critical_slope);
    for (const double time_step : {1e-6, 1e-7}) {
        const SoilMaterial material(soil_parameters({{"viscosity", viscosity}}));
        MaterialPoint point = isotropic_point(material, p, pc);
        point.set_stress(point.stress() + Stress{0.0, 0.0, 0.0, q / std::sqrt(3.0), 0.0, 0.0});
        step(point, Strain{}, time_step);
        // the rates themselves change at K p/eta, 2e-2 1/s times some ten, so by less than dt x 1e5 (K p^2/eta = 20 1/s
        // for p, 6 G/M^2 f/eta of 1e2 1/s for q): 1e-3 of themselves per 1e-6 s is ample
        CHECK((mean_pressure(point.stress()) - p) / time_step == doctest::Approx(mean_rate).epsilon(1e3 * time_step));
        CHECK((deviator_stress(point.stress()) - q) / time_step ==
              doctest::Approx(shear_rate).epsilon(1e3 * time_step));
    }
}

TEST_CASE("an overstressed point held at its strain relaxes onto the surface and stays there")
{
    const SoilMaterial material(soil_parameters({{"viscosity", 1e9}}));
    MaterialPoint point = isotropic_point(material, 900.0, 1500.0);
    point.set_stress(point.stress() + Stress{0.0, 0.0, 0.0, 2000.0, 0.0, 0.0});
    double previous = yield_function(point.stress(), preconsolidation(point));
    for (int n = 0; n < 200; ++n) {
        step(point, Strain{}, 1e-4);
        const double f = yield_function(point.stress(), preconsolidation(point));
        CHECK(f <= previous);
        CHECK(f >= -1e-12 * 0.25 * 1500.0 * 1500.0);
        previous = f;
    }
    CHECK(previous <= 1e-11 * 0.25 * 1500.0 * 1500.0);
}

TEST_CASE("without time there is no viscous flow")
{
    const SoilMaterial material(soil_parameters({{"viscosity", 1e3}}));
    MaterialPoint point = isotropic_point(material, 1000.0, 1000.0);
    step(point, Strain{-1e-3, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0);
    CHECK(point.state(Soil::shear_strain) == 0.0);
    CHECK(mean_pressure(point.stress()) == doctest::Approx(1000.0 + bulk_modulus * 1e-3).epsilon(1e-14));
}

TEST_CASE("a rotated point gives the rotated stress and the same state")
{
    const Soil law = soil();
    Random random;
    for (int n = 0; n < 500; ++n) {
        const LawInput<double, 3> before = random_input(random);
        const Tensor<double> rotation = random.rotation();
        LawInput<double, 3> turned = before;
        turned.stress = rotated(before.stress, rotation);
        turned.strain_increment = rotated(before.strain_increment, rotation);
        const auto expected = law.update(before);
        const auto found = law.update(turned);
        // round-off of the trial stress passes through the return unamplified (a projection); its invariants carry it
        const double trial = norm(elastic_stress(before.stress, before.strain_increment, bulk_modulus, shear_modulus));
        CHECK(norm(found.stress - rotated(expected.stress, rotation)) <= 1e-13 * trial);
        for (std::size_t s = 0; s < 3; ++s)
            CHECK(std::abs(found.state[s] - expected.state[s]) <=
                  1e-13 * (10.0 + trial / bulk_modulus / plastic_index));
    }
}

TEST_CASE("plastic work is never negative along random paths")
{
    Random random;
    for (const double viscosity : {0.0, 1e9}) {
        const Soil law = soil({{"viscosity", viscosity}});
        LawInput<double, 3> now = isotropic_input(1000.0, 1500.0);
        double total = 0.0;
        for (int n = 0; n < 5000; ++n) {
            now.strain_increment = random.tensor(1e-3);
            const auto after = law.update(now);
            REQUIRE_FALSE(after.failed);
            const double work = plastic_work(now, after);
            // round-off of the accumulated strains
            const double strain = after.state[Soil::shear_strain] + std::abs(after.state[Soil::volumetric_strain]);
            CHECK(work >= -std::numeric_limits<double>::epsilon() * norm(after.stress) * strain);
            total += work;
            now.stress = after.stress;
            now.state = after.state;
        }
        CHECK(total > 0.0);
    }
}

TEST_CASE("halving the step halves the error")
{
    const Stress coarse = end_of_path(40), medium = end_of_path(80), fine = end_of_path(160);
    const double ratio = norm(coarse - medium) / norm(medium - fine);
    // e = c h + d h^2 gives 2 + O(h); the h^2 part of 40 steps is some per cent
    CHECK(ratio == doctest::Approx(2.0).epsilon(0.1));
}

TEST_CASE("a tensile trial stress returns to the surface near its apex")
{
    const SoilMaterial material(soil_parameters());
    for (const double stretch : {1e-5, 1e-3, 1e-1}) {
        CAPTURE(stretch);
        MaterialPoint point = isotropic_point(material, 500.0, 1000.0);
        step(point, Strain::isotropic(stretch) + Strain{0.0, 0.0, 0.0, 0.1 * stretch, 0.0, 0.0});
        const double p = mean_pressure(point.stress());
        const double pc = std::max(preconsolidation(point), floor_pressure);
        CHECK(p >= 0.0);
        CHECK(std::abs(yield_function(point.stress(), pc)) <= 1e-10 * pc * pc);
    }
}

TEST_CASE("a soil pulled far apart carries nothing until it has closed up again")
{
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, 500.0, 1000.0);
    for (int n = 0; n < 100; ++n)
        step(point, Strain::isotropic(1e-3));
    const double loosest = point.state(Soil::log_preconsolidation);
    // nearly all of the 0.3 of volumetric strain is plastic: ln pc fell by 0.3/0.08, far below the floor of 20 Pa
    CHECK(loosest < std::log(1000.0) - 3.7);
    for (int n = 0; n < 50; ++n)
        step(point, Strain::isotropic(-1e-3));
    // half closed, ln pc is half way: 1000 exp(-0.15/0.08) = 150 Pa is a bound of p
    CHECK(mean_pressure(point.stress()) <= 1000.0 * std::exp(-0.149 / 0.08));
    for (int n = 0; n < 50; ++n)
        step(point, Strain::isotropic(-1e-3));
    // closed: 500 Pa and pc = 1000 Pa were the start; elastic strain p/K is of order 1e-5 and the floor took 20 Pa/K
    CHECK(point.state(Soil::log_preconsolidation) == doctest::Approx(std::log(1000.0)).epsilon(1e-3));
    CHECK(mean_pressure(point.stress()) == doctest::Approx(preconsolidation(point)).epsilon(1e-10));
}

TEST_CASE("a preconsolidation far below the floor leaves the surface at the floor")
{
    for (const double log_pc : {0.0, -50.0, -1000.0, -9e4}) {
        CAPTURE(log_pc);
        const SoilMaterial material(soil_parameters());
        MaterialPoint point = isotropic_point(material, 10.0, 1.0);
        point.set_state(Soil::log_preconsolidation, log_pc);
        step(point, Strain{-1e-3, 2e-4, 2e-4, 3e-4, 0.0, 0.0});
        CHECK(std::abs(yield_function(point.stress(), floor_pressure)) <= 1e-10 * floor_pressure * floor_pressure);
    }
}

TEST_CASE("compression from far below the floor closes up before it carries load")
{
    // ln pc must rise from -20 to ln p: x = 0.08 (ln p + 20), found in one step whose pc passes the floor on the way
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, 10.0, 1.0);
    point.set_state(Soil::log_preconsolidation, -20.0);
    step(point, Strain::isotropic(-3.0 / 3.0));
    const double p = mean_pressure(point.stress());
    CHECK(preconsolidation(point) == doctest::Approx(p).epsilon(1e-10));
    CHECK((p - 10.0) / bulk_modulus + plastic_index * (std::log(p) + 20.0) == doctest::Approx(3.0).epsilon(1e-12));
}

TEST_CASE("huge trial steps come back to the surface")
{
    const Soil law = soil();
    Random random;
    for (const double size : {1.0, 1e2, 1e4, 1e8})
        for (int n = 0; n < 200; ++n) {
            CAPTURE(size);
            LawInput<double, 3> input = isotropic_input(1000.0, 1500.0);
            input.strain_increment = deviator(random.tensor(size)) + Strain::isotropic(random.number(-0.3, size));
            const auto after = law.update(input);
            REQUIRE_FALSE(after.failed);
            const double p = mean_pressure(after.stress);
            const double pc = std::max(std::exp(after.state[Soil::log_preconsolidation]), floor_pressure);
            CHECK(std::abs(yield_function(after.stress, pc)) <= 1e-9 * pc * pc);
            CHECK(p >= 0.0);
        }
}

TEST_CASE("a purely volumetric step has no deviator to divide by")
{
    for (const double strain : {1e-2, -1e-2}) {
        const SoilMaterial material(soil_parameters());
        MaterialPoint point = isotropic_point(material, 1000.0, 1000.0);
        step(point, Strain::isotropic(strain));
        // a third of the trace is not exact: of the trial stress of 2.5e5 Pa, round-off may be deviatoric
        CHECK(deviator_stress(point.stress()) <= 1e-15 * 2.5e5);
        CHECK(point.state(Soil::shear_strain) <= 1e-15 * 1e-2);
        CHECK(std::isfinite(mean_pressure(point.stress())));
    }
}

TEST_CASE("input that is not a number is refused with a reason")
{
    const Soil law = soil({{"viscosity", 1e3}});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity, 1e150}) {
        CAPTURE(bad);
        const LawInput<double, 3> good = isotropic_input(1000.0, 1500.0);
        for (int which = 0; which < 5; ++which) {
            CAPTURE(which);
            LawInput<double, 3> input = good;
            if (which == 0)
                input.stress.yy = bad;
            else if (which == 1)
                input.strain_increment.xz = bad;
            else if (which == 2)
                input.state[Soil::log_preconsolidation] = bad;
            else if (which == 3)
                input.stress.xy = bad;
            else if (bad != 1e150 && bad != infinity)
                input.time_step = bad;
            else
                continue;
            const auto after = law.update(input);
            CHECK(after.failed);
            REQUIRE(after.reason != nullptr);
            CHECK(std::string(after.reason).find("not a finite number") != std::string::npos);
        }
    }
}

TEST_CASE("tensile strength moves the apex of the ellipse to -p_s")
{
    const double p_s = 200.0, pc = 1000.0;
    const SoilMaterial material(soil_parameters({{"tensile_strength", p_s}}));
    MaterialPoint point = isotropic_point(material, 100.0, pc);
    step(point, Strain::isotropic(200.0 / bulk_modulus / 3.0)); // to p = -100 Pa, inside
    CHECK(mean_pressure(point.stress()) == doctest::Approx(-100.0).epsilon(1e-12));
    CHECK(preconsolidation(point) == doctest::Approx(pc).epsilon(1e-14));
    step(point, Strain::isotropic(1e-4));
    CHECK(mean_pressure(point.stress()) == doctest::Approx(-p_s).epsilon(1e-10));
}

TEST_CASE("a swelling index that is not below the compression index is refused by name")
{
    CHECK_THROWS_WITH_AS(soil({{"swelling_index", 0.12}}),
                         doctest::Contains("swelling_index (0.120000) must be less than compression_index"),
                         std::invalid_argument);
}

TEST_CASE("the plastic strains start anew at the release and the preconsolidation does not")
{
    const auto variables = Soil::state_variables();
    REQUIRE(variables.size() == Soil::state_count);
    CHECK(variables[Soil::log_preconsolidation].name == "log_preconsolidation_pressure");
    CHECK_FALSE(variables[Soil::log_preconsolidation].reset_on_release);
    CHECK(variables[Soil::log_preconsolidation].of_point);
    CHECK(variables[Soil::shear_strain].name == "equivalent_plastic_shear_strain");
    CHECK(variables[Soil::shear_strain].reset_on_release);
    CHECK(variables[Soil::volumetric_strain].name == "plastic_volumetric_strain");
    CHECK(variables[Soil::volumetric_strain].reset_on_release);
}
