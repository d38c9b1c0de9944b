// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families that are too small or too flat to say how they deform: counted, finite, and without stress.
#include "support/specimens.hpp"

#include <doctest/doctest.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;

/// Turned by a random rotation and moved, so that no coordinate is zero by accident.
std::vector<Vector3> anywhere(std::vector<Vector3> positions, std::mt19937& generator)
{
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    const auto number = [&] { return value(generator); };
    const Eigen::Quaterniond turn = Eigen::Quaterniond(number(), number(), number(), number()).normalized();
    const Vector3 shift(number(), number(), number());
    for (Vector3& x : positions)
        x = turn * x + shift;
    return positions;
}

struct Outcome {
    std::size_t bonds = 0;
    std::size_t active = 0;
    std::size_t free_grains = 0;
    double largest_force = 0.0;
    bool finite = true;
};

/// One step of random velocities of 1 m/s with bonds that carry stress, and what became of it.
Outcome one_step(const std::vector<Vector3>& positions, const ForceState& force, std::mt19937& generator)
{
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    Model model = from_positions(positions, dx);
    find_first_families(model, force);
    set_stress(model, [&](std::size_t, std::size_t) { return SymmetricTensor<double>::isotropic(-1e4); });
    set_velocity(model, [&](const Vector3&) { return Vector3(value(generator), value(generator), value(generator)); });
    force.evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-5});
    Outcome outcome;
    for (std::size_t i = 0; i < model.size(); ++i) {
        outcome.bonds += model.neighbourhood.families[i].count;
        outcome.active += model.neighbourhood.families[i].count - model.result.inactive_bonds[i];
        outcome.free_grains += model.result.detached[i];
        outcome.largest_force = std::max(outcome.largest_force, model.result.internal_force[i].norm());
        outcome.finite = outcome.finite && model.result.internal_force[i].allFinite();
    }
    return outcome;
}

} // namespace

TEST_CASE("a lone point, a pair, three points, a row and a one-layer sheet carry no stress, whichever way they lie")
{
    const std::vector<Vector3> far_pair{{0, 0, 0}, {2.99 * dx, 0, 0}};
    const std::vector<Vector3> triangle{{0, 0, 0}, {1.4 * dx, 0, 0}, {0.3 * dx, 0.9 * dx, 0}};
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        std::mt19937 generator(11);
        for (const auto& shape : {lattice(1, 1, 1, dx), lattice(2, 1, 1, dx), far_pair, triangle, lattice(6, 1, 1, dx),
                                  lattice(5, 5, 1, dx)}) {
            CAPTURE(shape.size());
            for (int trial = 0; trial < 40; ++trial) {
                const Outcome outcome = one_step(anywhere(shape, generator), force, generator);
                REQUIRE(outcome.active == 0);
                REQUIRE(outcome.free_grains == shape.size());
                REQUIRE(outcome.largest_force == 0.0);
            }
        }
    });
}

TEST_CASE("a two-layer sheet and random clouds of few points stay finite and every bond is counted once")
{
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        std::mt19937 generator(12);
        CHECK(one_step(anywhere(lattice(5, 5, 2, dx), generator), force, generator).finite);
        std::uniform_real_distribution<double> coordinate(0.0, 3.0 * dx);
        for (std::size_t count = 4; count < 30; ++count) {
            std::vector<Vector3> cloud(count);
            for (Vector3& x : cloud)
                x = {coordinate(generator), coordinate(generator), coordinate(generator)};
            const Outcome outcome = one_step(cloud, force, generator);
            CHECK(outcome.finite);
            CHECK(outcome.active <= outcome.bonds);
            // a stress of 1e4 Pa that changes by E D dt = 6e6 * 1/dx * 1e-5 on bonds no thinner than the bound:
            // sigma/thickness over a family's volume, 2 V0 a point at most
            CHECK(outcome.largest_force < 1e6 * dx * dx);
        }
    });
}

TEST_CASE("an intact lattice has no inactive bond, at faces, edges and corners too")
{
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        std::mt19937 generator(13);
        const Outcome outcome = one_step(lattice(8, 8, 8, dx), force, generator);
        CHECK(outcome.active == outcome.bonds);
    });
}
