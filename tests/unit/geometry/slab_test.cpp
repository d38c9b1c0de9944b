// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "slab": where it lies below its top face, exact containment when tilted, whole cells, distance.
#include "shape_checks.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using namespace periporo;
using List = std::vector<double>;

std::unique_ptr<Geometry> slab(const List& size, double thickness, const List& top = {0.0, 0.0, 0.0},
                               const List& normal = {0.0, 0.0, 1.0})
{
    return test::geometry("slab", {{"size", size}, {"thickness", thickness}, {"top", top}, {"normal", normal}});
}

} // namespace

TEST_CASE("a slab lies below its top face, whose centre is given")
{
    const auto geometry = slab({4.0, 2.0}, 0.5, {1.0, -3.0, 0.25});
    test::check_closed_region(*geometry, {-1.0, -4.0, -0.25}, {3.0, -2.0, 0.25});
    CHECK(geometry->bounds().lower == Vector3(-1.0, -4.0, -0.25));
    CHECK(geometry->bounds().upper == Vector3(3.0, -2.0, 0.25));
    CHECK(geometry->volume() == 4.0);
}

TEST_CASE("a slab whose normal is along a coordinate axis has exactly axis-parallel faces")
{
    // The shortest turn of z into x takes x to -z and leaves y; that into -y takes y to z and leaves x.
    test::check_closed_region(*slab({4.0, 2.0}, 0.5, {1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}), {0.5, -1.0, -2.0},
                              {1.0, 1.0, 2.0});
    test::check_closed_region(*slab({4.0, 2.0}, 0.5, {0.0, 1.0, 0.0}, {0.0, -1e-3, 0.0}), {-2.0, 1.0, -1.0},
                              {2.0, 1.5, 1.0});
    // Into -z there are many; about x it is.
    test::check_closed_region(*slab({4.0, 2.0}, 0.5, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {-2.0, -1.0, 1.0},
                              {2.0, 1.0, 1.5});
}

TEST_CASE("a tilted slab is decided exactly, although its unit normal cannot be written in doubles")
{
    // The turn of z into (1, 2, 2)/3 is that of the quaternion (5, -2, 1, 0) of squared length 30, which takes x to
    // (14, -2, -5)/15, y to (-2, 11, -10)/15 and z to (5, 10, 10)/15. All sums below are exact.
    const Vector3 u(14.0, -2.0, -5.0);
    const Vector3 v(-2.0, 11.0, -10.0);
    const Vector3 n(5.0, 10.0, 10.0);
    const Vector3 top(64.0, -32.0, 16.0);
    for (const double length : {1.0, 0.125, 256.0}) { // of the normal
        const auto geometry = slab({60.0, 30.0}, 45.0, {64.0, -32.0, 16.0}, {length, 2 * length, 2 * length});
        for (const double x : {-2.0, 0.0, 2.0})
            for (const double y : {-1.0, 0.0, 1.0})
                for (const double z : {-3.0, -1.0, 0.0})
                    CHECK(geometry->contains(top + x * u + y * v + z * n));
        const double step = std::ldexp(1.0, -46); // one rounding step between 64 and 128
        for (const double side : {-1.0, 1.0}) {
            const Vector3 faces[] = {top + 2.0 * side * u - n, top + side * v - n, top + (1.5 * side - 1.5) * n};
            const Vector3 out[] = {side * u, side * v, side * n};
            for (int k = 0; k < 3; ++k) {
                CHECK(geometry->contains(faces[k]));
                CHECK_FALSE(geometry->contains(faces[k] + step * out[k]));
                CHECK(geometry->contains(faces[k] - step * out[k]));
            }
        }
    }
}

TEST_CASE("a normal a hair off -z tilts the slab by a hair")
{
    const double hair = 1e-9;
    const auto geometry = slab({4.0, 2.0}, 0.5, {0.0, 0.0, 0.0}, {hair, 0.0, -1.0});
    // The half turn about y takes x to -x; the top face rises with x by the hair.
    CHECK(geometry->contains(Vector3(1.0, 0.5, 1.01 * hair)));
    CHECK_FALSE(geometry->contains(Vector3(1.0, 0.5, 0.99 * hair)));
    CHECK(geometry->contains(Vector3(-1.0, 0.5, -0.99 * hair)));
    CHECK_FALSE(geometry->contains(Vector3(-1.0, 0.5, -1.01 * hair)));
}

TEST_CASE("a tilted slab is filled with whole cells, and its second moments are those of the slab less those of a cell")
{
    const Vector3 top(0.3, -0.1, 2.0);
    const Vector3 normal = Vector3(-1.0, 0.0, 3.0).normalized();
    const Vector3 x(normal.z(), 0.0, -normal.x()); // the turn is about y
    const auto geometry = slab({0.6, 0.4}, 0.2, {0.3, -0.1, 2.0}, {-1.0, 0.0, 3.0});
    const PointCloud cloud = geometry->fill(0.05);
    CHECK(cloud.positions.size() == 12 * 8 * 4);
    for (const Vector3& position : cloud.positions)
        CHECK(geometry->contains(position));
    const test::Moments found = test::moments(cloud);
    CHECK(found.volume == doctest::Approx(0.048).epsilon(1e-14).scale(0.0));
    CHECK((found.centre - (top - 0.1 * normal)).norm() < 1e-14);
    // n cells of width h along an edge L: V (L^2 - h^2)/12.
    const auto along = [](double length) { return 0.048 * (length * length - 0.05 * 0.05) / 12.0; };
    const Eigen::Matrix3d exact = along(0.6) * x * x.transpose() +
                                  along(0.4) * Vector3::UnitY() * Vector3::UnitY().transpose() +
                                  along(0.2) * normal * normal.transpose();
    CHECK((found.second - exact).norm() < 1e-13 * exact.norm());
}

TEST_CASE("a thickness that holds no whole number of cells is an error with those that fit")
{
    test::check_mentions(test::message_of_error([] {
                             slab({0.4, 0.2}, 0.05)->fill(0.04);
                         }),
                         {"slab", "thickness = 0.05 m is 1.25 cells", "0.04 m or 0.08 m would fit", "0.05 m"});
}

TEST_CASE("the distance above the top face of a slab is the height above it")
{
    const auto geometry = slab({40.0, 20.0}, 5.0, {1.0, 2.0, 3.0}, {1.0, 2.0, 2.0});
    const Vector3 n = Vector3(1.0, 2.0, 2.0) / 3.0;
    for (const double height : {-1.0, 0.0, 1e-3, 2.0}) {
        Vector3 normal;
        const Vector3 place = Vector3(1.0, 2.0, 3.0) + height * n + Vector3(2.0, -2.0, 1.0);
        CHECK(geometry->signed_distance(place, normal) == doctest::Approx(height).epsilon(4e-15)); // rounding at 4 m
        CHECK((normal - n).norm() < 4e-16);
    }
}

TEST_CASE("the distance from a tilted slab is that from the nearest place on its faces, and its gradient the normal")
{
    const Vector3 x = Vector3(14.0, -2.0, -5.0) / 15.0;
    const Vector3 y = Vector3(-2.0, 11.0, -10.0) / 15.0;
    const Vector3 z = Vector3(5.0, 10.0, 10.0) / 15.0;
    const Vector3 top(0.3, 0.1, -0.2);
    const auto geometry = slab({1.0, 0.8}, 0.6, {0.3, 0.1, -0.2}, {1.0, 2.0, 2.0});
    test::SurfaceSamples surface;
    surface.add_block(top - 0.5 * x - 0.4 * y - 0.6 * z, {x, 0.8 * y, 0.6 * z}, 100);
    test::check_distance(*geometry, surface);
    test::check_gradient(*geometry);
}

TEST_CASE("a normal of no length is an error that names the parameter")
{
    test::check_mentions(test::message_of_error([] {
                             slab({1.0, 1.0}, 1.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
                         }),
                         {"geometry plugin \"slab\"", "normal must not be zero"});
}
