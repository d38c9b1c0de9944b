// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "prism": which polygons it takes, exact containment, volume and inertia of its fill, distance.
#include "shape_checks.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace periporo;
using List = std::vector<double>;

std::unique_ptr<Geometry> prism(const List& polygon, double height)
{
    return test::geometry("prism", {{"polygon", polygon}, {"height", height}});
}

std::unique_ptr<Geometry> turned_prism(const List& polygon, double height, const List& origin, const List& axis,
                                       double angle)
{
    return test::geometry("prism", {{"polygon", polygon},
                                    {"height", height},
                                    {"origin", origin},
                                    {"rotation_axis", axis},
                                    {"rotation_angle", angle}});
}

/// The same corners the other way round.
List reversed(const List& polygon)
{
    List result;
    for (std::size_t i = polygon.size(); i >= 2; i -= 2)
        result.insert(result.end(), {polygon[i - 2], polygon[i - 1]});
    return result;
}

/// An L of a 4 x 1 and a 1 x 2 rectangle, with a reflex corner at (1, 1).
const List angle_iron{0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 1.0, 1.0, 1.0, 3.0, 0.0, 3.0};
const List triangle{0.0, 0.0, 4.0, 0.0, 0.0, 3.0};

} // namespace

TEST_CASE("the volume of a prism is the area of its polygon times its height, either way round")
{
    CHECK(prism(angle_iron, 0.5)->volume() == 3.0);
    CHECK(prism(reversed(angle_iron), 0.5)->volume() == 3.0);
    CHECK(prism(triangle, 2.0)->volume() == 12.0);
    // Far from its origin, where products of coordinates would leave one digit of ten: exact before the last rounding.
    const double far = 1e7;
    CHECK(prism({far, far, far + 0.5, far, far + 0.5, far + 0.25, far, far + 0.25}, 1.0)->volume() == 0.125);
}

TEST_CASE("a prism contains its faces, edges and corners and nothing one rounding step outside, either way round")
{
    for (const List& polygon : {angle_iron, reversed(angle_iron)}) {
        const auto geometry = prism(polygon, 2.0);
        for (const double z : {0.0, 1.0, 2.0}) {
            for (std::size_t i = 0; i < polygon.size(); i += 2)
                CHECK(geometry->contains(Vector3(polygon[i], polygon[i + 1], z)));
            CHECK(geometry->contains(Vector3(1.0, 2.0, z)));
            CHECK(geometry->contains(Vector3(2.0, 1.0, z)));
            CHECK(geometry->contains(Vector3(0.5, 0.5, z)));
            CHECK_FALSE(geometry->contains(Vector3(test::just_above(1.0), 2.0, z)));
            CHECK_FALSE(geometry->contains(Vector3(2.0, test::just_above(1.0), z)));
            CHECK_FALSE(geometry->contains(Vector3(test::just_above(1.0), test::just_above(1.0), z)));
            CHECK_FALSE(geometry->contains(Vector3(0.5, test::just_above(3.0), z)));
            CHECK_FALSE(geometry->contains(Vector3(-std::numeric_limits<double>::denorm_min(), 1.0, z)));
            CHECK_FALSE(geometry->contains(Vector3(2.0, 2.0, z)));
        }
        CHECK_FALSE(geometry->contains(Vector3(0.5, 0.5, test::just_above(2.0))));
        CHECK_FALSE(geometry->contains(Vector3(0.5, 0.5, -std::numeric_limits<double>::denorm_min())));
    }
}

TEST_CASE("a slanting face is decided exactly")
{
    const auto geometry = prism(triangle, 1.0); // 3 x + 4 y = 12 on its long side
    for (const double x : {0.0, 1.0, 2.0, 3.5, 4.0}) {
        const double y = (12.0 - 3.0 * x) / 4.0; // exact
        CHECK(geometry->contains(Vector3(x, y, 0.5)));
        CHECK_FALSE(geometry->contains(Vector3(x, test::just_above(y), 0.5)));
        CHECK_FALSE(geometry->contains(Vector3(test::just_above(x), y, 0.5)));
        if (x > 0.0 && y > 0.0) {
            CHECK(geometry->contains(Vector3(x, test::just_below(y), 0.5)));
            CHECK(geometry->contains(Vector3(test::just_below(x), y, 0.5)));
        }
    }
}

TEST_CASE("a turned prism is decided exactly, although its axes cannot be written in doubles")
{
    // The half turn about n = (1, 2, 2)/3 takes a vector a to 2 n (n.a) - a: x to (-7, 4, 4)/9, y to (4, -1, 8)/9 and z
    // to (4, 8, -1)/9. All sums below are exact.
    const Vector3 x(-7.0, 4.0, 4.0);
    const Vector3 y(4.0, -1.0, 8.0);
    const Vector3 z(4.0, 8.0, -1.0);
    const Vector3 origin(64.0, 64.0, 64.0);
    List polygon = triangle;
    for (double& coordinate : polygon)
        coordinate *= 9.0;
    const auto geometry = turned_prism(polygon, 18.0, {64.0, 64.0, 64.0}, {1.0, 2.0, 2.0}, std::acos(-1.0));
    const double step = std::ldexp(1.0, -46); // one rounding step between 64 and 128
    for (const double height : {0.0, 0.5, 2.0}) {
        const Vector3 on_side = origin + 2.0 * x + 1.5 * y + height * z; // 3 x + 4 y = 12
        CHECK(geometry->contains(on_side));
        CHECK_FALSE(geometry->contains(on_side + step * x));
        CHECK_FALSE(geometry->contains(on_side + step * y));
        CHECK(geometry->contains(on_side - step * x));
        CHECK(geometry->contains(on_side - step * y));
    }
    const Vector3 on_top = origin + x + y + 2.0 * z;
    CHECK(geometry->contains(on_top));
    CHECK_FALSE(geometry->contains(on_top + step * z));
    CHECK(geometry->contains(on_top - step * z));
    CHECK_FALSE(geometry->contains(origin + x + y - step * z));
}

TEST_CASE("a point that is not finite lies in no prism and has no distance from it")
{
    const auto geometry = prism(triangle, 1.0);
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_FALSE(geometry->contains(Vector3(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0)));
    CHECK_FALSE(geometry->contains(Vector3(0.0, infinity, 0.0)));
    Vector3 normal;
    CHECK_FALSE(std::isfinite(geometry->signed_distance({0.0, infinity, 0.0}, normal)));
    CHECK_FALSE(std::isfinite(geometry->signed_distance({infinity - infinity, 0.0, 0.0}, normal)));
}

TEST_CASE("the bounds of a prism touch its corners")
{
    const Bounds straight = prism(triangle, 2.0)->bounds();
    CHECK(straight.lower == Vector3(0.0, 0.0, 0.0));
    CHECK(straight.upper == Vector3(4.0, 3.0, 2.0));
    // A quarter turn about x takes y to z and z to -y.
    const Bounds turned = turned_prism(triangle, 2.0, {1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, std::acos(0.0))->bounds();
    CHECK(turned.lower == Vector3(1.0, -1.0, 1.0));
    CHECK(turned.upper == Vector3(5.0, 1.0, 4.0));
}

TEST_CASE("a filled prism has the exact volume, and its inertia up to the square of the spacing")
{
    // Triangle with right-angled sides a, b: centroid (a/3, b/3), second moments about it A a^2/18, A b^2/18 and mixed
    // -A a b/36; along the height V H^2/12.
    const double a = 4.0;
    const double b = 3.0;
    const double height = 2.0;
    const auto geometry = turned_prism(triangle, height, {1.0, -2.0, 3.0}, {1.0, 2.0, 3.0}, 0.7);
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
    own.diagonal() = Vector3(a * a / 18.0, b * b / 18.0, height * height / 12.0);
    own(0, 1) = own(1, 0) = -a * b / 36.0;
    const Eigen::Matrix3d exact = geometry->volume() * axes * own * axes.transpose();
    for (const double cells : {2.0, 4.0, 8.0, 16.0}) {
        const double spacing = 1.0 / cells;
        const PointCloud cloud = geometry->fill(spacing);
        for (const Vector3& position : cloud.positions)
            CHECK(geometry->contains(position));
        const test::Moments found = test::moments(cloud);
        CAPTURE(cells);
        CHECK(found.volume == doctest::Approx(geometry->volume()).epsilon(1e-14).scale(0.0));
        // A point lacks h^2/12 along each axis, sqrt(3) h^2/12 of the norm of all three, and cells at the slanting
        // side, which are shifted by up to half a spacing inwards or outwards, do no more than that again.
        const double lacking = std::sqrt(3.0) / 12.0 * spacing * spacing;
        CHECK((found.second - exact).norm() / geometry->volume() < 2.0 * lacking);
        // These cells are a layer of thickness h and 5 m, 5 h/6 of the volume. What is left of their shifts in the mean
        // is less than h/8.
        CHECK((found.centre - (Vector3(1.0, -2.0, 3.0) + axes * Vector3(a / 3.0, b / 3.0, height / 2.0))).norm() <
              5.0 / 48.0 * spacing * spacing);
    }
}

TEST_CASE("the lattice of a prism lies along its own axes, and whole cells stay whole")
{
    const PointCloud straight = prism(angle_iron, 0.5)->fill(0.25);
    const PointCloud turned = turned_prism(angle_iron, 0.5, {1.0, 2.0, 3.0}, {1.0, 1.0, 0.0}, 0.5)->fill(0.25);
    REQUIRE(straight.positions.size() == 6 * 16 * 2);
    REQUIRE(turned.positions.size() == straight.positions.size());
    const Eigen::AngleAxisd rotation(0.5, Vector3(1.0, 1.0, 0.0).normalized());
    for (std::size_t p = 0; p < straight.positions.size(); ++p) {
        CHECK((turned.positions[p] - (Vector3(1.0, 2.0, 3.0) + rotation * straight.positions[p])).norm() < 4e-15);
        CHECK(straight.volumes[p] == doctest::Approx(1.0 / 64.0).epsilon(1e-14).scale(0.0));
        CHECK(turned.volumes[p] == doctest::Approx(1.0 / 64.0).epsilon(1e-14).scale(0.0));
    }
}

TEST_CASE("the distance from a prism is that from its nearest face, edge or corner, reflex ones included")
{
    for (const List& polygon : {angle_iron, reversed(angle_iron)}) {
        const auto geometry = prism(polygon, 6.0);
        const auto check = [&](const Vector3& place, double distance, const Vector3& expected) {
            Vector3 normal;
            CAPTURE(place.transpose());
            CHECK(geometry->signed_distance(place, normal) == doctest::Approx(distance).epsilon(1e-15));
            CHECK((normal - expected).norm() < 4e-16); // a rounding or two
        };
        check({2.5, 1.5, 3.0}, 0.5, {0.0, 1.0, 0.0});
        check({7.0, 5.0, 3.0}, 5.0, {0.6, 0.8, 0.0});                  // corner (4, 1)
        check({7.0, 5.0, 18.0}, 13.0, Vector3(3.0, 4.0, 12.0) / 13.0); // the same at the top
        check({0.7, 0.6, 3.0}, -0.5, {0.6, 0.8, 0.0});                 // inside, the reflex corner (1, 1)
        check({0.25, 2.0, 3.0}, -0.25, {-1.0, 0.0, 0.0});
        check({0.5, 0.5, 5.875}, -0.125, {0.0, 0.0, 1.0});
        check({2.0, 1.0, 3.0}, 0.0, {0.0, 1.0, 0.0});
    }
}

TEST_CASE("the normal of a prism has the length 1 on edges, at corners and the smallest step from them")
{
    const double step = std::numeric_limits<double>::denorm_min();
    const auto geometry = prism(angle_iron, 2.0);
    for (std::size_t i = 0; i < angle_iron.size(); i += 2)
        for (const double x : {-step, 0.0, step})
            for (const double y : {-step, 0.0, step})
                for (const double z : {-step, 0.0, 1.0, 2.0}) {
                    Vector3 normal;
                    const Vector3 place(angle_iron[i] + x, angle_iron[i + 1] + y, z);
                    CHECK(std::abs(geometry->signed_distance(place, normal)) < 1e-300);
                    CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-15));
                }
}

TEST_CASE("corners between edges in one line, or nearly so, do not turn the distance inside out")
{
    // Edges that are cut into pieces at places that are rounded, so that they bend by a rounding step.
    List polygon;
    const std::vector<Vector3> corners{{0.0, 0.0, 0.0}, {1.0, 0.3, 0.0}, {0.4, 1.1, 0.0}};
    for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 7; ++k) {
            const Vector3 corner = corners[i] + k / 7.0 * (corners[(i + 1) % 3] - corners[i]);
            polygon.insert(polygon.end(), {corner.x(), corner.y()});
        }
    const auto pieces = prism(polygon, 9.0);
    const auto whole = prism({0.0, 0.0, 1.0, 0.3, 0.4, 1.1}, 9.0);
    // Places straight across from the corners are what is nearest to two edges at once.
    for (std::size_t i = 0; i < polygon.size(); i += 2)
        for (const double x : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
            const std::size_t side = i / 14;
            const Vector3 along = corners[(side + 1) % 3] - corners[side];
            const Vector3 place = Vector3(polygon[i], polygon[i + 1], 4.5) + x * Vector3(along.y(), -along.x(), 0.0);
            Vector3 normal;
            Vector3 expected;
            CAPTURE(place.transpose());
            const double distance = whole->signed_distance(place, expected);
            CHECK(std::abs(pieces->signed_distance(place, normal) - distance) < 1e-15);
            if (std::abs(distance) > 1e-3 && i % 14 != 0) // where the normal of the whole is that of one edge
                CHECK((normal - expected).norm() < 1e-12);
        }
}

TEST_CASE("the distance from a turned prism is that from the nearest place on it, and its gradient the normal")
{
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    const Vector3 origin(0.3, -0.2, 0.1);
    const double scale = 0.25;
    const double height = 0.6;
    List polygon = angle_iron;
    for (double& coordinate : polygon)
        coordinate *= scale;
    test::SurfaceSamples surface;
    const Vector3 up = height * axes.col(2);
    for (std::size_t i = 0; i < polygon.size(); i += 2) {
        const Vector3 start = axes * Vector3(polygon[i], polygon[i + 1], 0.0);
        const std::size_t next = (i + 2) % polygon.size();
        const Vector3 end = axes * Vector3(polygon[next], polygon[next + 1], 0.0);
        surface.add(origin + start, end - start, up, 100);
    }
    for (const Vector3& base : {origin, Vector3(origin + up)}) {
        surface.add(base, 4.0 * scale * axes.col(0), scale * axes.col(1), 100);
        surface.add(base + scale * axes.col(1), scale * axes.col(0), 2.0 * scale * axes.col(1), 100);
    }
    const auto geometry = turned_prism(polygon, height, {0.3, -0.2, 0.1}, {1.0, 2.0, 3.0}, 0.7);
    test::check_distance(*geometry, surface);
    test::check_gradient(*geometry);
}

TEST_CASE("fewer than three corners and numbers that are no pairs are errors")
{
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 1.0, 0.0}, 1.0);
                         }),
                         {"geometry plugin \"prism\"", "polygon has 2 corners, and needs 3"});
    test::check_mentions(test::message_of_error([] { prism({}, 1.0); }), {"polygon has 0 corners"});
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 2.0}, 1.0);
                         }),
                         {"polygon holds 7 numbers", "pairs x, y"});
}

TEST_CASE("a polygon that crosses itself is an error with the edges that cross")
{
    // A bow tie: edges 1 and 3 cross in the middle.
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 2.0, 2.0}, 1.0);
                         }),
                         {"edge 1 from (2, 0) to (0, 2) meets edge 3 from (2, 2) to (0, 0)", "counted from 0"});
    // A corner on another edge.
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 4.0, 0.0, 4.0, 2.0, 2.0, 0.0, 0.0, 2.0}, 1.0);
                         }),
                         {"edge 0 from (0, 0) to (4, 0) meets edge 2 from (4, 2) to (2, 0)"});
    // An edge that runs back along the one before, and the last along the first.
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 4.0, 0.0, 2.0, 0.0, 2.0, 2.0}, 1.0);
                         }),
                         {"edge 0 from (0, 0) to (4, 0) meets edge 1 from (4, 0) to (2, 0)"});
    test::check_mentions(test::message_of_error([] {
                             prism({1.0, 0.0, 3.0, 0.0, 3.0, 2.0, 4.0, 0.0}, 1.0);
                         }),
                         {"edge 0 from (1, 0) to (3, 0) meets edge 3 from (4, 0) to (1, 0)"});
    // All in one line.
    test::check_mentions(test::message_of_error([] { prism({0.0, 0.0, 1.0, 1.0, 2.0, 2.0}, 1.0); }), {"meets edge"});
}

TEST_CASE("no more pairs of edges that cross are listed than a user can look at")
{
    List zigzag; // up and down, and back along the middle of all
    for (int i = 0; i < 40; ++i)
        zigzag.insert(zigzag.end(), {static_cast<double>(i), i % 2 == 0 ? 1.0 : -1.0});
    zigzag.insert(zigzag.end(), {50.0, 0.0, -10.0, 0.0});
    const std::string message = test::message_of_error([&] { prism(zigzag, 1.0); });
    CHECK(message.ends_with("..."));
    CHECK(std::count(message.begin(), message.end(), '\n') == 6);
}

TEST_CASE("two corners at one place, one after the other, are an error with their numbers")
{
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0}, 1.0);
                         }),
                         {"corners 1 and 2 of polygon", "both at (1, 0)"});
    test::check_mentions(test::message_of_error([] {
                             prism({0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0}, 1.0);
                         }),
                         {"corners 3 and 0 of polygon", "leave one out"});
}
