// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The body bounded by triangles: moments, exact containment, distance.
#include "geometry/common/closed_mesh.hpp"

#include "geometry/common/exact.hpp"
#include "polyhedra.hpp"
#include "shape_checks.hpp"

#include <doctest/doctest.h>

#include <random>
#include <thread>

namespace {

using namespace periporo;
using geometry::ClosedMesh;
using test::Polyhedron;

geometry::Mesh mesh_of(const Polyhedron& body)
{
    geometry::Mesh mesh;
    std::vector<geometry::Mesh::Vertex_index> corners;
    for (const Vector3& point : body.points)
        corners.push_back(mesh.add_vertex(geometry::mesh_point(point)));
    for (const auto& [a, b, c] : body.triangles)
        mesh.add_face(corners[a], corners[b], corners[c]);
    return mesh;
}

/// Turned and moved, so that no coordinate is a round number.
Polyhedron crooked(Polyhedron body)
{
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    for (Vector3& point : body.points)
        point = Vector3(0.3, -0.2, 0.1) + rotation * point;
    return body;
}

/// Whether a place lies in a convex body, by exact arithmetic on its coordinates.
bool convex_contains(const Polyhedron& body, const Vector3& place)
{
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        const auto [a, b, c] = body.corners(t);
        using geometry::exact_point;
        if (CGAL::orientation(exact_point(a), exact_point(b), exact_point(c), exact_point(place)) == CGAL::POSITIVE)
            return false;
    }
    return true;
}

/// A random place in a triangle, rounded, so that it lies on it or the least bit to one of its sides.
Vector3 place_in(const std::array<Vector3, 3>& triangle, std::mt19937& generator)
{
    std::uniform_real_distribution<double> part(0.0, 1.0);
    const double u = part(generator);
    const double v = part(generator) * (1.0 - u);
    return (1.0 - u - v) * triangle[0] + u * triangle[1] + v * triangle[2];
}

void check_symmetric(const Eigen::Matrix3d& inertia, double expected)
{
    // The sums have a few hundred terms at most.
    CHECK((inertia - expected * Eigen::Matrix3d::Identity()).norm() < 1e-14 * expected);
}

} // namespace

TEST_CASE("a block has the volume, centre and inertia of a block")
{
    const ClosedMesh mesh(mesh_of(test::block({1.0, 2.0, 3.0}, {2.0, 4.0, 0.5})));
    const geometry::VolumeMoments& moments = mesh.moments();
    CHECK(moments.volume == 4.0); // in round binary numbers nothing is rounded
    CHECK(moments.centre == Vector3(2.0, 4.0, 3.25));
    // m (b^2 + c^2)/12
    const Vector3 expected = 4.0 / 12.0 * Vector3(16.25, 4.25, 20.0);
    CHECK((moments.inertia.diagonal() - expected).norm() < 1e-15 * expected.norm());
    CHECK(std::abs(moments.inertia(0, 1)) + std::abs(moments.inertia(1, 2)) + std::abs(moments.inertia(2, 0)) < 1e-14);
}

TEST_CASE("a tetrahedron with right angles at a corner has the moments of its closed form")
{
    const double a = 1.0;
    const double b = 2.0;
    const double c = 3.0;
    const ClosedMesh mesh(mesh_of(test::right_tetrahedron({0.0, 0.0, 0.0}, {a, b, c})));
    const geometry::VolumeMoments& moments = mesh.moments();
    const double volume = a * b * c / 6.0;
    const double rounding = 1e-15;
    CHECK(moments.volume == doctest::Approx(volume).epsilon(rounding).scale(0.0));
    CHECK((moments.centre - Vector3(a, b, c) / 4.0).norm() < 4 * rounding);
    // About the right angle the integrals of x^2 are V a^2/10 and of x y are V a b/20.
    const Vector3 edges(a, b, c);
    Eigen::Matrix3d second = volume / 20.0 * edges * edges.transpose();
    second.diagonal() *= 2.0;
    second -= volume / 16.0 * edges * edges.transpose(); // to the centre
    const Eigen::Matrix3d inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
    CHECK((moments.inertia - inertia).norm() < 10 * rounding);
}

TEST_CASE("an icosahedron has its volume and inertia, crooked or not")
{
    // With edges of length s: V = 5 (3 + sqrt 5) s^3/12 and I = phi^2 m s^2/10.
    const double s = 1.0 / std::sin(2.0 * std::numbers::pi / 5.0);
    const double volume = 5.0 * (3.0 + std::sqrt(5.0)) / 12.0 * s * s * s;
    const double inertia = std::numbers::phi * std::numbers::phi / 10.0 * volume * s * s;
    for (const Polyhedron& body : {test::icosahedron(), crooked(test::icosahedron())}) {
        const ClosedMesh mesh(mesh_of(body));
        CHECK(mesh.volume() == doctest::Approx(volume).epsilon(1e-15).scale(0.0));
        check_symmetric(mesh.moments().inertia, inertia);
    }
}

TEST_CASE("an icosphere has the volume of the pyramids from its centre to its facets")
{
    const Polyhedron body = test::icosphere(3);
    long double volume = 0.0L;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        const auto [a, b, c] = body.corners(t);
        const Vector3 doubled_area = (b - a).cross(c - a);
        volume += doubled_area.norm() / 6.0 * a.dot(doubled_area.normalized()); // area x height/3
    }
    const ClosedMesh mesh(mesh_of(body));
    CHECK(mesh.volume() == doctest::Approx(static_cast<double>(volume)).epsilon(1e-14).scale(0.0));
    CHECK(mesh.moments().centre.norm() < 1e-15);
}

TEST_CASE("coordinates of a map do not take the digits of volume and inertia")
{
    const ClosedMesh mesh(mesh_of(test::block({452000.0, 5412000.0, 300.0}, {1.0, 2.0, 4.0})));
    CHECK(mesh.volume() == 8.0);
    CHECK(mesh.moments().centre == Vector3(452000.5, 5412001.0, 302.0));
    CHECK(mesh.moments().inertia(2, 2) == doctest::Approx(8.0 * 5.0 / 12.0).epsilon(1e-15).scale(0.0));
}

TEST_CASE("a cavity counts against the body around it")
{
    Polyhedron body = test::block({0.0, 0.0, 0.0}, {4.0, 4.0, 4.0});
    Polyhedron cavity = test::block({1.0, 1.0, 1.0}, {1.0, 2.0, 1.0});
    cavity.turn_inside_out();
    body.add(cavity);
    const ClosedMesh mesh(mesh_of(body));
    CHECK(mesh.volume() == 62.0);
    CHECK(mesh.contains({0.5, 0.5, 0.5}));
    CHECK_FALSE(mesh.contains({1.5, 1.5, 1.5}));
    CHECK(mesh.contains({1.0, 1.5, 1.5})); // its wall
    const geometry::SignedDistance distance = mesh.signed_distance({1.25, 2.0, 1.5});
    CHECK(distance.value == 0.25);
    CHECK(distance.outward == Vector3(1.0, 0.0, 0.0)); // into the cavity, away from the wall
}

TEST_CASE("the bounds are those of the corners")
{
    const ClosedMesh mesh(mesh_of(test::block({-1.0, 2.0, 0.1}, {0.5, 0.25, 0.2})));
    CHECK(mesh.bounds().lower == Vector3(-1.0, 2.0, 0.1));
    CHECK(mesh.bounds().upper == Vector3(-0.5, 2.25, 0.1 + 0.2));
}

TEST_CASE("corners, edges and facets belong to the body, and nothing a rounding step outside")
{
    const ClosedMesh mesh(mesh_of(test::block({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0})));
    const std::array<double, 5> levels{0.0, 0.25, 0.5, 0.75, 1.0}; // edges and diagonals among them
    for (const double x : levels)
        for (const double y : levels)
            for (const double z : levels)
                CHECK(mesh.contains({x, y, z}));
    for (int axis = 0; axis < 3; ++axis)
        for (const double u : levels)
            for (const double v : levels)
                for (const double outside : {-std::numeric_limits<double>::denorm_min(), test::just_above(1.0)}) {
                    Vector3 place;
                    place[axis] = outside;
                    place[(axis + 1) % 3] = u;
                    place[(axis + 2) % 3] = v;
                    CHECK_FALSE(mesh.contains(place));
                }
}

TEST_CASE("no place that is not finite is contained")
{
    const ClosedMesh mesh(mesh_of(test::icosahedron()));
    CHECK_FALSE(mesh.contains({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}));
    CHECK_FALSE(mesh.contains({0.0, std::numeric_limits<double>::infinity(), 0.0}));
    CHECK_FALSE(mesh.contains({0.0, 0.0, -std::numeric_limits<double>::infinity()}));
}

TEST_CASE("within a rounding of the surface containment is that of exact arithmetic")
{
    const Polyhedron body = crooked(test::icosphere(2));
    const ClosedMesh mesh(mesh_of(body));
    std::mt19937 generator(11);
    int inside = 0;
    int count = 0;
    const auto check = [&](const Vector3& place) {
        const bool expected = convex_contains(body, place);
        CHECK(mesh.contains(place) == expected);
        inside += expected ? 1 : 0;
        ++count;
    };
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        const auto [a, b, c] = body.corners(t);
        for (int i = 0; i < 5; ++i)
            check(place_in({a, b, c}, generator));
        check((a + b) / 2.0); // on an edge, but for rounding
        CHECK(mesh.contains(a));
    }
    // The places must have fallen to both sides for this to tell anything.
    CHECK(inside > count / 4);
    CHECK(inside < 3 * count / 4);
}

TEST_CASE("containment in a ring is told by its winding number")
{
    const Polyhedron body = crooked(test::ring(0.4, 12));
    const ClosedMesh mesh(mesh_of(body));
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> coordinate(-1.7, 1.7);
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vector3 place(coordinate(generator), coordinate(generator), coordinate(generator));
        const bool expected = test::winding_number(body, place) > 0.5;
        CHECK(mesh.contains(place) == expected);
        inside += expected ? 1 : 0;
    }
    CHECK(inside > 150); // the ring fills about a fourteenth of the cube
}

TEST_CASE("the distance is that from the nearest of all triangles, and the normal leads away from there")
{
    const Polyhedron body = crooked(test::ring(0.4, 12));
    const ClosedMesh mesh(mesh_of(body));
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> coordinate(-2.5, 2.5);
    const double rounding = 1e-14; // of lengths up to 5
    for (int i = 0; i < 1000; ++i) {
        const Vector3 place(coordinate(generator), coordinate(generator), coordinate(generator));
        const auto [distance, normal] = mesh.signed_distance(place);
        CHECK(std::abs(distance) == doctest::Approx(test::distance_from_surface(body, place)).epsilon(rounding));
        CHECK((distance < 0.0) == (test::winding_number(body, place) > 0.5));
        CHECK(normal.norm() == doctest::Approx(1.0).epsilon(rounding));
        CHECK(test::distance_from_surface(body, place - distance * normal) < 1e-13); // with the rounding of the normal
    }
}

TEST_CASE("at the surface the distance vanishes and the normal is that of the facet")
{
    const Polyhedron body = crooked(test::icosphere(1));
    const ClosedMesh mesh(mesh_of(body));
    std::mt19937 generator(17);
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        const auto [a, b, c] = body.corners(t);
        // Inside the facet, where no other is as near.
        const Vector3 middle = (a + b + c) / 3.0;
        const Vector3 place = middle + 0.5 * (place_in({a, b, c}, generator) - middle);
        const auto [distance, normal] = mesh.signed_distance(place);
        CHECK(std::abs(distance) < 1e-15);
        CHECK((normal - (b - a).cross(c - a).normalized()).norm() < 1e-14);
    }
}

TEST_CASE("outside a corner and an edge the normal leads away from them")
{
    const ClosedMesh mesh(mesh_of(test::block({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0})));
    const geometry::SignedDistance corner = mesh.signed_distance({3.0, 3.0, 2.0}); // 2, 2 and 1 away
    CHECK(corner.value == 3.0);
    CHECK((corner.outward - Vector3(2.0, 2.0, 1.0) / 3.0).norm() < 1e-15);
    const geometry::SignedDistance edge = mesh.signed_distance({-3.0, 0.5, -4.0});
    CHECK(edge.value == 5.0);
    CHECK((edge.outward - Vector3(-0.6, 0.0, -0.8)).norm() < 1e-15);
}

TEST_CASE("threads that ask at once get the answers that one gets")
{
    const ClosedMesh mesh(mesh_of(crooked(test::ring(0.4, 24))));
    std::mt19937 generator(23);
    std::uniform_real_distribution<double> coordinate(-1.7, 1.7);
    std::vector<Vector3> places(4000);
    for (Vector3& place : places)
        place = Vector3(coordinate(generator), coordinate(generator), coordinate(generator));
    const auto ask = [&](std::vector<double>& answers) {
        for (const Vector3& place : places) {
            const auto [distance, normal] = mesh.signed_distance(place);
            answers.insert(answers.end(), {mesh.contains(place) ? 1.0 : 0.0, distance, normal.sum()});
        }
    };
    std::array<std::vector<double>, 4> answers;
    {
        std::vector<std::jthread> threads;
        for (std::vector<double>& of_thread : answers)
            threads.emplace_back([&] { ask(of_thread); });
    }
    std::vector<double> expected;
    ask(expected);
    for (const std::vector<double>& of_thread : answers)
        CHECK(of_thread == expected);
}
