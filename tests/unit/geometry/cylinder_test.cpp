// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "cylinder": exact containment, tight bounds, a lattice symmetric about the axis.
#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

namespace {

using namespace periporo;
using List = std::vector<double>;

std::unique_ptr<Geometry> cylinder(double radius, double height, const List& origin = {0.0, 0.0, 0.0},
                                   const List& axis = {0.0, 0.0, 1.0})
{
    return test::geometry("cylinder", {{"radius", radius}, {"height", height}, {"origin", origin}, {"axis", axis}});
}

/// The next double away from zero.
double outward(double value)
{
    return std::nextafter(value, std::copysign(std::numeric_limits<double>::infinity(), value));
}

using Key = std::tuple<double, double, double>;

std::set<Key> keys(const PointCloud& cloud)
{
    std::set<Key> result;
    for (const Vector3& p : cloud.positions)
        result.emplace(p.x(), p.y(), p.z());
    return result;
}

} // namespace

TEST_CASE("the volume of a cylinder is pi r^2 h along any axis")
{
    const double exact = std::numbers::pi * 0.25 * 3.0;
    CHECK(cylinder(0.5, 3.0)->volume() == doctest::Approx(exact).epsilon(1e-15));
    CHECK(cylinder(0.5, 3.0, {1.0, 2.0, 3.0}, {1.0, 1.0, 7.0})->volume() == doctest::Approx(exact).epsilon(1e-15));
}

TEST_CASE("a cylinder contains its side, ends and rims and nothing one rounding step outside")
{
    // (3, 4), (4, 3) and (5, 0) lie on a circle of radius 5.
    const auto geometry = cylinder(5.0, 2.0);
    for (const auto& [x, y] : {std::pair{3.0, 4.0}, {-4.0, 3.0}, {5.0, 0.0}, {0.0, -5.0}}) {
        for (const double z : {0.0, 0.5, 2.0})
            CHECK(geometry->contains(Vector3(x, y, z)));
        CHECK_FALSE(geometry->contains(Vector3(x, y, outward(2.0))));
        CHECK_FALSE(geometry->contains(Vector3(x, y, -std::numeric_limits<double>::denorm_min())));
    }
    CHECK_FALSE(geometry->contains(Vector3(outward(3.0), 4.0, 1.0)));
    CHECK_FALSE(geometry->contains(Vector3(-4.0, outward(3.0), 1.0)));
    CHECK_FALSE(geometry->contains(Vector3(outward(5.0), 0.0, 1.0)));
    CHECK(geometry->contains(Vector3(0.0, 0.0, 0.0)));
    CHECK(geometry->contains(Vector3(0.0, 0.0, 2.0)));
}

TEST_CASE("an oblique cylinder is decided exactly, although its unit axis cannot be written in doubles")
{
    // a = (1, 2, 2) has the length 3; u = (2, 1, -2) and v = (2, -2, 1) are at right angles to it and as long.
    const Vector3 origin(8.0, -16.0, 4.0);
    const Vector3 a(1.0, 2.0, 2.0);
    const Vector3 u(2.0, 1.0, -2.0);
    const Vector3 v(2.0, -2.0, 1.0);
    const auto geometry = cylinder(3.0, 3.0, {8.0, -16.0, 4.0}, {1.0, 2.0, 2.0});
    for (const Vector3& side : {u, v, Vector3(-u), Vector3(-v)})
        for (const double t : {0.0, 0.5, 1.0})
            CHECK(geometry->contains(origin + t * a + side));
    const double step = std::numeric_limits<double>::epsilon() * 16; // one rounding step at 16
    CHECK_FALSE(geometry->contains(origin + 0.5 * a + u + step * u));
    CHECK(geometry->contains(origin + 0.5 * a + u - step * u));
    CHECK_FALSE(geometry->contains(origin + a + 0.5 * v + step * a));
    CHECK(geometry->contains(origin + a + 0.5 * v - step * a));
    CHECK_FALSE(geometry->contains(origin + 0.5 * v - step * a));
}

TEST_CASE("a point that is not finite lies in no cylinder")
{
    CHECK_FALSE(cylinder(1.0, 1.0)->contains(Vector3(0.0, 0.0, std::numeric_limits<double>::quiet_NaN())));
    CHECK_FALSE(cylinder(1.0, 1.0)->contains(Vector3(-std::numeric_limits<double>::infinity(), 0.0, 0.0)));
}

TEST_CASE("the bounds of an upright and of a hanging cylinder are exact")
{
    const Bounds upright = cylinder(0.5, 2.0, {1.0, 2.0, 3.0})->bounds();
    CHECK(upright.lower == Vector3(0.5, 1.5, 3.0));
    CHECK(upright.upper == Vector3(1.5, 2.5, 5.0));
    const Bounds hanging = cylinder(0.5, 2.0, {1.0, 2.0, 3.0}, {0.0, 0.0, -1.0})->bounds();
    CHECK(hanging.lower == Vector3(0.5, 1.5, 1.0));
    CHECK(hanging.upper == Vector3(1.5, 2.5, 3.0));
}

TEST_CASE("the bounds of a tilted cylinder touch its rims")
{
    // Axis at 45 degrees in the xy plane: along x the rims reach r cos 45 beyond the ends of the axis, along z r.
    const double reach = std::numbers::sqrt2 / 2;
    const Bounds bounds = cylinder(1.0, std::numbers::sqrt2, {0.0, 0.0, 0.0}, {1.0, 1.0, 0.0})->bounds();
    const double tolerance = 2e-15; // a few roundings of numbers of order one
    CHECK((bounds.lower - Vector3(-reach, -reach, -1.0)).norm() < tolerance);
    CHECK((bounds.upper - Vector3(1.0 + reach, 1.0 + reach, 1.0)).norm() < tolerance);
}

TEST_CASE("a cylinder is filled with the cells whose centres lie inside, of spacing cubed each")
{
    // Centres at odd multiples of half a spacing, radius of ten spacings: (2i+1)^2 + (2j+1)^2 < 20^2 in whole numbers.
    std::size_t in_a_layer = 0;
    for (int i = -10; i < 10; ++i)
        for (int j = -10; j < 10; ++j)
            in_a_layer += (2 * i + 1) * (2 * i + 1) + (2 * j + 1) * (2 * j + 1) < 400 ? 1 : 0;
    const auto geometry = cylinder(0.1, 0.05, {1.0, 2.0, 3.0});
    const PointCloud cloud = geometry->fill(0.01);
    CHECK(cloud.positions.size() == 5 * in_a_layer);
    REQUIRE(cloud.volumes.size() == cloud.positions.size());
    for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
        CHECK(cloud.volumes[p] == doctest::Approx(1e-6).epsilon(1e-14).scale(0.0));
        CHECK(geometry->contains(cloud.positions[p]));
    }
}

TEST_CASE("the lattice of an upright cylinder is its own mirror image to the last bit, with no point on the mirrors")
{
    const PointCloud cloud = cylinder(0.1, 0.03)->fill(0.005);
    const std::set<Key> all = keys(cloud);
    REQUIRE(all.size() == cloud.positions.size());
    for (const auto& [x, y, z] : all) {
        CHECK(all.contains({-x, y, z}));
        CHECK(all.contains({x, -y, z}));
        CHECK(all.contains({y, x, z}));
        CHECK(std::min(std::abs(x), std::abs(y)) >= 0.0025 * (1.0 - 1e-15));
    }
}

TEST_CASE("the volume of the cells tends to the volume of the cylinder")
{
    // A cell that the circle cuts lies within sqrt(2)/2 spacings of it, so the difference is at most the ring of that
    // half-width: 2 pi r sqrt(2)/2 2 h dx = 2 sqrt(2) dx/r of the volume.
    for (const double cells : {10.0, 40.0}) {
        const double spacing = 1.0 / cells;
        const auto geometry = cylinder(1.0, 1.0);
        double sum = 0.0;
        for (const double volume : geometry->fill(spacing).volumes)
            sum += volume;
        CHECK(std::abs(sum / geometry->volume() - 1.0) < 2 * std::numbers::sqrt2 / cells);
    }
}

TEST_CASE("an oblique cylinder contains all points that fill it, as many as when it stands upright")
{
    const auto geometry = cylinder(0.1, 0.2, {5.0, -3.0, 1.0}, {1.0, 2.0, -3.0});
    const PointCloud cloud = geometry->fill(0.02);
    CHECK(cloud.positions.size() == cylinder(0.1, 0.2)->fill(0.02).positions.size());
    for (const Vector3& position : cloud.positions)
        CHECK(geometry->contains(position));
}

TEST_CASE("a height that holds no whole number of cells is an error with the heights and the spacing that fit")
{
    const auto geometry = cylinder(0.1, 0.105);
    // 11 cells of 9.545 mm are nearer to 10 mm than 10 cells of 10.5 mm.
    test::check_mentions(test::message_of_error([&] { geometry->fill(0.01); }),
                         {"cylinder", "height = 0.105 m", "0.1 m or 0.11 m would fit", "spacing of 0.009545454545 m"});
}

TEST_CASE("a spacing too coarse for the radius is an error that says what would do")
{
    // The nearest centres lie dx/sqrt(2) from the axis.
    test::check_mentions(test::message_of_error([] { cylinder(0.5, 1.0)->fill(1.0); }),
                         {"centre within the radius", "0.7071067812 m"});
}

TEST_CASE("an axis of no length is an error that names the parameter")
{
    test::check_mentions(test::message_of_error([] {
                             cylinder(1.0, 1.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
                         }),
                         {"geometry plugin \"cylinder\"", "axis must not be zero"});
}
