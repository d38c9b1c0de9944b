// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The critical-state law on packs: every lane gives what the point alone gives, whatever its neighbours do.
#include "critical_state_soil.hpp"
#include "periporo/kit/packed.hpp"

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
    input.stress = Stress::isotropic(-p) + deviator(random.tensor(random.number(0.0, 1.5) * p)); // q up to 1.8 p
    input.strain_increment = random.tensor(std::pow(10.0, random.number(-6.0, -2.0)));
    input.state = {std::log(p * random.number(0.5, 4.0)), random.number(0.0, 1.0), random.number(-0.1, 0.1)};
    if (random.number() > 0.0) {
        input.suction = random.number(0.0, 5e4);
        input.saturation = random.number(0.7, 1.0);
    }
    input.time_step = 1e-4;
    return input;
}

const std::map<std::string, double> wettable = {
    {"bonding_c1", 0.185}, {"bonding_c2", 1.42}, {"reference_specific_volume", 2.76}, {"viscosity", 1e3}};

// The stresses that a step handles: the trial stress, and the size of the ellipse to which it returns. That is pc_bar,
// which suction raises to many times pc, and which a step that compacts raises further.
double largest_stress(const LawInput<double, 3>& before, const LawResult<double, 3>& after)
{
    static const SuctionHardening hardening(soil_parameters(wettable), 0.12, 0.04);
    const auto shift = hardening.shift(before.suction, before.saturation);
    const double log_preconsolidation =
        std::max(before.state[Soil::log_preconsolidation], after.state[Soil::log_preconsolidation]);
    return norm(elastic_stress(before.stress, before.strain_increment, bulk_modulus, shear_modulus)) +
           std::exp(SuctionHardening::shifted(log_preconsolidation, shift));
}

} // namespace

TEST_CASE("a pack gives what its lanes give one by one")
{
    const Soil law = soil(wettable);
    Random random;
    std::size_t yielding = 0, points = 0;
    while (points < 24000) {
        std::vector<LawInput<double, 3>> lanes(pack_width);
        for (auto& lane : lanes)
            lane = random_input(random);
        const auto result = law.update(kit::packed<Pack>(lanes));
        REQUIRE_FALSE(any(result.failed));
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            const auto expected = law.update(lanes[lane]);
            ++points;
            yielding += expected.state[Soil::shear_strain] > lanes[lane].state[Soil::shear_strain];
            // The same operations but for the exponential (2 units in the last place) and fused multiply-adds. The
            // return map is a projection and does not amplify round-off of the trial stress or of pc_bar, whose
            // logarithm of about 10 is itself rounded to 8 units of its exponential.
            const double stress_round_off = 16.0 * epsilon * largest_stress(lanes[lane], expected);
            CHECK(norm(kit::lane_of_tensor(result.stress, lane) - expected.stress) <= stress_round_off);
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
    const Soil law = soil(wettable);
    Random random;
    for (int n = 0; n < 1000; ++n) {
        const LawInput<double, 3> watched = random_input(random);
        const std::vector<LawInput<double, 3>> alone(pack_width, watched);
        std::vector<LawInput<double, 3>> among_others(pack_width);
        for (auto& lane : among_others)
            lane = random_input(random);
        const std::size_t seat = static_cast<std::size_t>(n) % pack_width;
        among_others[seat] = watched;
        const auto one = law.update(kit::packed<Pack>(alone));
        const auto other = law.update(kit::packed<Pack>(among_others));
        CHECK(components(kit::lane_of_tensor(one.stress, seat)) == components(kit::lane_of_tensor(other.stress, seat)));
        for (std::size_t s = 0; s < 3; ++s)
            CHECK(one.state[s][seat] == other.state[s][seat]);
    }
}

TEST_CASE("an elastic lane among yielding ones keeps its state and has the elastic stress, to the last bit")
{
    const Soil law = soil();
    std::vector<LawInput<double, 3>> lanes(pack_width);
    for (auto& lane : lanes) {
        lane = isotropic_input(1000.0, 1200.0);
        lane.strain_increment = {-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0};
    }
    lanes[0].state = {std::log(1e6), 0.25, -0.125};
    const auto input = kit::packed<Pack>(lanes);
    const auto result = law.update(input);
    const auto elastic = elastic_stress(input.stress, input.strain_increment, bulk_modulus, shear_modulus);
    CHECK(components(kit::lane_of_tensor(result.stress, 0)) == components(kit::lane_of_tensor(elastic, 0)));
    for (std::size_t s = 0; s < 3; ++s)
        CHECK(result.state[s][0] == lanes[0].state[s]);
    if (pack_width > 1)
        CHECK(result.state[Soil::shear_strain][1] > 0.0);
}

TEST_CASE("initial preconsolidation of a pack is that of its lanes")
{
    const Soil law = soil(wettable);
    Random random;
    for (int n = 0; n < 200; ++n) {
        std::vector<LawInput<double, 3>> lanes(pack_width);
        for (auto& lane : lanes) {
            lane = random_input(random);
            lane.stress += Stress::isotropic(random.number(0.0, 100.0)); // some in tension
        }
        const auto state = law.initial_state(kit::packed<Pack>(lanes), 1.25);
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            for (std::size_t s = 0; s < 3; ++s)
                // q^2 and its quotient carry some units in the last place into a logarithm of about 10
                CHECK(std::abs(state[s][lane] - law.initial_state(lanes[lane], 1.25)[s]) <= 32.0 * epsilon);
    }
}
