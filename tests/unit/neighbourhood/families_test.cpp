// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families and sub-horizons against their definition, by looking at all pairs.
#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <set>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double horizon = 3.015 * dx;

/// With families, sub-horizons and accumulators.
Model model_of(const std::vector<Vector3>& positions, double reach = horizon)
{
    Model model = from_positions(positions, dx, reach / dx);
    model.neighbourhood.find(model.state);
    return model;
}

/// By looking at all chains: are two points joined by three links at most, inside both horizons?
bool joined(const std::vector<Vector3>& x, std::size_t i, std::size_t j, double reach)
{
    const auto near = [&](std::size_t a, std::size_t b, double limit) { return (x[a] - x[b]).norm() <= limit; };
    const double link = link_length(dx, reach);
    if (!near(i, j, reach))
        return false;
    const auto linked = [&](std::size_t a, std::size_t b) { return a == b || near(a, b, link); };
    for (std::size_t a = 0; a < x.size(); ++a)
        for (std::size_t b = 0; linked(i, a) && near(a, j, reach) && b < x.size(); ++b)
            if (linked(a, b) && linked(b, j) && near(b, i, reach))
                return true;
    return false;
}

/// How often each bond's neighbour counts in each sub-horizon, by the changes from one sum to the next.
std::vector<std::vector<int>> membership(const SubHorizonView& view)
{
    std::vector<std::vector<int>> counts(view.count + 2, std::vector<int>(view.count + 1, 0));
    std::fill_n(counts[view.count + 1].begin(), view.count, 1);
    view.with_members([&](const auto* member) {
        std::set<std::uint16_t> changed;
        for (std::size_t c = 0; c < view.count; ++c) {
            const auto [bond, pairs] = view.changes[c];
            REQUIRE((c == 0 || view.changes[c - 1].pairs <= pairs));
            REQUIRE(bond < view.count);
            REQUIRE(changed.insert(bond).second);
            for (const int sign : {1, -1})
                for (std::size_t m = 0; m < pairs; ++m) {
                    const std::size_t number = *member++;
                    REQUIRE(number < view.first_twins() + view.twins());
                    if (number < view.first_twins()) {
                        counts[bond][number] += sign;
                    } else {
                        counts[bond][2 * (number - view.first_twins())] += sign;
                        counts[bond][2 * (number - view.first_twins()) + 1] += sign;
                    }
                }
        }
    });
    for (std::size_t b = 0; b < view.count; ++b) {
        REQUIRE((view.from[b] < b || view.from[b] >= view.count));
        std::ranges::transform(counts[b], counts[view.from[b]], counts[b].begin(), std::plus());
    }
    counts.resize(view.count);
    return counts;
}

} // namespace

TEST_CASE("a bulk point of a lattice at delta = 3.015 dx has 122 bonds whose sub-horizons hold 6764 members")
{
    // counted by hand: integer vectors with 0 < n.n <= 9, and for each the ones within distance 3.015 of it
    const Model model = model_of(lattice(9, 9, 9, dx));
    constexpr std::size_t centre = (4 * 9 + 4) * 9 + 4;
    CHECK(model.neighbourhood.families[centre].count == 122);
    int members = 0;
    for (const std::vector<int>& sub_horizon : membership(model.neighbourhood.sub_horizons[centre]))
        members += std::accumulate(sub_horizon.begin(), sub_horizon.end() - 1, 0);
    CHECK(members == 6764);
    // what the differences are for: far fewer visits than members
    std::size_t pairs = 0;
    for (std::size_t b = 0; b < 122; ++b)
        pairs += model.neighbourhood.sub_horizons[centre].changes[b].pairs;
    CHECK(pairs < 2000);
}

TEST_CASE("families and sub-horizons of a random cloud are those of the definition")
{
    const std::vector<Vector3> x = jittered(lattice(6, 5, 7, dx), dx, 0.45);
    for (const double reach : {horizon, 6.0 * dx}) { // with the second most points have more than 254 bonds
        const Model model = model_of(x, reach);
        std::size_t largest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            std::set<std::uint32_t> expected;
            for (std::uint32_t j = 0; j < x.size(); ++j)
                if (j != i && joined(x, i, j, reach))
                    expected.insert(j);
            const FamilyView family = model.neighbourhood.families[i];
            largest = std::max(largest, family.count);
            REQUIRE(std::set<std::uint32_t>(family.neighbours, family.neighbours + family.count) == expected);
            const std::vector<std::vector<int>> counts = membership(model.neighbourhood.sub_horizons[i]);
            for (std::size_t k = 0; k < family.count; ++k)
                for (std::size_t b = 0; b < family.count; ++b) {
                    const bool inside = (x[family.neighbours[k]] - x[family.neighbours[b]]).norm() <= reach;
                    REQUIRE(counts[b][k] == (inside ? 1 : 0));
                }
        }
        CHECK((largest > 128) == (reach > horizon));
    }
}

TEST_CASE("every neighbour has an accumulator in the block, which contributes once to its point")
{
    Model model = from_positions(jittered(lattice(7, 6, 5, dx), dx, 0.2), dx);
    model.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0)});
    model.neighbourhood.find(model.state);
    const BlockAccumulators& blocks = model.neighbourhood.blocks;
    const Families& families = model.neighbourhood.families;
    REQUIRE(blocks.blocks() == 4);
    std::vector<std::uint32_t> point_of(blocks.size(), 0), isometry_of(blocks.size(), 0);
    std::vector<int> contributions(blocks.size(), 0);
    for (std::size_t i = 0; i < model.size(); ++i)
        for (const BlockAccumulators::Contribution part : blocks.contributions(i)) {
            point_of[part.accumulator] = static_cast<std::uint32_t>(i);
            isometry_of[part.accumulator] = part.isometry;
            ++contributions[part.accumulator];
        }
    CHECK(std::all_of(contributions.begin(), contributions.end(), [](int count) { return count == 1; }));
    for (std::size_t block = 0; block < blocks.blocks(); ++block)
        for (std::size_t i = blocks.first_point(block); i < blocks.end_point(block); ++i) {
            CHECK(point_of[blocks.first(block) + i - blocks.first_point(block)] == i);
            const FamilyView family = families[i];
            for (std::size_t b = 0; b < family.count; ++b) {
                const std::uint16_t* of_neighbours = blocks.of_neighbours(family.first_pack + b / pack_width);
                const std::size_t accumulator = blocks.first(block) + of_neighbours[b % pack_width];
                REQUIRE(point_of[accumulator] == families.parent(family.neighbours[b]));
                REQUIRE(isometry_of[accumulator] == families.isometry(family.neighbours[b]));
            }
        }
}

TEST_CASE("every bond has an opposite, from the neighbour to the point, images included")
{
    Model model = from_positions(jittered(lattice(5, 5, 5, dx), dx, 0.2), dx);
    model.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0), Isometry::reflection(1, 0.0)});
    const Families families =
        Families::find(model.state.points, model.neighbourhood.isometries, {horizon, link_length(dx, horizon)});
    std::size_t to_images = 0;
    for (std::size_t i = 0; i < families.points(); ++i) {
        const FamilyView family = families[i];
        for (std::size_t b = 0; b < family.count; ++b) {
            const std::uint32_t p = families.parent(family.neighbours[b]);
            const std::uint32_t g = families.isometry(family.neighbours[b]);
            to_images += g != 0 ? 1 : 0;
            const FamilyView other = families[p];
            const std::size_t back =
                families.opposite(static_cast<std::uint32_t>(i), family.neighbours[b], model.neighbourhood.isometries);
            REQUIRE(back < other.count);
            CHECK(families.parent(other.neighbours[back]) == i);
            CHECK(families.isometry(other.neighbours[back]) == model.neighbourhood.isometries.inverse(g));
        }
    }
    CHECK(to_images > 1000);
}

TEST_CASE("points of different bodies are never of one family")
{
    Model model = from_positions(lattice(4, 4, 4, dx), dx);
    model.state.bodies.push_back(model.state.bodies.front());
    for (std::size_t i = 0; i < model.size(); ++i)
        model.state.points.body[i] = model.state.points.position[i].z() > 2.0 * dx ? 1 : 0;
    const Families families =
        Families::find(model.state.points, model.neighbourhood.isometries, {horizon, link_length(dx, horizon)});
    for (std::size_t i = 0; i < families.points(); ++i)
        for (std::size_t b = 0; b < families[i].count; ++b)
            CHECK(model.state.points.body[families[i].neighbours[b]] == model.state.points.body[i]);
}

TEST_CASE("a lone point, a pair, a row and a sheet have finite evaluations and no active bond")
{
    // fewer than four points or points in a plane: K is singular, so no gradient exists
    for (const auto& positions :
         {lattice(1, 1, 1, dx), lattice(2, 1, 1, dx), lattice(9, 1, 1, dx), lattice(7, 6, 1, dx)})
        for_every_operator(horizon, [&](const std::string& state, const std::string& influence, ForceState& force) {
            CAPTURE(state);
            CAPTURE(influence);
            CAPTURE(positions.size());
            Model model = from_positions(positions, dx);
            find_first_families(model, force);
            set_velocity(model, [](const Vector3& x) { return Vector3(x.y() * 3.0, -x.x(), 7.0 * x.x()); });
            force.evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-4});
            for (std::size_t i = 0; i < model.size(); ++i) {
                CHECK(model.result.internal_force[i] == Vector3::Zero());
                CHECK(model.result.detached[i] == 1);
                CHECK(model.result.inactive_bonds[i] == model.neighbourhood.families[i].count);
            }
        });
}
