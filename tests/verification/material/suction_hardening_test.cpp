// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Suction: its shift of the yield surface, the exact dry limit, and the strength it lends through the effective stress.
#include "critical_state_soil.hpp"
#include "periporo/kit/packed.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace periporo;
using namespace periporo::test;

namespace {

const std::map<std::string, double> bonding = {
    {"bonding_c1", 0.185}, {"bonding_c2", 1.42}, {"reference_specific_volume", 2.76}};

// The bonding formulas once more, in the form of Borja (2004), with the soil's lambda = 0.12 and kappa = 0.04.
struct Shift {
    double a;
    double b;
};
Shift expected_shift(double suction, double saturation)
{
    const double ratio = suction / 101325.0;
    const double xi = (1.0 + ratio / (10.7 + 2.4 * ratio)) * (1.0 - saturation);
    const double c = 1.0 - 0.185 * (1.0 - std::exp(1.42 * xi));
    return {2.76 * (c - 1.0) / (0.12 * c - 0.04), (0.12 - 0.04) / (0.12 * c - 0.04)};
}

double shifted_pressure(double pc, const Shift& shift)
{
    return 1000.0 * std::exp(shift.a) * std::pow(pc / 1000.0, shift.b);
}

} // namespace

TEST_CASE("yield in isotropic compression is at p_ref exp(a) (pc/p_ref)^b")
{
    for (const double saturation : {0.0, 0.5, 0.9})
        for (const double suction : {1e3, 20e3, 40e3}) {
            CAPTURE(saturation);
            CAPTURE(suction);
            const double bound = shifted_pressure(500.0, expected_shift(suction, saturation));
            const SoilMaterial material(soil_parameters(bonding));
            MaterialPoint point = isotropic_point(material, 100.0, 500.0);
            point.set_water(suction, saturation);
            // half a per mille short of the bound, and then beyond it
            step(point, Strain::isotropic(-(0.9995 * bound - 100.0) / bulk_modulus / 3.0));
            CHECK(point.state(Soil::volumetric_strain) == 0.0);
            step(point, Strain::isotropic(-0.001 * bound / bulk_modulus / 3.0));
            CHECK(point.state(Soil::volumetric_strain) > 0.0);
            // on the surface that belongs to the new pc; the logarithms carry round-off times a and b of order 1 to 10
            CHECK(mean_pressure(point.stress()) ==
                  doctest::Approx(shifted_pressure(preconsolidation(point), expected_shift(suction, saturation)))
                      .epsilon(1e-11));
        }
}

TEST_CASE("virgin loading at constant suction is stiffer in ln p by the factor 1/b")
{
    const double suction = 20e3, saturation = 0.8;
    const Shift shift = expected_shift(suction, saturation);
    REQUIRE(shift.b < 0.95);
    const double pc0 = 500.0, start = shifted_pressure(pc0, shift);
    const SoilMaterial material(soil_parameters(bonding));
    MaterialPoint point = isotropic_point(material, start, pc0);
    point.set_water(suction, saturation);
    for (int n = 1; n <= 100; ++n) {
        step(point, Strain::isotropic(-1e-3 / 3.0));
        const double p = mean_pressure(point.stress());
        CHECK((p - start) / bulk_modulus + plastic_index / shift.b * std::log(p / start) ==
              doctest::Approx(1e-3 * n).epsilon(1e-10).scale(0.0));
    }
}

TEST_CASE("dry soil with bonding parameters is the soil without them, to the last bit")
{
    const Soil plain = soil();
    const Soil bonded = soil(bonding);
    Random random;
    for (int n = 0; n < 500; ++n) {
        std::vector<LawInput<double, 3>> lanes(pack_width);
        for (auto& lane : lanes) {
            lane = isotropic_input(1000.0, 1000.0 * random.number(1.0, 2.0));
            lane.strain_increment = random.tensor(1e-3);
        }
        CHECK(components(plain.update(lanes[0]).stress) == components(bonded.update(lanes[0]).stress));
        CHECK(plain.update(lanes[0]).state == bonded.update(lanes[0]).state);
        const auto one = plain.update(kit::packed<Pack>(lanes));
        // one lane is wet, so that the shift is computed for the whole pack
        lanes[0].suction = 20e3;
        const auto other = bonded.update(kit::packed<Pack>(lanes));
        for (std::size_t lane = 1; lane < pack_width; ++lane)
            CHECK(components(kit::lane_of_tensor(one.stress, lane)) ==
                  components(kit::lane_of_tensor(other.stress, lane)));
    }
}

TEST_CASE("saturated soil at zero suction is not shifted")
{
    const LawInput<double, 3> dry = [] {
        auto input = isotropic_input(1000.0, 1200.0);
        input.strain_increment = {-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0};
        return input;
    }();
    LawInput<double, 3> saturated = dry;
    saturated.saturation = 1.0;
    CHECK(components(soil(bonding).update(saturated).stress) == components(soil(bonding).update(dry).stress));
}

TEST_CASE("without bonding parameters suction does not harden")
{
    LawInput<double, 3> dry = isotropic_input(1000.0, 1200.0);
    dry.strain_increment = {-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0};
    LawInput<double, 3> wet = dry;
    wet.suction = 20e3;
    wet.saturation = 0.3;
    CHECK(components(soil().update(wet).stress) == components(soil().update(dry).stress));
}

TEST_CASE("one bonding parameter without the others is refused")
{
    for (const auto& [name, value] : bonding) {
        CAPTURE(name);
        CHECK_THROWS_WITH_AS(soil({{name, value}}), doctest::Contains("give all three, or none"),
                             std::invalid_argument);
    }
}

TEST_CASE("unconfined strength is 3 M/(3 - M) S_r s, 1.74 S_r s at M = 1.1")
{
    const double suction = 20e3, saturation = 0.02;
    const double lent = saturation * suction; // S_r s, an isotropic tension of the total over the effective stress
    for (const bool bonded : {false, true}) {
        CAPTURE(bonded);
        // total stress zero: sigma' = -S_r s 1
        // weak bonding: with Borja's c1 = 0.185 a soil as dry as this would yield in compression at 36 MPa
        std::map<std::string, double> weak = bonding;
        weak["bonding_c1"] = 0.01;
        const SoilMaterial material(soil_parameters(bonded ? weak : std::map<std::string, double>{}));
        MaterialPoint point = isotropic_point(material, lent, 2.0 * lent);
        point.set_water(suction, saturation);
        // lateral total, and so lateral effective, stress held while the axis shortens to the critical state
        for (int n = 0; n < 3000; ++n)
            step_triaxial(point, -1e-3);
        const double axial_total = -(point.stress().xx + lent);
        const double lateral_total = -(point.stress().yy + lent);
        CHECK(std::abs(lateral_total) <= 1e-3); // 3000 steps of a driver that leaves 1e-7 Pa
        // q = M p', p' = q/3 + S_r s
        CHECK(axial_total == doctest::Approx(3.0 * critical_slope / (3.0 - critical_slope) * lent).epsilon(1e-5));
        CHECK(axial_total / lent == doctest::Approx(1.74).epsilon(0.005));
    }
}
