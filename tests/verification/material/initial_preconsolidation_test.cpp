// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The preconsolidation pressure that a settled stress and an overconsolidation ratio imply.
#include "critical_state_soil.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

LawInput<double, 3> settled(const Stress& stress)
{
    LawInput<double, 3> input{};
    input.stress = stress;
    input.time_step = 1e-4;
    return input;
}

} // namespace

TEST_CASE("pc0 = OCR (p + q2/(M2 p)) of a geostatic stress")
{
    // sigma_v = 1 kPa at the elastic K0 = 1/3: p = 5/9 kPa, q = 2/3 kPa, q/p = 1.2 > M
    const LawInput<double, 3> input = settled({-1000.0 / 3.0, -1000.0 / 3.0, -1000.0, 0.0, 0.0, 0.0});
    const auto state = soil().initial_state(input, 1.25);
    const double p = 5000.0 / 9.0, q = 2000.0 / 3.0;
    CHECK(std::exp(state[Soil::log_preconsolidation]) ==
          doctest::Approx(1.25 * (p + q * q / (1.21 * p))).epsilon(1e-13));
    CHECK(state[Soil::shear_strain] == 0.0);
    CHECK(state[Soil::volumetric_strain] == 0.0);
}

TEST_CASE("a normally consolidated stress starts on the surface, whatever its obliquity")
{
    Random random;
    for (int n = 0; n < 500; ++n) {
        const double p = random.number(floor_pressure, 5000.0);
        const LawInput<double, 3> input = settled(Stress::isotropic(-p) + deviator(random.tensor(2.0 * p)));
        const double pc = std::exp(soil().initial_state(input, 1.0)[Soil::log_preconsolidation]);
        // the logarithm of about 10 is rounded to 1e-15 of pc times 10
        CHECK(std::abs(yield_function(input.stress, pc)) <= 1e-13 * pc * pc);
    }
}

TEST_CASE("an overconsolidated stress is left alone by a step without strain")
{
    Random random;
    const Soil law = soil();
    for (int n = 0; n < 500; ++n) {
        const double p = random.number(floor_pressure, 5000.0);
        LawInput<double, 3> input = settled(Stress::isotropic(-p) + deviator(random.tensor(2.0 * p)));
        input.state = law.initial_state(input, 1.25);
        const auto after = law.update(input);
        CHECK(components(after.stress) == components(input.stress));
        CHECK(after.state == input.state);
    }
}

TEST_CASE("stress near zero or in tension gets a finite pressure, not less than the floor")
{
    const Soil law = soil();
    const double floor = std::log(floor_pressure);
    CHECK(law.initial_state(settled(Stress{}), 1.25)[0] == doctest::Approx(floor).epsilon(1e-15));
    CHECK(law.initial_state(settled(Stress::isotropic(300.0)), 1.25)[0] == doctest::Approx(floor).epsilon(1e-15));
    const Stress sheared{0.0, 0.0, 0.0, 100.0, 0.0, 0.0}; // p = 0 and q = 173 Pa: "q2/p" has no bound
    CHECK(law.initial_state(settled(sheared), 1.25)[0] == doctest::Approx(floor).epsilon(1e-15));
    // p = 1 Pa counts as the 20 Pa of the floor
    const double pc = 1.25 * (20.0 + 3e4 / (1.21 * 20.0));
    CHECK(law.initial_state(settled(sheared + Stress::isotropic(-1.0)), 1.25)[0] ==
          doctest::Approx(std::log(pc)).epsilon(1e-13));
}

TEST_CASE("under suction the shifted pressure, not pc itself, is the multiple of the settled stress")
{
    const Soil law = soil({{"bonding_c1", 0.185}, {"bonding_c2", 1.42}, {"reference_specific_volume", 2.76}});
    LawInput<double, 3> input = settled(Stress::isotropic(-2000.0) + Stress{0.0, 0.0, 0.0, 500.0, 0.0, 0.0});
    input.suction = 20e3;
    input.saturation = 0.9;
    input.state = law.initial_state(input, 1.0);
    // on the surface: the least loading yields, the least unloading does not
    const auto plastic_strain = [&](double strain) {
        LawInput<double, 3> probe = input;
        probe.strain_increment = Strain::isotropic(-strain);
        return law.update(probe).state[Soil::volumetric_strain];
    };
    CHECK(plastic_strain(1e-8) > 0.0);
    CHECK(plastic_strain(-1e-8) == 0.0);
}
