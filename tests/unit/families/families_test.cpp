// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families and sub-horizons against their definition, by looking at all pairs.
#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <set>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double horizon = 3.015 * dx;

Families families_of(const std::vector<Vector3>& positions)
{
    Model model = from_positions(positions, dx);
    return Families::find(model.points, model.isometries, horizon);
}

} // namespace

TEST_CASE("a bulk point of a lattice at delta = 3.015 dx has 122 bonds whose sub-horizons hold 6764 members")
{
    // counted by hand: integer vectors with 0 < n.n <= 9, and for each the ones within distance 3.015 of it
    const Families families = families_of(lattice(9, 9, 9, dx));
    const FamilyView centre = families[(4 * 9 + 4) * 9 + 4];
    CHECK(centre.count == 122);
    std::size_t members = 0;
    for (std::size_t k = 0; k < centre.count; ++k)
        for (std::size_t p = 0; p < centre.packs; ++p)
            members += static_cast<std::size_t>(std::popcount(centre.membership[k * centre.packs + p]));
    CHECK(members == 6764);
}

TEST_CASE("families and sub-horizons of a random cloud are those of the definition")
{
    const std::vector<Vector3> x = jittered(lattice(6, 5, 7, dx), dx, 0.45);
    const Families families = families_of(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        std::set<std::uint32_t> expected;
        for (std::uint32_t j = 0; j < x.size(); ++j)
            if (j != i && (x[j] - x[i]).norm() <= horizon)
                expected.insert(j);
        const FamilyView family = families[i];
        REQUIRE(std::set<std::uint32_t>(family.neighbours, family.neighbours + family.count) == expected);
        for (std::size_t k = 0; k < family.count; ++k)
            for (std::size_t b = 0; b < family.count; ++b) {
                const bool inside = (x[family.neighbours[k]] - x[family.neighbours[b]]).norm() <= horizon;
                const bool member = (family.membership[k * family.packs + b / pack_width] >> b % pack_width & 1u) != 0;
                REQUIRE(member == inside);
            }
    }
}

TEST_CASE("the reverse of a bond is the bond of the neighbour to the point, images included")
{
    Model model = from_positions(jittered(lattice(5, 5, 5, dx), dx, 0.2), dx);
    model.isometries.set_generators({Isometry::reflection(0, 0.0), Isometry::reflection(1, 0.0)});
    const Families families = Families::find(model.points, model.isometries, horizon);
    std::size_t to_images = 0;
    for (std::size_t i = 0; i < families.points(); ++i) {
        const FamilyView family = families[i];
        for (std::size_t b = 0; b < family.count; ++b) {
            const std::uint32_t p = families.parent(family.neighbours[b]);
            const std::uint32_t g = families.isometry(family.neighbours[b]);
            to_images += g != 0 ? 1 : 0;
            const FamilyView other = families[p];
            const std::size_t back = family.reverse[b] - other.first_pack * pack_width;
            REQUIRE(back < other.count);
            CHECK(families.parent(other.neighbours[back]) == i);
            CHECK(families.isometry(other.neighbours[back]) == model.isometries.inverse(g));
        }
    }
    CHECK(to_images > 1000);
}

TEST_CASE("points of different bodies are never of one family")
{
    Model model = from_positions(lattice(4, 4, 4, dx), dx);
    model.bodies.push_back(model.bodies.front());
    for (std::size_t i = 0; i < model.size(); ++i)
        model.points.body[i] = model.points.position[i].z() > 2.0 * dx ? 1 : 0;
    const Families families = Families::find(model.points, model.isometries, horizon);
    for (std::size_t i = 0; i < families.points(); ++i)
        for (std::size_t b = 0; b < families[i].count; ++b)
            CHECK(model.points.body[families[i].neighbours[b]] == model.points.body[i]);
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
            find_first_families(model);
            set_velocity(model, [](const Vector3& x) { return Vector3(x.y() * 3.0, -x.x(), 7.0 * x.x()); });
            force.evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-4});
            for (std::size_t i = 0; i < model.size(); ++i) {
                CHECK(model.internal_force[i] == Vector3::Zero());
                CHECK(model.free_grain[i] == 1);
                CHECK(model.inactive_bonds[i] == model.families[i].count);
            }
        });
}
