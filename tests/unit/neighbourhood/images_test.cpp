// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Isometries and the images they make.
#include "neighbourhood/images.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace periporo;

TEST_CASE("two perpendicular symmetry planes make three images of a point at their corner")
{
    IsometryTable table;
    table.set_generators({Isometry::reflection(0, 0.0), Isometry::reflection(1, 0.0)});
    const std::vector<Vector3> points{{0.1, 0.2, 0.3}};
    const std::vector<Image> images = find_images(points, table, 0.5);
    REQUIRE(images.size() == 3);
    Vector3 sum = points[0];
    for (const Image& image : images)
        sum += table[image.isometry].point(points[0]);
    CHECK((sum - Vector3(0.0, 0.0, 1.2)).norm() < 1e-15); // x and y cancel among the four
}

TEST_CASE("a periodic slab of one spacing is surrounded by images as far as the reach")
{
    IsometryTable table;
    table.set_generators({Isometry::shift(1, 0.1)});
    const std::vector<Vector3> points{{0.0, 0.05, 0.0}};
    CHECK(find_images(points, table, 0.3015).size() == 6); // three on each side
}

TEST_CASE("a number of an isometry keeps its meaning when planes come and go")
{
    IsometryTable table;
    const std::vector<Vector3> points{{0.01, 0.01, 0.0}, {0.99, 0.5, 0.0}};
    table.set_generators({Isometry::reflection(0, 0.0)});
    const std::vector<Image> before = find_images(points, table, 0.05);
    REQUIRE(before.size() == 1);
    table.set_generators({Isometry::reflection(0, 1.0), Isometry::reflection(0, 0.0)});
    const std::vector<Image> after = find_images(points, table, 0.05);
    const auto is_the_one_before = [&](const Image& image) {
        return image.parent == before[0].parent && image.isometry == before[0].isometry;
    };
    CHECK(std::ranges::count_if(after, is_the_one_before) == 1);
    // the plane that is new comes first among the generators, but its number is the larger one
    REQUIRE(after.size() == 2);
    CHECK(after[0].isometry < after[1].isometry);
}

TEST_CASE("an isometry followed by its inverse is the identity")
{
    IsometryTable table;
    table.set_generators({Isometry::reflection(2, 0.7), Isometry::shift(0, 0.3)});
    const Vector3 lower(0.0, 0.0, 0.6), upper(0.3, 0.1, 0.7);
    const Vector3 x(0.11, 0.05, 0.63);
    const std::vector<std::uint32_t> active = table.active(lower, upper, 0.4);
    CHECK(active.size() >= 5);
    for (const std::uint32_t number : active)
        CHECK((table[table.inverse(number)].point(table[number].point(x)) - x).norm() < 1e-15);
}

TEST_CASE("planes at an odd angle are refused with a reason")
{
    IsometryTable table;
    Isometry tilted;
    const Vector3 normal = Vector3(1.0, 0.1234567, 0.0).normalized();
    tilted.rotation -= 2.0 * normal * normal.transpose();
    table.set_generators({Isometry::reflection(0, 0.0), tilted});
    CHECK_THROWS_WITH_AS(table.active(Vector3::Zero(), Vector3::Ones(), 10.0),
                         doctest::Contains("neither parallel nor perpendicular"), std::runtime_error);
}
