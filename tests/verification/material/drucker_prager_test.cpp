// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Drucker-Prager: where its cone meets the pyramid of Mohr-Coulomb, and the return to cone and cut-off.
#include "frictional_laws.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

const double sin_friction = std::sin(35 * degree);
const double cos_friction = std::cos(35 * degree);

} // namespace

TEST_CASE("the cone of compression fails at q = k + M p, M = 6 sin phi/(3 - sin phi)")
{
    const double cohesion = 700.0;
    const LawMaterial<DruckerPrager> material(sand<DruckerPrager>({{"cohesion", cohesion}}));
    const Stress stress = sheared(material, -1e-4, radial).stress();
    const double factor = 6.0 / (3.0 - sin_friction);
    CHECK(deviator_stress(stress) ==
          doctest::Approx(factor * (cohesion * cos_friction + sin_friction * mean_pressure(stress))).epsilon(1e-12));
}

TEST_CASE("the cone of extension has the strength and dilation of Mohr-Coulomb in triaxial extension")
{
    const double cohesion = 100.0;
    const LawMaterial<DruckerPrager> material(sand<DruckerPrager>({{"cohesion", cohesion}}, "extension"));
    MaterialPoint point = sheared(material, 1e-4, radial);
    // the lateral stress of 1 kPa is the larger pressure now: 1 kPa = N s + 2 c sqrt(N)
    const double ratio = (1.0 + sin_friction) / (1.0 - sin_friction);
    CHECK(-point.stress().zz == doctest::Approx((1000.0 - 2.0 * cohesion * std::sqrt(ratio)) / ratio).epsilon(1e-9));
    const Strain before = point.strain();
    step_holding_xx(point, 1e-4, radial);
    const double s = std::sin(10 * degree);
    // the two lateral strains together are -(1 - sin psi)/(1 + sin psi) of the axial one
    CHECK((point.strain().xx + point.strain().yy - before.xx - before.yy) / 1e-4 ==
          doctest::Approx(-(1.0 - s) / (1.0 + s)).epsilon(1e-9));
}

TEST_CASE("the cone of plane strain ends in plane strain at the strength and dilation of Mohr-Coulomb")
{
    for (const double dilatancy : {0.0, 10.0, 35.0}) {
        CAPTURE(dilatancy);
        const double cohesion = 700.0;
        const LawMaterial<DruckerPrager> material(
            sand<DruckerPrager>({{"cohesion", cohesion}, {"dilatancy_angle", dilatancy}}, "plane_strain"));
        MaterialPoint point = sheared(material, -1e-3, in_plane);
        const Stress stress = point.stress();
        const double radius = 0.5 * (stress.xx - stress.zz);
        const double centre = -0.5 * (stress.xx + stress.zz);
        // the out-of-plane stress creeps to its end as exp(-3 G eps_s/q): 0.2 of strain against q/3G = 1e-4
        CHECK(radius == doctest::Approx(centre * sin_friction + cohesion * cos_friction).epsilon(1e-9));
        const Strain before = point.strain();
        step_holding_xx(point, -1e-3, in_plane);
        const double lateral = point.strain().xx - before.xx;
        CHECK((lateral - 1e-3) / (lateral + 1e-3) == doctest::Approx(std::sin(dilatancy * degree)).epsilon(1e-9));
    }
}

TEST_CASE("of any trial the end is on the cone, on the cut-off, on both or inside, with the flow that goes with it")
{
    const double cohesion = 300.0, cut_off = 150.0;
    const DruckerPrager law(sand<DruckerPrager>({{"cohesion", cohesion}, {"tensile_strength", cut_off}}));
    const MatchedCone& cone = law.cone();
    Random random;
    int elastic = 0, on_cone = 0, on_cut_off = 0, in_corner = 0;
    for (int n = 0; n < 10000; ++n) {
        auto input = random_input<DruckerPrager>(random);
        input.state[FrictionalSoil::shear_strain] = 0.0; // so that the multiplier is read without round-off of a sum
        const auto after = law.update(input);
        REQUIRE_FALSE(after.failed);
        const double stress_round_off = 4e-15 * size_of(input);
        const double strain_round_off = stress_round_off / shear_modulus;

        const double p = mean_pressure(after.stress), q = deviator_stress(after.stress);
        const double opening = after.state[FrictionalSoil::opening];
        const double multiplier = after.state[FrictionalSoil::shear_strain] - input.state[FrictionalSoil::shear_strain];
        const double excess = q - cone.strength - cone.slope * p;
        // admissible, multipliers not negative, and each zero where its surface is not reached
        CHECK(excess <= stress_round_off);
        CHECK(p >= -cut_off - stress_round_off);
        CHECK(multiplier >= 0.0);
        CHECK(opening >= 0.0);
        const bool flows = multiplier > 0.0, open = opening > 0.0;
        CHECK((!flows || std::abs(excess) <= stress_round_off));
        CHECK((!open || std::abs(p + cut_off) <= stress_round_off));
        // what is not elastic: the multiplier along the deviator with its dilation, and the change of the opening
        const Strain plastic = elastic_strain(trial_stress(input) - after.stress);
        const double volume = cone.dilatancy * multiplier + opening - input.state[FrictionalSoil::opening];
        CHECK(std::abs(trace(plastic) - volume) <= strain_round_off);
        CHECK(norm(deviator(plastic) - deviator(after.stress) * (1.5 * multiplier / q)) <= strain_round_off);
        ++(flows ? (open ? in_corner : on_cone) : open ? on_cut_off : elastic);
    }
    for (const int count : {elastic, on_cone, on_cut_off, in_corner})
        CHECK(count > 100);
    MESSAGE("elastic ", elastic, ", cone ", on_cone, ", cut-off ", on_cut_off, ", corner ", in_corner);
}

TEST_CASE("a cut-off at the tip of the cone leaves no shear stress there")
{
    const DruckerPrager law(
        sand<DruckerPrager>({{"cohesion", 300.0}, {"tensile_strength", 300.0 * cos_friction / sin_friction}}));
    LawInput<double, 3> input{};
    input.strain_increment = {1e-3, 2e-3, 1e-3, 1e-4, 0.0, 0.0};
    const auto after = law.update(input);
    CHECK(after.stress.xx == doctest::Approx(300.0 * cos_friction / sin_friction).epsilon(1e-12));
    CHECK(deviator_stress(after.stress) <= 1e-11); // of a trial stress of 50 kPa
}

TEST_CASE("flow without normality is stiffer than the elastic law by (1/cos t - 1)/2 in one direction, more in none")
{
    const LawMaterial<DruckerPrager> material(sand<DruckerPrager>());
    const MaterialPoint point = sheared(material, -1e-4, radial);
    // strains of unit elastic energy: the angle t between the gradient of f and the flow lies in their plane
    const Stress deviatoric = deviator(point.stress());
    const Strain shear = deviatoric * (1.0 / (norm(deviatoric) * std::sqrt(2.0 * shear_modulus)));
    const Strain volume = Strain::isotropic(1.0 / (3.0 * std::sqrt(bulk_modulus)));
    const double size = 1e-3; // changes the stress by some Pa
    double stiffest = 0.0;
    for (int n = 0; n < 1000; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / 1000;
        const Strain strain = (shear * std::cos(angle) + volume * std::sin(angle)) * size;
        MaterialPoint moved = point;
        moved.step(strain, time_step);
        stiffest = std::max(stiffest, double_contraction(moved.stress() - point.stress(), strain) / (size * size));
    }
    const MatchedCone& cone = material.law().cone();
    const auto product = [](double a, double b) { return 3.0 * shear_modulus + bulk_modulus * a * b; };
    const double cosine = product(cone.slope, cone.dilatancy) /
                          std::sqrt(product(cone.slope, cone.slope) * product(cone.dilatancy, cone.dilatancy));
    CHECK(stiffest == doctest::Approx(0.5 + 0.5 / cosine).epsilon(2e-5)); // half of the squared spacing of the angles
}
