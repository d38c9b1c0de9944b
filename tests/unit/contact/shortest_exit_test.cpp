// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The exit from the reach of a solid: corners, valleys and flush faces of all geometries, thin plates, leaps.
#include "contact/shortest_exit.hpp"
#include "support/corners.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double reach = 5e-3; // [m]
const Vector3 nowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
/// The free position is found to 1e-9 of the reach, in a few turns that may each miss as much.
constexpr double tolerance = 1e-8 * reach;

SolidContact met(const Geometry& geometry, const Vector3& position, const Vector3& last_free_position = nowhere)
{
    Vector3 normal;
    const double distance = geometry.signed_distance(position, normal);
    return find_exit(geometry, position, distance, normal, reach, last_free_position);
}

struct RandomPlaces {
    std::mt19937 generator{11};
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }
    Vector3 inside(double low, double high) { return {between(low, high), between(low, high), between(low, high)}; }
};

} // namespace

TEST_CASE("the shortest move satisfies all limits, and only faces that it touches push")
{
    RandomPlaces random;
    for (int n = 0; n < 2000; ++n) {
        const Vector3 up = random.inside(-1.0, 1.0).normalized();
        std::vector<FaceLimit> limits;
        for (int f = 0; f < 1 + n % 8; ++f) { // all look up: there is a move
            const Vector3 normal = (up + 0.99 * random.inside(-1.0, 1.0).normalized()).normalized();
            limits.push_back({normal, random.between(-0.5, 1.0)});
        }
        ShortestExit exit;
        REQUIRE(find_shortest_exit(limits, 1e-12, exit));
        // The conditions of Karush, Kuhn and Tucker are enough for the least |u|^2 under linear limits.
        Vector3 sum = Vector3::Zero();
        for (std::size_t f = 0; f < exit.faces; ++f) {
            CHECK(exit.shares[f] >= 0.0);
            sum += exit.shares[f] * exit.normals[f];
        }
        CHECK((sum - exit.move).norm() < 1e-12 * (1.0 + exit.move.norm()));
        for (const FaceLimit& limit : limits) {
            const double beyond = limit.normal.dot(exit.move) - limit.least;
            CHECK(beyond >= -1e-12);
            for (std::size_t f = 0; f < exit.faces; ++f)
                if (limit.normal == exit.normals[f])
                    CHECK(std::abs(beyond) < 1e-9); // normals as near as 1e-3 to a plane lose digits
        }
    }
}

TEST_CASE("in a concave corner of one obstacle each face pushes by its own overlap")
{
    for (const NamedShape& corner : solid_corners()) {
        CAPTURE(corner.name);
        RandomPlaces random;
        for (int n = 0; n < 300; ++n) {
            const Vector3 position = random.inside(0.05 * reach, 1.4 * reach);
            const Vector3 expected = (Vector3::Constant(reach) - position).cwiseMax(0.0);
            CAPTURE(position.transpose());
            const Vector3 before = position + 0.1 * reach * random.inside(-1.0, 1.0).cwiseMax(0.0) + expected;
            for (const Vector3& last : {nowhere, before}) {
                const SolidContact contact = met(*corner.shape, position, last);
                CHECK((contact.exit.move - expected).norm() < tolerance);
                CHECK((contact.free_position - position - expected).norm() < tolerance);
                CHECK_FALSE(contact.crossed);
            }
        }
    }
}

TEST_CASE("sums of normal forces are those of the faces")
{
    const SolidContact contact = met(*solid_corners().front().shape, Vector3(0.9, 0.8, 2.0) * reach);
    REQUIRE(contact.exit.faces == 2);
    CHECK(contact.exit.normal_force_factor() == doctest::Approx(0.3 / std::hypot(0.1, 0.2)).epsilon(1e-8));
}

TEST_CASE("flush faces are one face: edges between boxes, triangles or cells of a terrain are not felt")
{
    // Squares of different triangles, and a corner where six of them meet.
    std::vector<std::vector<Vector3>> facets;
    const Vector3 x = 0.04 * Vector3::UnitX(), y = 0.04 * Vector3::UnitY(), z = -0.04 * Vector3::UnitZ();
    const std::vector<Vector3> ring{x, x + y, y, -x, -x - y, -y, x};
    for (std::size_t k = 0; k < 6; ++k) {
        facets.push_back({Vector3::Zero(), ring[k], ring[k + 1]});
        facets.push_back({z, ring[k + 1] + z, ring[k] + z});
        facets.push_back({ring[k], ring[k] + z, ring[k + 1] + z, ring[k + 1]});
    }
    const std::vector<NamedShape> floors{
        {"boxes side by side",
         boolean("union", {box({-0.04, -0.04, -0.03}, {0.0, 0.04, 0.0}), box({0.0, -0.04, -0.03}, {0.04, 0.04, 0.0})})},
        {"boxes that overlap", boolean("union", {box({-0.04, -0.04, -0.03}, {1e-3, 0.04, 0.0}),
                                                 box({-1e-3, -0.04, -0.02}, {0.04, 0.04, 0.0})})},
        {"mesh", mesh(facets)},
        {"terrain", heightfield(0.04, 8, [](double, double) { return 0.0; })}};
    for (const NamedShape& floor : floors) {
        CAPTURE(floor.name);
        RandomPlaces random;
        for (int n = 0; n < 300; ++n) {
            const double spread = n % 3 == 0 ? 1e-2 : n % 3 == 1 ? 1e-4 : 0.0; // at the edges too
            Vector3 position(random.between(-spread, spread), random.between(-spread, spread), 0.0);
            position.z() = n % 2 == 0 ? random.between(0.05, 0.99) * reach : random.between(-0.5, 0.0) * reach;
            CAPTURE(position.transpose());
            // what is deep was above before, a little beside
            const Vector3 last(position.x() + random.between(-1e-4, 1e-4), position.y() + random.between(-1e-4, 1e-4),
                               reach);
            const SolidContact contact = met(*floor.shape, position, position.z() > 0.0 && n % 4 == 0 ? nowhere : last);
            const double overlap = reach - position.z();
            CHECK((contact.exit.move - overlap * Vector3::UnitZ()).norm() < tolerance);
            CHECK(contact.exit.normal_force_factor() == doctest::Approx(1.0).epsilon(1e-6));
        }
    }
}

TEST_CASE("two faces of a slight valley push no harder than one")
{
    const double slope = 0.02;
    const Shape valley = heightfield(0.04, 8, [&](double x, double) { return slope * std::abs(x); });
    const double upright = std::hypot(1.0, slope); // height above a slope over the distance from it
    RandomPlaces random;
    for (int n = 0; n < 100; ++n) {
        const double distance = random.between(0.1, 0.95) * reach;
        const SolidContact contact = met(*valley, {0.0, random.between(-0.01, 0.01), distance * upright});
        // By symmetry the exit is upright, to where both slopes are at the reach.
        CHECK((contact.exit.move - (reach - distance) * upright * Vector3::UnitZ()).norm() < tolerance);
    }
}

TEST_CASE("a convex edge or vertex pushes along the line from it, whatever the solid is made of")
{
    const Vector3 low = Vector3::Constant(-wall);
    const std::vector<NamedShape> shapes{
        {"box", box(low, Vector3::Zero())},
        {"mesh", mesh(box_facets(low, Vector3::Zero()))},
        {"union",
         boolean("union", {box(low, Vector3::Zero()), box(low - Vector3::UnitX(), Vector3::Constant(-0.01))})}};
    for (const NamedShape& shape : shapes) {
        CAPTURE(shape.name);
        RandomPlaces random;
        for (int n = 0; n < 200; ++n) {
            Vector3 position = random.inside(0.1, 1.0).normalized() * random.between(0.2, 0.99) * reach;
            if (n % 2 == 1)
                position.z() = -0.02; // beside an edge
            const Vector3 from_edge = n % 2 == 1 ? Vector3(position.x(), position.y(), 0.0) : position;
            const SolidContact contact = met(*shape.shape, position);
            CHECK((contact.exit.move - (reach - from_edge.norm()) * from_edge.normalized()).norm() < tolerance);
        }
    }
}

TEST_CASE("a thin plate pushes back to the side from which a point came, until the point comes out behind")
{
    const double thickness = 2e-3;
    const std::vector<NamedShape> plates{
        {"box", box({-0.04, -0.04, -thickness}, {0.04, 0.04, 0.0})},
        {"boxes side by side", boolean("union", {box({-0.04, -0.04, -thickness}, {0.0, 0.04, 0.0}),
                                                 box({0.0, -0.04, -thickness}, {0.04, 0.04, 0.0})})},
        {"bottom of a container", boolean("difference", {box({-0.04, -0.04, -thickness}, {0.04, 0.04, 0.04}),
                                                         box({-0.03, -0.03, 0.0}, {0.03, 0.03, 0.08})})}};
    for (const NamedShape& plate : plates) {
        CAPTURE(plate.name);
        Vector3 last = nowhere;
        int pushed = 0;
        for (double z = 1.2 * reach; z > -thickness; z -= 0.013 * reach, ++pushed) {
            const Vector3 position(0.01 + 0.1 * z, 0.002, z);
            const SolidContact contact = met(*plate.shape, position, last);
            CHECK((contact.exit.move - std::max(0.0, reach - z) * Vector3::UnitZ()).norm() < tolerance);
            REQUIRE_FALSE(contact.crossed);
            last = contact.free_position;
        }
        CHECK(pushed > 100);
        const SolidContact behind = met(*plate.shape, {0.01, 0.002, -thickness - 1e-5}, last);
        CHECK(behind.crossed);
        CHECK(behind.exit.faces == 0);
        CHECK(behind.free_position.z() < -thickness);
    }
}

TEST_CASE("a leap over a plate within one step is seen, one past its edge is none")
{
    const Shape plate = box({-0.04, -0.04, -2e-3}, {0.04, 0.04, 0.0});
    CHECK(met(*plate, {0.01, 0.0, -0.02}, {0.0, 0.0, 0.03}).crossed);
    CHECK(met(*plate, {0.01, 0.0, -4e-3}, {0.0, 0.0, 0.03}).crossed); // within the reach of its other side
    CHECK(met(*plate, {0.03, 0.0, 0.03}, {-0.03, 0.0, -0.03}).crossed);
    const SolidContact past = met(*plate, {0.06, 0.0, -0.03}, {0.048, 0.0, 0.03});
    CHECK_FALSE(past.crossed);
    CHECK(past.exit.faces == 0);
    CHECK(past.free_position == Vector3(0.06, 0.0, -0.03));
    const SolidContact sunk = met(*plate, {0.01, 0.0, -1.9e-3}, {0.01, 0.0, 0.02}); // in one step, and not through
    CHECK_FALSE(sunk.crossed);
    CHECK((sunk.exit.move - (reach + 1.9e-3) * Vector3::UnitZ()).norm() < tolerance);
}

TEST_CASE("the nearest piece is as far away as the surface, and the others are pieces beyond it")
{
    std::vector<NamedShape> shapes = solid_corners();
    shapes.push_back({"box", box(Vector3::Zero(), Vector3(0.2, 0.1, 0.1))});
    shapes.push_back({"terrain", heightfield(0.1, 4, [](double x, double y) { return 0.3 * std::abs(x) - 0.1 * y; })});
    RandomPlaces random;
    for (const NamedShape& named : shapes) {
        CAPTURE(named.name);
        int found = 0;
        for (int n = 0; n < 500; ++n) {
            const Vector3 position = random.inside(-0.1, 0.25);
            Vector3 normal;
            const double distance = named.shape->signed_distance(position, normal);
            if (distance <= 0.0)
                continue;
            SurfacePieces pieces;
            named.shape->find_pieces(position, 0.06, pieces);
            if (distance >= 0.06) {
                CHECK(pieces.empty());
                continue;
            }
            double nearest = 1.0;
            for (const SurfacePiece& piece : pieces) {
                nearest = std::min(nearest, piece.distance);
                CHECK(piece.distance < 0.06);
                CHECK(piece.normal.norm() == doctest::Approx(1.0).epsilon(1e-12));
            }
            CHECK(nearest == doctest::Approx(distance).epsilon(1e-10));
            ++found;
        }
        CHECK(found > 20);
    }
}
