// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "sphere": exact containment, volume and inertia of its fill, distance from its surface.
#include "shape_checks.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <numbers>

namespace {

using namespace periporo;
using List = std::vector<double>;

std::unique_ptr<Geometry> sphere(double radius, const List& centre = {0.0, 0.0, 0.0})
{
    return test::geometry("sphere", {{"radius", radius}, {"centre", centre}});
}

} // namespace

TEST_CASE("the volume of a sphere is 4/3 pi r^3, and its bounds touch it")
{
    const auto geometry = sphere(0.5, {1.0, 2.0, 3.0});
    CHECK(geometry->volume() == doctest::Approx(std::numbers::pi / 6.0).epsilon(1e-15));
    CHECK(geometry->bounds().lower == Vector3(0.5, 1.5, 2.5));
    CHECK(geometry->bounds().upper == Vector3(1.5, 2.5, 3.5));
}

TEST_CASE("a sphere contains its surface and nothing one rounding step outside")
{
    // 2, 3, 6 and 4, 4, 7, ... are the edges of boxes with diagonals of 7 and 9.
    const auto check = [](double radius, const Vector3& place) {
        const auto geometry = sphere(radius, {16.0, -8.0, 4.0}); // the sums are exact
        const Vector3 centre(16.0, -8.0, 4.0);
        CHECK(geometry->contains(centre + place));
        for (int k = 0; k < 3; ++k) {
            Vector3 outside = centre + place;
            Vector3 inside = outside;
            outside[k] = place[k] > 0.0 ? test::just_above(outside[k]) : test::just_below(outside[k]);
            inside[k] = place[k] > 0.0 ? test::just_below(inside[k]) : test::just_above(inside[k]);
            CHECK_FALSE(geometry->contains(outside));
            CHECK(geometry->contains(inside));
        }
    };
    check(7.0, {2.0, 3.0, 6.0});
    check(7.0, {-6.0, 2.0, -3.0});
    check(9.0, {4.0, -7.0, 4.0});
    check(0.875, {0.25, 0.375, 0.75});
}

TEST_CASE("a point that is not finite lies in no sphere")
{
    CHECK_FALSE(sphere(1.0)->contains(Vector3(0.0, 0.0, std::numeric_limits<double>::quiet_NaN())));
    CHECK_FALSE(sphere(1.0)->contains(Vector3(-std::numeric_limits<double>::infinity(), 0.0, 0.0)));
}

TEST_CASE("a filled sphere has the exact volume, and its inertia up to the square of the spacing")
{
    const auto geometry = sphere(1.0, {0.3, -0.7, 2.9});
    for (const double cells : {4.0, 8.0, 16.0, 32.0}) {
        const PointCloud cloud = geometry->fill(1.0 / cells);
        const test::Moments found = test::moments(cloud);
        CAPTURE(cells);
        CHECK(found.volume == doctest::Approx(geometry->volume()).epsilon(1e-14).scale(0.0));
        // A corner of cells is in the centre, so that mirror images balance up to rounding at 3 m.
        CHECK((found.centre - Vector3(0.3, -0.7, 2.9)).norm() < 1e-14);
        // V r^2/5; what points lack of it, see lattice_fill_test
        CHECK((found.second / (geometry->volume() / 5.0) - Eigen::Matrix3d::Identity()).norm() < 1.5 / (cells * cells));
        for (const Vector3& position : cloud.positions)
            CHECK(geometry->contains(position));
    }
}

TEST_CASE("spheres of one radius are filled alike, wherever they are")
{
    const PointCloud here = sphere(0.125)->fill(0.03125);
    const PointCloud there = sphere(0.125, {0.015625, 3.5, -0.75})->fill(0.03125); // all sums are exact
    REQUIRE(here.positions.size() == there.positions.size());
    for (std::size_t p = 0; p < here.positions.size(); ++p) {
        CHECK(there.positions[p] == Vector3(here.positions[p] + Vector3(0.015625, 3.5, -0.75)));
        CHECK(there.volumes[p] == here.volumes[p]);
    }
}

TEST_CASE("a spacing too coarse for the radius is an error that says what would do")
{
    // The nearest centres lie sqrt(3)/2 spacings from the centre.
    CHECK(sphere(0.5)->fill(0.57).positions.size() == 8);
    test::check_mentions(test::message_of_error([] { sphere(0.5)->fill(0.58); }),
                         {"no lattice cell of spacing 0.58 m", "a spacing of 0.29 m would give some"});
}

TEST_CASE("the distance from a sphere is that from its centre less the radius")
{
    const auto geometry = sphere(2.0, {1.0, 1.0, 1.0});
    Vector3 normal;
    CHECK(geometry->signed_distance({3.0, 4.0, 7.0}, normal) == 5.0); // 2, 3, 6: 7 from the centre
    CHECK((normal - Vector3(2.0, 3.0, 6.0) / 7.0).norm() < 4e-16);
    CHECK(geometry->signed_distance({1.0, 0.5, 1.0}, normal) == -1.5);
    CHECK(normal == Vector3(0.0, -1.0, 0.0));
    CHECK(geometry->signed_distance({1.0, 1.0, 3.0}, normal) == 0.0);
    CHECK(normal == Vector3(0.0, 0.0, 1.0));
}

TEST_CASE("the normal of a sphere has the length 1 in its centre and the smallest step beside it")
{
    const double step = std::numeric_limits<double>::denorm_min();
    for (const Vector3& place : {Vector3(0.0, 0.0, 0.0), Vector3(step, 0.0, 0.0), Vector3(step, -step, 3 * step)}) {
        Vector3 normal;
        CHECK(sphere(1.0)->signed_distance(place, normal) == -1.0);
        CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-15));
    }
}

TEST_CASE("the distance from a sphere is that from the nearest place on it, and its gradient the normal")
{
    const auto geometry = sphere(0.6, {0.3, -0.7, 0.2});
    test::SurfaceSamples surface;
    const int steps = 300; // from pole to pole, and twice as many around
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const double polar = std::numbers::pi * i / steps;
            const double around = std::numbers::pi * j / steps;
            surface.places.push_back(Vector3(0.3, -0.7, 0.2) + 0.6 * Vector3(std::sin(polar) * std::cos(around),
                                                                             std::sin(polar) * std::sin(around),
                                                                             std::cos(polar)));
        }
    surface.reach = 0.6 * std::numbers::pi / steps; // half a step either way
    test::check_distance(*geometry, surface);
    test::check_gradient(*geometry);
}
