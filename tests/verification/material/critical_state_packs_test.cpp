// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The critical-state law on packs: every lane gives what the point alone gives, whatever its neighbours do.
#include "critical_state_soil.hpp"
#include "pack_of_points.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// A point of a soil that may be dry, wet or saturated, loose or dense, in a strain step of 1e-6 to 1e-2.
LawInput<double, 3> random_input(Random& random)
{
    LawInput<double, 3> input{};
    const double p = std::exp(random.number(3.0, 9.0));
    input.stress = Stress::isotropic(-p) + deviator(random.tensor(0.5 * p));
    input.strain_increment = random.tensor(std::pow(10.0, random.number(-6.0, -2.0)));
    input.state = {std::log(p * random.number(0.5, 4.0)), random.number(0.0, 1.0), random.number(-0.1, 0.1)};
    if (random.number() > 0.0) {
        input.suction = random.number(0.0, 5e4);
        input.saturation = random.number(0.7, 1.0);
    }
    input.time_step = 1e-4;
    return input;
}

Soil wettable_soil()
{
    return soil({{"bonding_c1", 0.185}, {"bonding_c2", 1.42}, {"reference_specific_volume", 2.76}, {"viscosity", 1e3}});
}

double largest_trial_stress(const LawInput<double, 3>& input)
{
    return norm(elastic_stress(input.stress, input.strain_increment, bulk_modulus, shear_modulus)) +
           std::exp(input.state[Soil::log_preconsolidation]);
}

} // namespace

TEST_CASE("a pack gives what its lanes give one by one")
{
    const Soil law = wettable_soil();
    Random random;
    std::size_t yielding = 0, points = 0;
    while (points < 24000) {
        Lanes<3> lanes{};
        for (auto& lane : lanes)
            lane = random_input(random);
        const auto result = law.update(packed(lanes));
        REQUIRE_FALSE(any(result.failed));
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            const auto expected = law.update(lanes[lane]);
            ++points;
            yielding += expected.state[Soil::shear_strain] > lanes[lane].state[Soil::shear_strain];
            // The same operations but for the exponential (2 units in the last place) and fused multiply-adds. The
            // return map is a projection and does not amplify round-off of the trial stress or of pc_bar, whose
            // logarithm of about 10 is itself rounded to 8 units of its exponential.
            const double stress_round_off = 16.0 * epsilon * largest_trial_stress(lanes[lane]);
            CHECK(norm(lane_of(result.stress, lane) - expected.stress) <= stress_round_off);
            const double strain_round_off = stress_round_off / shear_modulus + epsilon;
            for (const auto s : {Soil::shear_strain, Soil::volumetric_strain})
                CHECK(std::abs(result.state[s][lane] - expected.state[s]) <= strain_round_off);
            CHECK(
                std::abs(result.state[Soil::log_preconsolidation][lane] - expected.state[Soil::log_preconsolidation]) <=
                strain_round_off / plastic_index + 16.0 * epsilon);
        }
    }
    CHECK(yielding > points / 3);
}

TEST_CASE("a lane does not feel its neighbours, to the last bit")
{
    const Soil law = wettable_soil();
    Random random;
    for (int n = 0; n < 1000; ++n) {
        const LawInput<double, 3> watched = random_input(random);
        Lanes<3> alone{};
        alone.fill(watched);
        Lanes<3> among_others{};
        for (auto& lane : among_others)
            lane = random_input(random);
        const std::size_t seat = static_cast<std::size_t>(n) % pack_width;
        among_others[seat] = watched;
        const auto one = law.update(packed(alone));
        const auto other = law.update(packed(among_others));
        CHECK(components(lane_of(one.stress, seat)) == components(lane_of(other.stress, seat)));
        for (std::size_t s = 0; s < 3; ++s)
            CHECK(one.state[s][seat] == other.state[s][seat]);
    }
}

TEST_CASE("an elastic lane among yielding ones keeps its state and has the elastic stress, to the last bit")
{
    const Soil law = soil();
    Lanes<3> lanes{};
    for (auto& lane : lanes) {
        lane = isotropic_point(law, 1000.0, 1200.0).now;
        lane.strain_increment = {-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0};
    }
    lanes[0].state = {std::log(1e6), 0.25, -0.125};
    const auto input = packed(lanes);
    const auto result = law.update(input);
    const auto elastic = elastic_stress(input.stress, input.strain_increment, bulk_modulus, shear_modulus);
    CHECK(components(lane_of(result.stress, 0)) == components(lane_of(elastic, 0)));
    for (std::size_t s = 0; s < 3; ++s)
        CHECK(result.state[s][0] == lanes[0].state[s]);
    if (pack_width > 1)
        CHECK(result.state[Soil::shear_strain][1] > 0.0);
}

TEST_CASE("a lane that is not a number fails alone")
{
    const Soil law = soil();
    Lanes<3> lanes{};
    for (auto& lane : lanes) {
        lane = isotropic_point(law, 1000.0, 1200.0).now;
        lane.strain_increment = {-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0};
    }
    const auto healthy = law.update(lanes[0]);
    lanes[pack_width - 1].stress.xy = std::numeric_limits<double>::quiet_NaN();
    const auto result = law.update(packed(lanes));
    CHECK(result.reason != nullptr);
    CHECK(result.failed[pack_width - 1]);
    for (std::size_t lane = 0; lane + 1 < pack_width; ++lane) {
        CHECK_FALSE(result.failed[lane]);
        CHECK(norm(lane_of(result.stress, lane) - healthy.stress) <= 1e-12 * norm(healthy.stress));
    }
}

TEST_CASE("initial preconsolidation of a pack is that of its lanes")
{
    const Soil law = wettable_soil();
    Random random;
    for (int n = 0; n < 200; ++n) {
        Lanes<3> lanes{};
        for (auto& lane : lanes) {
            lane = random_input(random);
            lane.stress += Stress::isotropic(random.number(0.0, 100.0)); // some in tension
        }
        const auto state = law.initial_state(packed(lanes), 1.25);
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            for (std::size_t s = 0; s < 3; ++s)
                // q^2 and its quotient carry some units in the last place into a logarithm of about 10
                CHECK(std::abs(state[s][lane] - law.initial_state(lanes[lane], 1.25)[s]) <= 32.0 * epsilon);
    }
}
