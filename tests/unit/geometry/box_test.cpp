// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "box": exact containment, tight bounds, whole cells, distance from its surface.
#include "shape_checks.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace periporo;
using List = std::vector<double>;

std::unique_ptr<Geometry> box(const List& size, const List& origin = {0.0, 0.0, 0.0})
{
    return test::geometry("box", {{"size", size}, {"origin", origin}});
}

std::unique_ptr<Geometry> rotated_box(const List& size, const List& origin, const List& axis, double angle)
{
    return test::geometry("box",
                          {{"size", size}, {"origin", origin}, {"rotation_axis", axis}, {"rotation_angle", angle}});
}

/// Signed distance of a place, which must come with the given normal.
double distance(const Geometry& geometry, const Vector3& place, const Vector3& expected_normal)
{
    Vector3 normal;
    const double result = geometry.signed_distance(place, normal);
    CAPTURE(place.transpose());
    CAPTURE(normal.transpose());
    CHECK((normal - expected_normal).norm() < 4e-16); // a rounding or two
    return result;
}

} // namespace

TEST_CASE("the volume of a box is the product of its edges, rotated or not")
{
    CHECK(box({0.5, 0.25, 2.0})->volume() == 0.25); // exact in binary
    CHECK(rotated_box({0.5, 0.25, 2.0}, {3.0, 1.0, 4.0}, {1.0, 2.0, 3.0}, 0.4)->volume() == 0.25);
}

TEST_CASE("a box contains its corners, edges and faces and nothing one rounding step outside")
{
    test::check_closed_region(*box({2.0, 1.0, 0.5}, {-1.0, 4.0, 0.25}), {-1.0, 4.0, 0.25}, {1.0, 5.0, 0.75});
}

TEST_CASE("the far face is where the exact sum of origin and size lies, between two doubles")
{
    // The doubles 0.1 and 0.2 add up to 0.3000000000000000166, which is no double; 0.3 is just below it and
    // 0.30000000000000004 just above.
    const auto geometry = box({0.2, 1.0, 1.0}, {0.1, 0.0, 0.0});
    CHECK(geometry->contains(Vector3(0.3, 0.5, 0.5)));
    CHECK_FALSE(geometry->contains(Vector3(0.1 + 0.2, 0.5, 0.5)));
}

TEST_CASE("a box turned by whole quarters about a coordinate axis has exactly axis-parallel faces")
{
    const List size{2.0, 1.0, 0.5};
    const List origin{3.0, 5.0, 7.0};
    const double quarter = std::numbers::pi / 2;
    // About z: x -> y -> -x.
    test::check_closed_region(*rotated_box(size, origin, {0.0, 0.0, 1.0}, quarter), {2.0, 5.0, 7.0}, {3.0, 7.0, 7.5});
    test::check_closed_region(*rotated_box(size, origin, {0.0, 0.0, 4.0}, 2 * quarter), {1.0, 4.0, 7.0},
                              {3.0, 5.0, 7.5});
    test::check_closed_region(*rotated_box(size, origin, {0.0, 0.0, 1.0}, -quarter), {3.0, 3.0, 7.0}, {4.0, 5.0, 7.5});
    // About x: y -> z -> -y. About y: z -> x -> -z.
    test::check_closed_region(*rotated_box(size, origin, {1.0, 0.0, 0.0}, quarter), {3.0, 4.5, 7.0}, {5.0, 5.0, 8.0});
    test::check_closed_region(*rotated_box(size, origin, {0.0, 1.0, 0.0}, 5 * quarter), {3.0, 5.0, 5.0},
                              {3.5, 6.0, 7.0});
}

TEST_CASE("a rotated box decides right within a hair of each face")
{
    const Vector3 size(0.3, 0.2, 0.5);
    const Vector3 origin(1.0, -2.0, 0.5);
    const Vector3 axis(1.0, 2.0, 3.0);
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, axis.normalized()).toRotationMatrix();
    const auto geometry = rotated_box({size.x(), size.y(), size.z()}, {origin.x(), origin.y(), origin.z()},
                                      {axis.x(), axis.y(), axis.z()}, 0.7);
    // Coordinates up to 2.5 and the rotation here are rounded to about 1e-15; the hair is well above that, and below
    // the distance at which double arithmetic alone may decide.
    const double hair = 1e-14;
    for (int direction = 0; direction < 3; ++direction)
        for (const double face : {0.0, size[direction]})
            for (const double side : {-1.0, 1.0}) {
                Vector3 local = size / 3;
                local[direction] = face + side * hair;
                CAPTURE(direction);
                CAPTURE(face);
                CAPTURE(side);
                const bool inwards = face > 0.0 ? side < 0.0 : side > 0.0;
                CHECK(geometry->contains(origin + rotation * local) == inwards);
            }
}

TEST_CASE("a rotated box contains its origin, and no point that is not finite")
{
    const auto geometry = rotated_box({0.3, 0.2, 0.5}, {0.1, 0.7, -0.3}, {1.0, -1.0, 0.3}, 1.1);
    CHECK(geometry->contains(Vector3(0.1, 0.7, -0.3)));
    CHECK_FALSE(geometry->contains(Vector3(0.1, std::numeric_limits<double>::quiet_NaN(), -0.3)));
    CHECK_FALSE(geometry->contains(Vector3(0.1, 0.7, std::numeric_limits<double>::infinity())));
}

TEST_CASE("the bounds of a box along the axes are its corners")
{
    const Bounds bounds = box({0.2, 0.4, 0.8}, {0.1, 0.2, 0.3})->bounds();
    CHECK(bounds.lower == Vector3(0.1, 0.2, 0.3));
    CHECK(bounds.upper == Vector3(0.1 + 0.2, 0.2 + 0.4, 0.3 + 0.8));
}

TEST_CASE("the bounds of a square turned by 45 degrees are its diagonals")
{
    const Bounds bounds =
        rotated_box({1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, std::numbers::pi / 4)->bounds();
    const double half_diagonal = std::numbers::sqrt2 / 2;
    const double tolerance = 1e-15; // a few roundings of numbers of order one
    CHECK((bounds.lower - Vector3(-half_diagonal, 0.0, 0.0)).norm() < tolerance);
    CHECK((bounds.upper - Vector3(half_diagonal, 2 * half_diagonal, 1.0)).norm() < tolerance);
}

TEST_CASE("a column is filled with whole cells: their number, volume and places")
{
    const auto geometry = box({0.1, 0.1, 0.12});
    const PointCloud cloud = geometry->fill(0.01);
    REQUIRE(cloud.positions.size() == 10 * 10 * 12);
    REQUIRE(cloud.volumes.size() == cloud.positions.size());
    for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
        CHECK(geometry->contains(cloud.positions[p]));
        CHECK(cloud.volumes[p] == doctest::Approx(1e-6).epsilon(1e-14).scale(0.0));
        // Centres of cells: an odd number of half spacings from the faces.
        for (int direction = 0; direction < 3; ++direction) {
            const double halves = cloud.positions[p][direction] / 0.005;
            CHECK(std::abs(std::remainder(halves - 1.0, 2.0)) < 1e-12);
        }
    }
}

TEST_CASE("no two points of a filled box share a cell")
{
    PointCloud cloud = box({0.04, 0.03, 0.02})->fill(0.01);
    std::sort(cloud.positions.begin(), cloud.positions.end(), [](const Vector3& a, const Vector3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    });
    for (std::size_t p = 1; p < cloud.positions.size(); ++p)
        CHECK((cloud.positions[p] - cloud.positions[p - 1]).lpNorm<Eigen::Infinity>() > 0.0099);
}

TEST_CASE("a rotated box is filled with the rotated lattice")
{
    const Vector3 origin(1.0, 2.0, 3.0);
    const double angle = std::numbers::pi / 6;
    const PointCloud straight = box({0.2, 0.1, 0.3})->fill(0.05);
    const auto geometry = rotated_box({0.2, 0.1, 0.3}, {1.0, 2.0, 3.0}, {1.0, 1.0, 0.0}, angle);
    const PointCloud turned = geometry->fill(0.05);
    const Eigen::AngleAxisd rotation(angle, Vector3(1.0, 1.0, 0.0).normalized());
    REQUIRE(turned.positions.size() == straight.positions.size());
    for (std::size_t p = 0; p < turned.positions.size(); ++p) {
        CHECK((turned.positions[p] - (origin + rotation * straight.positions[p])).norm() < 4e-15); // rounding at 3 m
        CHECK(geometry->contains(turned.positions[p]));
    }
}

TEST_CASE("a size that is a whole number of cells but for rounding is filled exactly")
{
    const double size = 0.1 * (1.0 + 1e-9);
    const PointCloud cloud = box({size, size, size})->fill(0.01);
    REQUIRE(cloud.positions.size() == 1000);
    double sum = 0.0;
    for (const double volume : cloud.volumes)
        sum += volume;
    CHECK(sum == doctest::Approx(size * size * size).epsilon(1e-13).scale(0.0)); // a thousand roundings of 1e-16
}

TEST_CASE("a size that holds no whole number of cells is an error with the sizes and the spacing that fit")
{
    const auto geometry = box({0.105, 0.1, 0.2});
    // 105, 100 and 200 mm share 5 mm as the largest divisor not below half of 10 mm.
    test::check_mentions(
        test::message_of_error([&] { geometry->fill(0.01); }),
        {"box", "size[0] = 0.105 m", "0.1 m or 0.11 m would fit", "spacing of 0.005 m, which divides every edge"});
}

TEST_CASE("a spacing larger than the box is an error that offers no empty box")
{
    const std::string message = test::message_of_error([] { box({0.1, 1.0, 1.0})->fill(0.5); });
    test::check_mentions(message, {"size[0] = 0.1 m", "0.5 m would fit"});
    CHECK(message.find(" 0 m") == std::string::npos);
}

TEST_CASE("a rotation about no axis is an error that names the parameter")
{
    test::check_mentions(test::message_of_error([] {
                             rotated_box({1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1.0);
                         }),
                         {"geometry plugin \"box\"", "rotation_axis must not be zero"});
}

TEST_CASE("the second moments of a filled box are those of the box less those of one cell")
{
    // n cells of width h along an edge L: sum of h (x - L/2)^2 = L^3/12 (1 - 1/n^2) = L (L^2 - h^2)/12.
    const Vector3 size(0.2, 0.1, 0.3);
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    const test::Moments found =
        test::moments(rotated_box({0.2, 0.1, 0.3}, {1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 0.7)->fill(0.05));
    const Vector3 own = size.prod() / 12.0 * (size.cwiseAbs2().array() - 0.05 * 0.05).matrix();
    const Eigen::Matrix3d exact = axes * own.asDiagonal() * axes.transpose();
    CHECK(found.volume == doctest::Approx(size.prod()).epsilon(1e-14).scale(0.0));
    CHECK((found.centre - (Vector3(1.0, 2.0, 3.0) + axes * size / 2)).norm() < 1e-14);
    CHECK((found.second - exact).norm() < 1e-13 * exact.norm());
}

TEST_CASE("outside a box the distance is that from the nearest face, edge or corner")
{
    const auto geometry = box({2.0, 4.0, 6.0}, {1.0, 1.0, 1.0}); // 1 to 3, 1 to 5 and 1 to 7
    CHECK(distance(*geometry, {4.5, 2.0, 2.0}, Vector3::UnitX()) == 1.5);
    CHECK(distance(*geometry, {2.0, 4.0, 0.5}, -Vector3::UnitZ()) == 0.5);
    CHECK(distance(*geometry, {6.0, 9.0, 2.0}, {0.6, 0.8, 0.0}) == 5.0);                    // 3, 4
    CHECK(distance(*geometry, {-2.0, 9.0, 19.0}, Vector3(-3.0, 4.0, 12.0) / 13.0) == 13.0); // 3, 4, 12
}

TEST_CASE("inside a box and on its surface the nearest face counts")
{
    const auto geometry = box({2.0, 4.0, 6.0}, {1.0, 1.0, 1.0});
    CHECK(distance(*geometry, {1.25, 2.0, 3.0}, -Vector3::UnitX()) == -0.25);
    CHECK(distance(*geometry, {2.0, 4.5, 3.0}, Vector3::UnitY()) == -0.5);
    CHECK(distance(*geometry, {2.0, 3.0, 7.0}, Vector3::UnitZ()) == 0.0);
    CHECK(distance(*geometry, {1.0, 3.0, 3.0}, -Vector3::UnitX()) == 0.0);
}

TEST_CASE("the normal of a box has the length 1 on edges, at corners, in the middle and the smallest step outside")
{
    const double step = std::numeric_limits<double>::denorm_min();
    for (const auto& geometry :
         {box({2.0, 2.0, 2.0}), rotated_box({2.0, 2.0, 2.0}, {0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, 0.7)})
        for (const Vector3& place :
             {Vector3(0.0, 0.0, 0.0), Vector3(1.0, 0.0, 0.0), Vector3(1.0, 1.0, 1.0), Vector3(0.0, 1.0, 1.0),
              Vector3(-step, -step, -step), Vector3(-step, -step, 1.0)}) {
            Vector3 normal;
            CHECK(std::abs(geometry->signed_distance(place, normal)) <= 3.0);
            CAPTURE(place.transpose());
            CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-15));
        }
}

TEST_CASE("the distance from a turned box is that from the nearest place on its faces, and its gradient the normal")
{
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    const auto geometry = rotated_box({0.8, 1.0, 0.5}, {0.3, -0.2, 0.1}, {1.0, 2.0, 3.0}, 0.7);
    test::SurfaceSamples surface;
    surface.add_block({0.3, -0.2, 0.1}, {0.8 * axes.col(0), axes.col(1), 0.5 * axes.col(2)}, 100);
    test::check_distance(*geometry, surface);
    test::check_gradient(*geometry);
}
