// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "cylinder": exact containment, tight bounds, a lattice symmetric about the axis, distance from its
// surface.
#include "shape_checks.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
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

/// Volumes by position.
std::map<std::tuple<double, double, double>, double> by_place(const PointCloud& cloud)
{
    std::map<std::tuple<double, double, double>, double> volumes;
    for (std::size_t p = 0; p < cloud.positions.size(); ++p)
        volumes[{cloud.positions[p].x(), cloud.positions[p].y(), cloud.positions[p].z()}] = cloud.volumes[p];
    return volumes;
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

TEST_CASE("a cylinder is filled with the cells whose centres lie inside, of spacing cubed each but at the side")
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
        CHECK(geometry->contains(cloud.positions[p]));
        // A cell with its centre this near to the axis is whole and has no neighbour that is cut. All are scaled by how
        // well 64 samples find the area of a circle: a cut cell is wrong by less than 1/8 of a cell, either way, and
        // some eighty of them by less than a hundredth of all 314 together.
        if ((cloud.positions[p] - Vector3(1.0, 2.0, cloud.positions[p].z())).norm() <
            0.1 - 2 * std::numbers::sqrt2 * 0.01)
            CHECK(cloud.volumes[p] == doctest::Approx(1e-6).epsilon(0.01).scale(0.0));
    }
}

TEST_CASE("the fill of an upright cylinder is its own mirror image to the last bit, with no point on the mirrors")
{
    const auto all = by_place(cylinder(0.1, 0.03)->fill(0.005));
    for (const auto& [place, volume] : all) {
        const auto& [x, y, z] = place;
        for (const auto& image : {std::tuple(-x, y, z), std::tuple(x, -y, z), std::tuple(y, x, z)}) {
            REQUIRE(all.count(image) == 1);
            CHECK(all.at(image) == volume);
        }
        CHECK(std::min(std::abs(x), std::abs(y)) >= 0.0025 * (1.0 - 1e-15));
    }
}

TEST_CASE("a filled cylinder has the exact volume, and its inertia up to the square of the spacing")
{
    const Vector3 axis = Vector3(1.0, 2.0, -3.0).normalized();
    const auto geometry = cylinder(1.0, 1.5, {5.0, -3.0, 1.0}, {1.0, 2.0, -3.0});
    for (const double cells : {4.0, 8.0, 16.0, 32.0}) {
        const test::Moments found = test::moments(geometry->fill(1.0 / cells));
        CAPTURE(cells);
        CHECK(found.volume == doctest::Approx(geometry->volume()).epsilon(1e-14).scale(0.0));
        CHECK((found.centre - (Vector3(5.0, -3.0, 1.0) + 0.75 * axis)).norm() < 1e-14);
        // Along the axis layers of width h, all alike: V (H^2 - h^2)/12.
        const double along = axis.dot(found.second * axis);
        const double layered = geometry->volume() * (2.25 - 1.0 / (cells * cells)) / 12.0;
        CHECK(along == doctest::Approx(layered).epsilon(1e-13).scale(0.0)); // thousands of roundings, either way
        // Across it V r^2/4. A point lacks h^2/12, which is (h/r)^2/3, and cells at the side are shifted by less than
        // h, some inwards and some outwards, within a layer of thickness h: as much again.
        const double across = 0.5 * (found.second.trace() - along);
        CHECK(std::abs(across / (geometry->volume() / 4.0) - 1.0) < 1.0 / (cells * cells));
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
    test::check_mentions(
        test::message_of_error([] { cylinder(0.5, 1.0)->fill(1.0); }),
        {"no lattice cell of spacing 1 m has its centre inside", "a spacing of 0.5 m would give some"});
}

TEST_CASE("an axis of no length is an error that names the parameter")
{
    test::check_mentions(test::message_of_error([] {
                             cylinder(1.0, 1.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
                         }),
                         {"geometry plugin \"cylinder\"", "axis must not be zero"});
}

TEST_CASE("the distance from a cylinder is that from its side, an end or a rim")
{
    const auto geometry = cylinder(2.0, 5.0, {1.0, 1.0, 1.0}); // 3 m wide about x = y = 1, from z = 1 to 6
    const auto check = [&](const Vector3& place, double distance, const Vector3& expected) {
        Vector3 normal;
        CAPTURE(place.transpose());
        CHECK(geometry->signed_distance(place, normal) == doctest::Approx(distance).epsilon(1e-15));
        CHECK((normal - expected).norm() < 4e-16); // a rounding or two
    };
    check({4.0, 5.0, 3.0}, 3.0, {0.6, 0.8, 0.0});     // 5 from the axis
    check({1.5, 1.0, 9.0}, 3.0, {0.0, 0.0, 1.0});     // above the top
    check({6.0, 1.0, 10.0}, 5.0, {0.6, 0.0, 0.8});    // 3 beside and 4 above the upper rim
    check({1.0, -4.0, -3.0}, 5.0, {0.0, -0.6, -0.8}); // 3 beside and 4 below the lower rim
    check({1.0, 2.5, 3.0}, -0.5, {0.0, 1.0, 0.0});
    check({1.0, 1.5, 1.25}, -0.25, {0.0, 0.0, -1.0});
    check({3.0, 1.0, 3.0}, 0.0, {1.0, 0.0, 0.0});
}

TEST_CASE("the normal of a cylinder has the length 1 on its axis, on rims and the smallest step from the axis")
{
    const double step = std::numeric_limits<double>::denorm_min();
    for (const auto& geometry : {cylinder(1.0, 9.0), cylinder(1.0, 9.0, {0.0, 0.0, 0.0}, {1.0, 2.0, -3.0})})
        for (const Vector3& place : {Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 4.0), Vector3(1.0, 0.0, 0.0),
                                     Vector3(1.0, 0.0, 9.0), Vector3(step, step, 4.0), Vector3(0.0, 0.0, 12.0)}) {
            Vector3 normal;
            CHECK(std::abs(geometry->signed_distance(place, normal)) <= 12.0);
            CAPTURE(place.transpose());
            CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-15));
        }
}

TEST_CASE("the distance from an oblique cylinder is that from the nearest place on it, and its gradient the normal")
{
    // (1, 2, 2)/3, (2, 1, -2)/3 and (2, -2, 1)/3 are at right angles and of length 1.
    const Vector3 origin(0.3, -0.2, 0.1);
    const Vector3 axis = Vector3(1.0, 2.0, 2.0) / 3.0;
    const Vector3 u = Vector3(2.0, 1.0, -2.0) / 3.0;
    const Vector3 v = Vector3(2.0, -2.0, 1.0) / 3.0;
    const double radius = 0.4;
    const double height = 1.1;
    test::SurfaceSamples surface;
    const int around = 400;
    const int along = 200;
    for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around;
        const Vector3 spoke = radius * (std::cos(angle) * u + std::sin(angle) * v);
        for (int j = 0; j <= along; ++j) {
            const double part = static_cast<double>(j) / along;
            surface.places.push_back(origin + part * height * axis + spoke);
            surface.places.push_back(origin + part * spoke);
            surface.places.push_back(origin + height * axis + part * spoke);
        }
    }
    // half a step around the rim and half a step along, at most
    surface.reach = radius * std::numbers::pi / around + height / along / 2;
    const auto geometry = cylinder(radius, height, {0.3, -0.2, 0.1}, {1.0, 2.0, 2.0});
    test::check_distance(*geometry, surface);
    test::check_gradient(*geometry);
}
