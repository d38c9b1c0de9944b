// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families do not reach across gaps: who is linked, what comes apart, and what closes.
#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double horizon = 3.015 * dx;

/// Two blocks of 4 x 4 x 3 points, one above the other. Neighbouring rows across the gap lie `apart` away [spacings].
std::vector<Vector3> two_blocks(double apart)
{
    std::vector<Vector3> x = lattice(4, 4, 3, dx);
    const std::size_t lower = x.size();
    for (std::size_t i = 0; i < lower; ++i)
        x.push_back(x[i] + Vector3(0.0, 0.0, (2.0 + apart) * dx));
    return x;
}

Model blocks(double apart)
{
    Model model = from_positions(two_blocks(apart), dx);
    model.state.bodies.front().joining_distance = 0.0; // a contact law holds the blocks apart
    return model;
}

void move_apart(Model& model, double apart)
{
    model.state.points.position = two_blocks(apart);
}

bool is_upper(const Model& model, std::size_t point)
{
    return point >= model.size() / 2;
}

std::size_t bonds_across(const Model& model)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b)
            count +=
                is_upper(model, i) !=
                is_upper(model, model.neighbourhood.families.parent(model.neighbourhood.families[i].neighbours[b]));
    return count;
}

void find_again(Model& model, const std::vector<ClosedPair>& closed = {})
{
    model.neighbourhood.renew(model.state, closed);
}

} // namespace

TEST_CASE("every neighbour in an intact lattice is of the family, at every horizon")
{
    for (const double ratio : {1.515, 2.015, 2.5, 3.015, 3.5, 4.015, 5.015, 6.015}) {
        CAPTURE(ratio);
        Model model = from_positions(lattice(9, 8, 7, dx), dx, ratio);
        model.neighbourhood.find(model.state);
        for (std::size_t i = 0; i < model.size(); ++i)
            CHECK(model.neighbourhood.families.apart(i).empty());
    }
}

TEST_CASE("at the start pieces farther apart than a link are two, whatever the horizon sees")
{
    Model one = blocks(1.7);
    one.neighbourhood.find(one.state);
    CHECK(bonds_across(one) > 0);
    Model two = blocks(1.9); // a link is 1.8 spacings long
    two.neighbourhood.find(two.state);
    CHECK(bonds_across(two) == 0);
    std::size_t apart = 0;
    for (std::size_t i = 0; i < two.size(); ++i) {
        apart += two.neighbourhood.families.apart(i).size();
        for (const std::uint32_t c : two.neighbourhood.families.apart(i))
            CHECK((two.state.points.position[c] - two.state.points.position[i]).norm() <= horizon);
    }
    CHECK(apart > 0);
}

TEST_CASE("pieces that approach stay two until a pair has closed, and then become one where they touch")
{
    Model model = blocks(2.0);
    model.neighbourhood.find(model.state);
    move_apart(model, 0.7);
    find_again(model);
    CHECK(bonds_across(model) == 0);
    const std::uint32_t below = 2 * 16 + 5, above = 3 * 16 + 5; // inner points of the faces, one above the other
    REQUIRE((model.state.points.position[above] - model.state.points.position[below]).norm() ==
            doctest::Approx(0.7 * dx));
    find_again(model, {{below, above}, {above, below}});
    CHECK(model.neighbourhood.families.holds(below, above));
    CHECK(model.neighbourhood.families.holds(above, below));
    // with one more link on either side
    CHECK(model.neighbourhood.families.holds(below - 1, above + 1));
    // and now all pairs nearer than a link are of one piece
    find_again(model);
    CHECK(bonds_across(model) > 0);
}

TEST_CASE("pieces come apart at the length of a link, and what is apart does not push at a distance again")
{
    Model model = blocks(1.0);
    model.neighbourhood.find(model.state);
    move_apart(model, 1.75);
    find_again(model);
    CHECK(bonds_across(model) > 0);
    move_apart(model, 1.85);
    find_again(model);
    CHECK(bonds_across(model) == 0);
    move_apart(model, 0.9);
    find_again(model);
    CHECK(bonds_across(model) == 0);
}

TEST_CASE("pieces of a body without a contact law of its own join within one spacing")
{
    Model model = blocks(1.9);
    model.state.bodies.front().joining_distance = 1.0;
    model.neighbourhood.find(model.state);
    move_apart(model, 1.05);
    find_again(model);
    CHECK(bonds_across(model) == 0);
    move_apart(model, 0.95);
    find_again(model);
    CHECK(bonds_across(model) > 0);
}

TEST_CASE("families of a quarter between symmetry planes are those of the whole, gaps included")
{
    // two blocks of 6 x 6 points whose centre line is the z axis, and a crack between them
    const auto whole_positions = [] {
        std::vector<Vector3> x = jittered(lattice(3, 3, 3, dx), dx, 0.1);
        const std::size_t lower = x.size();
        for (std::size_t i = 0; i < lower; ++i)
            x.push_back(x[i] + Vector3(0.0, 0.0, 4.2 * dx));
        return x;
    }();
    Model quarter = from_positions(whole_positions, dx);
    quarter.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0), Isometry::reflection(1, 0.0)});
    std::vector<Vector3> all = whole_positions;
    for (const auto& [sx, sy] : {std::pair{-1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}})
        for (const Vector3& x : whole_positions)
            all.push_back({sx * x.x(), sy * x.y(), x.z()});
    Model whole = from_positions(all, dx);
    quarter.neighbourhood.find(quarter.state);
    whole.neighbourhood.find(whole.state);
    std::size_t apart = 0;
    for (std::size_t i = 0; i < quarter.size(); ++i) {
        CHECK(quarter.neighbourhood.families[i].count == whole.neighbourhood.families[i].count);
        CHECK(quarter.neighbourhood.families.apart(i).size() == whole.neighbourhood.families.apart(i).size());
        apart += quarter.neighbourhood.families.apart(i).size();
    }
    CHECK(apart > 0);
}

TEST_CASE("a symmetry plane that a stage adds bonds the body to its image at once")
{
    Model model = from_positions(lattice(5, 5, 5, dx), dx);
    model.neighbourhood.find(model.state);
    model.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0)});
    find_again(model);
    for (std::size_t i = 0; i < model.size(); ++i)
        CHECK(model.neighbourhood.families.apart(i).empty());
    CHECK(model.neighbourhood.families.images().size() == 75); // three layers
}

TEST_CASE("families that were kept are restored as they were, although positions alone would give others")
{
    Model model = blocks(2.0);
    model.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0)});
    model.neighbourhood.find(model.state);
    move_apart(model, 0.9);
    find_again(model);
    const Families::Kept kept = model.neighbourhood.families.kept();
    Model again = blocks(0.9);
    again.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0)});
    again.neighbourhood.restore(again.state, kept);
    CHECK(bonds_across(again) == 0);
    for (std::size_t i = 0; i < model.size(); ++i) {
        REQUIRE(again.neighbourhood.families[i].count == model.neighbourhood.families[i].count);
        CHECK(std::equal(again.neighbourhood.families[i].neighbours,
                         again.neighbourhood.families[i].neighbours + again.neighbourhood.families[i].count,
                         model.neighbourhood.families[i].neighbours));
        CHECK(std::ranges::equal(again.neighbourhood.families.apart(i), model.neighbourhood.families.apart(i)));
    }
    Families::Kept damaged = kept;
    damaged.family_neighbours.front() = 1u << 30;
    CHECK_THROWS(again.neighbourhood.restore(again.state, damaged));
}
