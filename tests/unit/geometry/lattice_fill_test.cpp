// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The lattice that fills any geometry: exact volume, inertia of second order, mirror images, what it refuses.
#include "shape_checks.hpp"

#include "support/errors.hpp"

#include <Eigen/Geometry>

#include <functional>
#include <map>
#include <numbers>
#include <tuple>

namespace {

using namespace periporo;

/// The region where a function says so.
class Region : public Geometry {
public:
    Region(const Vector3& lower, const Vector3& upper, double volume, std::function<bool(const Vector3&)> inside)
        : bounds_{lower, upper}, volume_(volume), inside_(std::move(inside))
    {
    }
    bool contains(const Vector3& position) const override { return inside_(position); }
    Bounds bounds() const override { return bounds_; }
    double volume() const override { return volume_; }

private:
    Bounds bounds_;
    double volume_;
    std::function<bool(const Vector3&)> inside_;
};

Region ball(double radius, const Vector3& centre = Vector3::Zero())
{
    const Vector3 reach = Vector3::Constant(radius);
    return {centre - reach, centre + reach, 4.0 / 3.0 * std::numbers::pi * radius * radius * radius,
            [=](const Vector3& p) { return (p - centre).squaredNorm() <= radius * radius; }};
}

Region block(const Vector3& lower, const Vector3& upper)
{
    return {lower, upper, (upper - lower).prod(),
            [=](const Vector3& p) { return (p.array() >= lower.array()).all() && (p.array() <= upper.array()).all(); }};
}

/// About the origin, the columns of `axes` along its edges.
Region turned_block(const Vector3& size, const Eigen::Matrix3d& axes)
{
    const Vector3 reach = 0.5 * axes.cwiseAbs() * size;
    return {-reach, reach, size.prod(),
            [=](const Vector3& p) { return ((axes.transpose() * p).array().abs() <= 0.5 * size.array()).all(); }};
}

Eigen::Matrix3d turn(double angle, const Vector3& axis)
{
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
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

TEST_CASE("the volumes of the points add up to that of the geometry, and every point has one")
{
    const Region geometries[] = {ball(1.0), ball(0.9, {0.31, -5.2, 12.7}), block({0.1, 0.2, 0.3}, {1.7, 1.9, 2.2}),
                                 turned_block({2.0, 1.6, 1.2}, turn(0.8, {1.0, 2.0, 3.0}))};
    for (const Region& geometry : geometries)
        for (const double spacing : {0.8, 0.3, 0.11, 0.05}) {
            CAPTURE(spacing);
            const PointCloud cloud = geometry.fill(spacing);
            REQUIRE(cloud.positions.size() == cloud.volumes.size());
            CHECK(test::moments(cloud).volume == doctest::Approx(geometry.volume()).epsilon(1e-14).scale(0.0));
            CHECK(*std::min_element(cloud.volumes.begin(), cloud.volumes.end()) > 0.0);
            for (const Vector3& position : cloud.positions)
                CHECK(geometry.contains(position));
        }
}

TEST_CASE("faces along the lattice that divide cells at sixteenths divide their volumes exactly")
{
    // 4 1/4 cells along each edge: the quarter cells go to the neighbours within. 4 3/4 cells: they have a point each.
    // The samples stand in 16 planes across an edge, none on a sixteenth, 4 or 12 of them inside.
    for (const double cells : {4.25, 4.75}) {
        const PointCloud cloud = block(Vector3::Zero(), Vector3::Constant(0.5 * cells)).fill(0.5);
        const double last = std::round(cells) - 0.5;
        const double last_width = cells - std::round(cells) + 1.0;
        REQUIRE(cloud.positions.size() == std::pow(std::round(cells), 3));
        for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
            double expected = 0.125;
            for (int k = 0; k < 3; ++k)
                expected *= cloud.positions[p][k] == 0.5 * last ? last_width : 1.0;
            CHECK(cloud.volumes[p] == doctest::Approx(expected).epsilon(1e-14).scale(0.0));
        }
    }
}

TEST_CASE("a face along the lattice anywhere in a cell is seen to within a thirty-second of the cell")
{
    for (const double top : {2.03, 2.27, 2.49, 2.51, 2.66, 2.99}) {
        const PointCloud cloud = block(Vector3::Zero(), {4.0, 4.0, top}).fill(1.0);
        double upper = 0.0;
        for (std::size_t p = 0; p < cloud.positions.size(); ++p)
            upper += cloud.positions[p].z() > 1.0 ? cloud.volumes[p] : 0.0;
        CAPTURE(top);
        // The lower layer is whole. When the sampled height t' = t + e is scaled to t, its volume becomes 16 t/t',
        // which is wrong by 16 e/t', with |e| <= 1/32.
        CHECK(std::abs(upper - 16.0 * (top - 1.0)) <= 16.0 / 32.0 / (top - 1.0 / 32.0));
    }
}

TEST_CASE("the second moments of a ball converge with the square of the spacing")
{
    for (const double cells : {4.0, 5.7, 8.0, 11.3, 16.0, 32.0}) {
        const PointCloud cloud = ball(1.0).fill(1.0 / cells);
        const test::Moments found = test::moments(cloud);
        const double exact = ball(1.0).volume() / 5.0; // integral of x^2 over a ball of radius 1: V r^2/5
        CAPTURE(cells);
        CHECK(found.centre.norm() < 1e-18); // all but nothing, as images have equal volumes
        // A point lacks the extent of its cell, h^2/12 along each axis, or 5/12 (h/r)^2 of r^2/5. Cells at the surface
        // are shifted by less than h, some inwards and some outwards, within a layer of thickness h: as much again.
        CHECK((found.second / exact - Eigen::Matrix3d::Identity()).norm() < 1.5 / (cells * cells));
    }
}

TEST_CASE("the inertia of a turned block converges with the square of the spacing, however it is turned")
{
    const Vector3 size(2.0, 1.6, 1.2);
    for (const double angle : {0.0, 0.02, 0.3, 0.8, 1.3})
        for (const Vector3& axis : {Vector3(0.0, 0.0, 1.0), Vector3(1.0, 2.0, 3.0), Vector3(-1.0, 0.2, 0.4)}) {
            const Eigen::Matrix3d axes = turn(angle, axis);
            const Region geometry = turned_block(size, axes);
            const Eigen::Matrix3d exact =
                axes * Eigen::Matrix3d((geometry.volume() / 12.0 * size.cwiseAbs2()).asDiagonal()) * axes.transpose();
            for (const double cells : {4.0, 8.0, 16.0, 32.0}) {
                const test::Moments found = test::moments(geometry.fill(1.0 / cells));
                CAPTURE(angle);
                CAPTURE(axis.transpose());
                CAPTURE(cells);
                // The extent of the cells is (h/1.2)^2 of the moment along the shortest edge, and the surface does as
                // much again; a face along the lattice may be seen h/32 off its place, which is 3 h/(32 x 0.6) of it.
                CHECK((found.second - exact).norm() / exact.norm() <
                      2.0 / (1.44 * cells * cells) + (angle < 0.1 ? 3.0 / (32.0 * 0.6 * cells) : 0.0));
            }
        }
}

TEST_CASE("mirror images at planes through the origin are equal to the last bit, and so are exchanged axes")
{
    for (const double spacing : {0.37, 0.25, 0.08}) {
        const auto volumes = by_place(ball(1.0).fill(spacing));
        for (const auto& [place, volume] : volumes) {
            const auto& [x, y, z] = place;
            CHECK(std::min({std::abs(x), std::abs(y), std::abs(z)}) >= 0.5 * spacing * (1.0 - 1e-15));
            for (const auto& image : {std::tuple(-x, y, z), std::tuple(x, -y, z), std::tuple(x, y, -z),
                                      std::tuple(y, x, z), std::tuple(x, z, y)}) {
                REQUIRE(volumes.count(image) == 1);
                CHECK(volumes.at(image) == volume);
            }
        }
    }
}

TEST_CASE("a lattice in a frame is that of the axes of coordinates, turned and shifted")
{
    const Vector3 size(1.0, 0.75, 0.5); // whole cells, so that rounding shifts no sample over a face
    const Vector3 origin(3.0, -2.0, 1.0);
    const Eigen::Matrix3d axes = turn(0.7, {2.0, -1.0, 1.0});
    const Bounds own{Vector3::Zero(), size};
    const PointCloud straight = block(own.lower, own.upper).fill(0.125);
    const Region turned(Vector3::Constant(-9.0), Vector3::Constant(9.0), size.prod(), [&](const Vector3& p) {
        const Vector3 local = axes.transpose() * (p - origin);
        return (local.array() >= 0.0).all() && (local.array() <= size.array()).all();
    });
    const PointCloud cloud = fill_by_lattice(turned, 0.125, {origin, axes, own});
    REQUIRE(cloud.positions.size() == 8 * 6 * 4);
    REQUIRE(straight.positions.size() == cloud.positions.size());
    for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
        CHECK((cloud.positions[p] - (origin + axes * straight.positions[p])).norm() < 4e-15); // rounding at 3 m
        CHECK(cloud.volumes[p] == doctest::Approx(straight.volumes[p]).epsilon(1e-14).scale(0.0));
    }
}

TEST_CASE("a sheet too thin for the samples has points where it passes through centres, with its volume")
{
    const PointCloud cloud = block({0.0, 0.0, 0.49}, {4.0, 3.0, 0.51}).fill(1.0);
    REQUIRE(cloud.positions.size() == 12);
    for (const double volume : cloud.volumes)
        CHECK(volume == doctest::Approx(0.02).epsilon(1e-14).scale(0.0));
}

TEST_CASE("a spacing that puts no centre inside is an error with one that does")
{
    // 0.05 to 0.15: no odd multiple of 1/2 or 1/4 lies there, but 1/8 does.
    const std::string message = test::message_of_error([] { block({0.0, 0.0, 0.05}, {4.0, 4.0, 0.15}).fill(1.0); });
    test::check_mentions(message,
                         {"no lattice cell of spacing 1 m has its centre inside", "a spacing of 0.25 m would"});
    // A sheet so wide that the search would need too many cells to find 0.25 m: an error without advice.
    const std::string wide = test::message_of_error([] { block({0.0, 0.0, 0.12}, {999.0, 999.0, 0.13}).fill(1.0); });
    test::check_mentions(wide, {"no lattice cell of spacing 1 m has its centre inside"});
    CHECK(wide.find("would give") == std::string::npos);
}

TEST_CASE("a spacing that is no length is an error")
{
    for (const double spacing :
         {0.0, -0.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        test::check_mentions(test::message_of_error([&] { ball(1.0).fill(spacing); }), {"spacing must be positive"});
}

TEST_CASE("more cells than a computation could hold are an error with the spacing and the size of the geometry")
{
    test::check_mentions(test::message_of_error([] {
                             block(Vector3::Zero(), {100.0, 200.0, 300.0}).fill(0.01);
                         }),
                         {"spacing of 0.01 m", "6e+12 lattice cells", "100 x 200 x 300 m", "unit"});
    const double infinity = std::numeric_limits<double>::infinity();
    const Region endless(Vector3::Zero(), Vector3(1.0, 1.0, infinity), 1.0, [](const Vector3&) { return true; });
    test::check_mentions(test::message_of_error([&] { endless.fill(0.1); }), {"lattice cells"});
}

TEST_CASE("a geometry with no box around it or no volume is an error")
{
    const auto everywhere = [](const Vector3&) { return true; };
    const double infinity = std::numeric_limits<double>::infinity();
    const Region empty(Vector3::Constant(infinity), Vector3::Constant(-infinity), 0.0, everywhere);
    test::check_mentions(test::message_of_error([&] { empty.fill(0.1); }), {"geometry is empty"});
    for (const double volume : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        const Region odd(Vector3::Zero(), Vector3::Ones(), volume, everywhere);
        test::check_mentions(test::message_of_error([&] { odd.fill(0.1); }), {"volume of the geometry", "positive"});
    }
}

TEST_CASE("what a geometry throws on any thread arrives")
{
    const Region faulty(Vector3::Zero(), Vector3::Ones(), 1.0, [](const Vector3& p) -> bool {
        if (p.z() > 0.9)
            throw std::runtime_error("out of order");
        return true;
    });
    CHECK(test::message_of_error([&] { faulty.fill(0.05); }) == "out of order");
}

TEST_CASE("a geometry that does not know its distance says so")
{
    Vector3 normal;
    CHECK_FALSE(ball(1.0).has_distance());
    CHECK_THROWS_AS(ball(1.0).signed_distance(Vector3::Zero(), normal), std::logic_error);
}
