// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every kind of stage with Hooke's law, where each has a closed form: K = 2 MPa, G = 1.2 MPa, E = 3 MPa, nu = 0.25.
#include "support/paths.hpp"

#include <fmt/format.h>

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double bulk_modulus = 2e6;
constexpr double shear_modulus = 1.2e6;
constexpr double youngs_modulus = 3e6;
constexpr double poisson_ratio = 0.25;
// Controlled stresses are met to a billionth of the largest stress in every step, and the steps do not add up.
constexpr double tight = 1e-8;

const std::string start = "[initial]\npressure = \"10 kPa\"\n";

std::string stage(const std::string& keys)
{
    return rubber + start + "[[stage]]\nduration = 1\nsteps = 10\n" + keys;
}

} // namespace

TEST_CASE("an isotropic stage to a pressure compresses by its change over K")
{
    const DrivenPath path(stage("type = \"isotropic\"\npressure = \"30 kPa\""));
    CHECK(mean_pressure(path.end().stress()) == doctest::Approx(30e3).epsilon(tight));
    CHECK(trace(path.end().strain()) == doctest::Approx(-20e3 / bulk_modulus).epsilon(tight).scale(0.0));
    CHECK(deviator_stress(path.end().stress()) < tight * 30e3);
}

TEST_CASE("an isotropic stage of anisotropic stress changes the three normal stresses alike")
{
    const DrivenPath path(rubber + "[initial]\nstress = [-5e3, -5e3, -1e4, 0, 0, 0]\n" +
                          "[[stage]]\nduration = 1\ntype = \"isotropic\"\npressure = \"20 kPa\"");
    CHECK(mean_pressure(path.end().stress()) == doctest::Approx(20e3).epsilon(tight));
    CHECK(path.end().stress().xx - path.end().stress().zz == doctest::Approx(5e3).epsilon(tight));
}

TEST_CASE("oedometric compression adds lateral to axial stress as nu/(1 - nu)")
{
    const DrivenPath path(stage("type = \"oedometric\"\naxial_compression = 0.01"));
    const SymmetricTensor<double> change = path.end().stress() - path.start().stress();
    CHECK(change.xx / change.zz == doctest::Approx(poisson_ratio / (1.0 - poisson_ratio)).epsilon(tight));
    CHECK(change.yy == change.xx);
    CHECK(change.zz == doctest::Approx(-0.01 * (bulk_modulus + 4.0 / 3.0 * shear_modulus)).epsilon(tight));
    CHECK(path.end().strain().xx == 0.0);
}

TEST_CASE("oedometric loading to an axial pressure ends there")
{
    const DrivenPath path(stage("type = \"oedometric\"\naxial_pressure = \"50 kPa\""));
    CHECK(path.end().stress().zz == doctest::Approx(-50e3).epsilon(tight));
    CHECK(path.end().strain().zz ==
          doctest::Approx(-40e3 / (bulk_modulus + 4.0 / 3.0 * shear_modulus)).epsilon(tight).scale(0.0));
}

TEST_CASE("drained triaxial compression has the stiffness E and holds the lateral stress")
{
    for (const std::string target : {"axial_compression = 0.01", "deviator_stress = \"30 kPa\""}) {
        CAPTURE(target);
        const DrivenPath path(stage("type = \"triaxial_drained\"\n" + target));
        CHECK(path.end().stress().zz == doctest::Approx(-10e3 - youngs_modulus * 0.01).epsilon(tight));
        CHECK(path.end().strain().zz == doctest::Approx(-0.01).epsilon(tight).scale(0.0));
        CHECK(path.end().strain().xx == doctest::Approx(0.01 * poisson_ratio).epsilon(tight).scale(0.0));
        CHECK(path.end().stress().xx == doctest::Approx(-10e3).epsilon(tight));
    }
}

TEST_CASE("undrained triaxial compression keeps volume and pressure and has q = 3 G eps_s")
{
    const DrivenPath path(stage("type = \"triaxial_undrained\"\naxial_compression = 0.01"));
    CHECK(std::abs(trace(path.end().strain())) < 1e-16); // round-off of sums of 0.001
    CHECK(mean_pressure(path.end().stress()) == doctest::Approx(10e3).epsilon(tight));
    CHECK(deviator_stress(path.end().stress()) == doctest::Approx(3.0 * shear_modulus * 0.01).epsilon(tight));
    CHECK(equivalent_shear_strain(path.end().strain()) == doctest::Approx(0.01).epsilon(tight).scale(0.0));
}

namespace {

std::string sheared(const std::string& vertical, const std::string& target, int steps)
{
    return rubber + start + "[[stage]]\ntype = \"simple_shear\"\nduration = 1\nvertical = \"" + vertical + "\"\n" +
           target + "\nsteps = " + std::to_string(steps) + "\n";
}

/// A stress or a strain as a number of the file.
std::string given(const std::string& key, double value)
{
    return fmt::format("{} = {}", key, value);
}

} // namespace

TEST_CASE(
    "simple shear by gamma at constant height gives G sin gamma and turns into G (1 - cos gamma) of normal stress")
{
    // Jaumann's rate of stress: d sigma_xz/d gamma = G + (sigma_zz - sigma_xx)/2, d sigma_xx/d gamma = sigma_xz
    for (const double gamma : {0.02, 1.0, -1.0})
        for (const std::string& target :
             {given("shear_strain", gamma), given("shear_stress", shear_modulus * std::sin(gamma))}) {
            CAPTURE(target);
            const DrivenPath path(sheared("constant_height", target, 1000));
            const SymmetricTensor<double> stress = path.end().stress();
            // a step of 0.001 is off by its square over 24
            const double off = shear_modulus * 1e-6 / 24.0 * std::abs(gamma) + tight * shear_modulus;
            CHECK(std::abs(stress.xz - shear_modulus * std::sin(gamma)) < off);
            CHECK(std::abs(stress.xx + 10e3 - shear_modulus * (1.0 - std::cos(gamma))) < off);
            CHECK(std::abs(stress.zz + 10e3 + shear_modulus * (1.0 - std::cos(gamma))) < off);
            CHECK(stress.yy == doctest::Approx(-10e3).epsilon(tight));
            CHECK(std::abs(2.0 * path.end().strain().xz - gamma) < 1e-6);
        }
}

TEST_CASE("simple shear by gamma at constant vertical stress follows the sine of a slower turn")
{
    // With M = K + 4 G/3 and L = K - 2 G/3 the height answers by d eps_zz = sigma_xz d gamma/M, so that
    // d(sigma_xx - sigma_zz)/d gamma = (1 + L/M) sigma_xz: sigma_xz = G/w sin(w gamma), w^2 = (1 + L/M)/2
    const double confined = bulk_modulus + 4.0 / 3.0 * shear_modulus;
    const double w = std::sqrt(0.5 * (1.0 + (bulk_modulus - 2.0 / 3.0 * shear_modulus) / confined));
    const double gamma = 1.0, shear_stress = shear_modulus / w * std::sin(w * gamma);
    for (const std::string& target : {given("shear_strain", gamma), given("shear_stress", shear_stress)}) {
        CAPTURE(target);
        const DrivenPath path(sheared("constant_stress", target, 1000));
        const SymmetricTensor<double> stress = path.end().stress(), strain = path.end().strain();
        CHECK(stress.zz == doctest::Approx(-10e3).epsilon(tight * shear_modulus / 10e3).scale(0.0));
        CHECK(stress.xz == doctest::Approx(shear_stress).epsilon(1e-6).scale(0.0)); // square of a step
        CHECK(2.0 * strain.xz == doctest::Approx(gamma).epsilon(1e-6).scale(0.0));
        CHECK(
            strain.zz ==
            doctest::Approx(shear_modulus / (confined * w * w) * (1.0 - std::cos(w * gamma))).epsilon(1e-6).scale(0.0));
    }
}

TEST_CASE("large steps of simple shear have an error of second order")
{
    const auto error_in = [](int steps) {
        const DrivenPath path(sheared("constant_height", "shear_strain = 1.0", steps));
        return path.end().stress().xz / (shear_modulus * std::sin(1.0)) - 1.0;
    };
    const double five = error_in(5), ten = error_in(10);
    CHECK(five == doctest::Approx(0.04 / 24.0).epsilon(0.02)); // (Delta gamma)^2/24
    CHECK(five / ten == doctest::Approx(4.0).epsilon(0.01));
}

TEST_CASE("a mixed stage turns with its shear xz when it says so, and a pure shear has no spin")
{
    const std::string keys = "type = \"mixed\"\nduration = 1\nsteps = 1000\nstrain = { xz = 0.5 }\n";
    const DrivenPath pure(rubber + start + "[[stage]]\n" + keys);
    CHECK(pure.end().stress().xz == doctest::Approx(shear_modulus).epsilon(tight));
    CHECK(pure.end().stress().xx == doctest::Approx(-10e3).epsilon(tight));
    const DrivenPath simple(rubber + start + "[[stage]]\nmotion = \"simple_shear\"\n" + keys);
    CHECK(simple.end().stress().xz == doctest::Approx(shear_modulus * std::sin(1.0)).epsilon(1e-6).scale(0.0));
    CHECK(simple.end().strain().xz == pure.end().strain().xz);
}

TEST_CASE("a two-way cycle of simple shear leads an elastic stress back")
{
    const DrivenPath path(sheared("constant_height", "shear_strain = 0.5\ncycles = 1\ntwo_way = true", 50));
    CHECK(norm(path.end().stress() - path.start().stress()) < 1e-12 * shear_modulus); // round-off of 200 steps
}

TEST_CASE("true triaxial compression goes to three pressures, or by three compressions")
{
    const DrivenPath stresses(stage("type = \"true_triaxial\"\npressures = [\"20 kPa\", \"30 kPa\", \"60 kPa\"]"));
    CHECK(stresses.end().stress().xx == doctest::Approx(-20e3).epsilon(tight));
    CHECK(stresses.end().stress().yy == doctest::Approx(-30e3).epsilon(tight));
    CHECK(stresses.end().stress().zz == doctest::Approx(-60e3).epsilon(tight));
    // eps_x = (sigma_x - nu (sigma_y + sigma_z))/E of the changes -10, -20 and -50 kPa
    CHECK(stresses.end().strain().xx == doctest::Approx((-10e3 + poisson_ratio * 70e3) / youngs_modulus)
                                            .epsilon(tight)
                                            .scale(60e3 / youngs_modulus)); // of the largest stress

    const DrivenPath strains(stage("type = \"true_triaxial\"\ncompressions = [0.001, 0.002, 0.003]"));
    CHECK(strains.end().strain().yy == doctest::Approx(-0.002).epsilon(tight).scale(0.0));
    CHECK(mean_pressure(strains.end().stress()) == doctest::Approx(10e3 + bulk_modulus * 0.006).epsilon(tight));
}

TEST_CASE("a rise of suction at constant total stress raises the effective pressure by S_r s")
{
    const DrivenPath path(stage("type = \"suction\"\nsuction = \"20 kPa\"\nsaturation = 0.4\nheld = \"total_stress\""));
    CHECK(path.end().suction() == 20e3);
    CHECK(path.end().saturation() == 0.4);
    CHECK(mean_pressure(path.end().stress()) == doctest::Approx(10e3 + 0.4 * 20e3).epsilon(tight));
    CHECK(trace(path.end().strain()) == doctest::Approx(-0.4 * 20e3 / bulk_modulus).epsilon(tight).scale(0.0));
}

TEST_CASE("total stress that is held stays in every step, along a curve and where suction and saturation are given")
{
    const std::string curve = "porosity = 0.5\nretention = { curve = \"hyperbola\", half = \"20 kPa\" }\n";
    const auto text = [&](const std::string& retention, const std::string& initial, const std::string& drying) {
        return rubber + retention + start + initial + "[[stage]]\nduration = 1\nsteps = 10\ntype = \"suction\"\n" +
               drying + "suction = \"60 kPa\"\nheld = \"total_stress\"\n";
    };
    const DrivenPath both(text("", "suction = \"5 kPa\"\nsaturation = 0.9\n", "saturation = 0.3\n"));
    const DrivenPath followed(text(curve, "suction = \"5 kPa\"\n", ""));
    for (const DrivenPath* path : {&both, &followed}) {
        const auto total = [](const MaterialPoint& point) {
            return point.saturation() * point.suction() - mean_pressure(point.stress());
        };
        for (const PathRow& row : path->rows())
            CHECK(total(row.point) == doctest::Approx(total(path->start())).epsilon(tight));
    }
    CHECK(both.rows()[5].point.saturation() == doctest::Approx(0.6));
    CHECK(both.end().saturation() == 0.3);
    const auto hyperbola = [](double suction, double void_ratio) { return 20e3 / (20e3 + void_ratio * suction); };
    CHECK(followed.start().saturation() == doctest::Approx(hyperbola(5e3, 1.0)).epsilon(1e-14));
    for (std::size_t r = 1; r < followed.rows().size(); ++r) // at the void ratio of the step before
        CHECK(followed.rows()[r].point.saturation() ==
              doctest::Approx(hyperbola(followed.rows()[r].point.suction(),
                                        2.0 * std::exp(trace(followed.rows()[r - 1].point.strain())) - 1.0))
                  .epsilon(1e-12));
}

TEST_CASE("with a curve soil is dry until it gets a suction, and follows the void ratio at a suction that stays")
{
    const std::string text = rubber + "porosity = 0.5\nretention = { curve = \"hyperbola\", half = \"20 kPa\" }\n" +
                             start +
                             "[[stage]]\nduration = 1\nsteps = 4\ntype = \"isotropic\"\npressure = \"20 kPa\"\n" +
                             "[[stage]]\nduration = 1\nsteps = 4\ntype = \"suction\"\nsuction = \"20 kPa\"\n"
                             "held = \"effective_stress\"\n" +
                             "[[stage]]\nduration = 1\nsteps = 400\ntype = \"isotropic\"\n"
                             "volumetric_compression = 0.2\n";
    const DrivenPath path(text);
    CHECK(path.rows()[4].point.saturation() == 0.0);
    CHECK(path.rows()[5].point.saturation() > 0.5);
    const double void_ratio = 2.0 * std::exp(-0.2 - 10e3 / bulk_modulus) - 1.0;
    CHECK(path.end().saturation() == doctest::Approx(1.0 / (1.0 + void_ratio)).epsilon(1e-3)); // one step behind
}

TEST_CASE("a rise of suction at constant effective stress does not strain an elastic soil")
{
    const DrivenPath path(
        stage("type = \"suction\"\nsuction = \"20 kPa\"\nsaturation = 0.4\nheld = \"effective_stress\""));
    CHECK(path.end().suction() == 20e3);
    CHECK(norm(path.end().strain()) < tight * 20e3 / bulk_modulus);
}

TEST_CASE("a mixed stage meets the stresses and strains of its components and holds what it is told to")
{
    const DrivenPath path(rubber + "[initial]\nstress = [-1e4, -2e4, -3e4, 1e3, 0, 0]\n" +
                          "[[stage]]\nduration = 1\ntype = \"mixed\"\nheld_stress = [\"yy\", \"xy\"]\n"
                          "stress = { xx = \"-15 kPa\" }\nstrain = { zz = -0.004, yz = 0.001 }");
    const SymmetricTensor<double> stress = path.end().stress();
    const SymmetricTensor<double> strain = path.end().strain();
    CHECK(stress.xx == doctest::Approx(-15e3).epsilon(tight));
    CHECK(stress.yy == doctest::Approx(-20e3).epsilon(tight));
    CHECK(stress.xy == doctest::Approx(1e3).epsilon(tight));
    CHECK(strain.zz == doctest::Approx(-0.004).epsilon(tight).scale(0.0));
    CHECK(stress.yz == doctest::Approx(2.0 * shear_modulus * 0.001).epsilon(tight));
    CHECK(strain.xz == 0.0); // named nowhere
    CHECK(strain.xx == doctest::Approx((-5e3 - poisson_ratio * (stress.zz + 30e3)) / youngs_modulus)
                           .epsilon(tight)
                           .scale(30e3 / youngs_modulus)); // of the largest stress
}

TEST_CASE("a one-way cycle goes to the target and back, and an elastic loop closes")
{
    const DrivenPath path(stage("type = \"triaxial_drained\"\ndeviator_stress = \"30 kPa\"\ncycles = 3"));
    REQUIRE(path.rows().size() == 1 + 3 * 2 * 10);
    for (const std::size_t peak : {10U, 30U, 50U})
        CHECK(deviator_stress(path.rows()[peak].point.stress()) == doctest::Approx(30e3).epsilon(tight));
    CHECK(norm(path.end().stress() - path.start().stress()) < tight * 30e3);
    CHECK(norm(path.end().strain()) < tight * 0.01);
}

TEST_CASE("a two-way cycle swings as far to the other side, at the same rate")
{
    const DrivenPath path(stage(
        "type = \"simple_shear\"\nvertical = \"constant_height\"\nshear_strain = 0.02\ncycles = 2\ntwo_way = true"));
    REQUIRE(path.rows().size() == 1 + 2 * 4 * 10);
    // round-off of 80 steps of 0.001
    for (const auto& [row, shear_strain] :
         {std::pair(10, 0.02), std::pair(30, -0.02), std::pair(50, 0.02), std::pair(80, 0.0)})
        CHECK(std::abs(2.0 * path.rows()[static_cast<std::size_t>(row)].point.strain().xz - shear_strain) < 2e-15);
    CHECK(path.rows().back().time == doctest::Approx(8.0)); // eight times the way to the target
}

TEST_CASE("a rate of strain makes the duration")
{
    const DrivenPath path(rubber + start +
                          "[[stage]]\ntype = \"triaxial_undrained\"\naxial_compression = 0.02\n"
                          "strain_rate = \"1e-3 s^-1\"\nsteps = 4");
    CHECK(path.rows().back().time == doctest::Approx(20.0));
}

TEST_CASE("stages follow each other, with steps, stages and time counted on")
{
    const DrivenPath path(stage("type = \"isotropic\"\npressure = \"20 kPa\"") +
                          "\n[[stage]]\nduration = 3\nsteps = 2\ntype = \"oedometric\"\naxial_compression = 0.01");
    REQUIRE(path.rows().size() == 13);
    CHECK(path.rows()[0].stage == 0);
    CHECK(path.rows()[10].stage == 1);
    CHECK(path.rows()[11].stage == 2);
    CHECK(path.rows().back().step == 12);
    CHECK(path.rows().back().time == doctest::Approx(4.0));
}
