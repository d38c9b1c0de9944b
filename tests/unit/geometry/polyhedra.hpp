// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies bounded by triangles for tests, and what brute force tells of them.
#pragma once

#include "periporo/tensor.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace periporo::test {

/// Triangles by their corners, counter-clockwise as seen from outside.
struct Polyhedron {
    std::vector<Vector3> points;
    std::vector<std::array<std::size_t, 3>> triangles;

    std::array<Vector3, 3> corners(std::size_t triangle) const
    {
        const auto& [a, b, c] = triangles[triangle];
        return {points[a], points[b], points[c]};
    }
    void add(const Polyhedron& other)
    {
        const std::size_t first = points.size();
        points.insert(points.end(), other.points.begin(), other.points.end());
        for (const auto& [a, b, c] : other.triangles)
            triangles.push_back({first + a, first + b, first + c});
    }
    void turn_inside_out()
    {
        for (auto& triangle : triangles)
            std::swap(triangle[1], triangle[2]);
    }
};

/// Corner i lies at the upper end of x, y, z when bits 0, 1, 2 of i are set.
inline Polyhedron block(const Vector3& lower, const Vector3& size)
{
    Polyhedron body;
    for (int i = 0; i < 8; ++i)
        body.points.push_back(lower + Vector3(i & 1, (i >> 1) & 1, (i >> 2) & 1).cwiseProduct(size));
    body.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return body;
}

/// With right angles at the corner and edges a, b, c along x, y, z.
inline Polyhedron right_tetrahedron(const Vector3& corner, const Vector3& edges)
{
    Polyhedron body;
    body.points = {corner, corner + Vector3(edges.x(), 0.0, 0.0), corner + Vector3(0.0, edges.y(), 0.0),
                   corner + Vector3(0.0, 0.0, edges.z())};
    body.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return body;
}

/// The icosahedron with its corners on the unit sphere.
inline Polyhedron icosahedron()
{
    Polyhedron body;
    const double g = std::numbers::phi;
    body.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Vector3& point : body.points)
        point.normalize();
    body.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return body;
}

/// The icosahedron with every triangle divided into four, `levels` times, all corners on the unit sphere. It is convex.
inline Polyhedron icosphere(int levels)
{
    Polyhedron body = icosahedron();
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
        const auto middle = [&](std::size_t a, std::size_t b) {
            const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), body.points.size());
            if (is_new)
                body.points.push_back((body.points[a] + body.points[b]).normalized());
            return entry->second;
        };
        std::vector<std::array<std::size_t, 3>> finer;
        for (const auto& [a, b, c] : body.triangles) {
            const std::size_t ab = middle(a, b);
            const std::size_t bc = middle(b, c);
            const std::size_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        body.triangles = std::move(finer);
    }
    return body;
}

/// A ring about z with its middle line at radius 1 and a cross-section of `radius`, count x count quadrangles in two
/// triangles each.
inline Polyhedron ring(double radius, std::size_t count)
{
    Polyhedron body;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) {
            const double around = static_cast<double>(i) * step;
            const double within = static_cast<double>(j) * step;
            const double reach = 1.0 + radius * std::cos(within);
            body.points.emplace_back(reach * std::cos(around), reach * std::sin(around), radius * std::sin(within));
        }
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) {
            const std::size_t next_i = (i + 1) % count;
            const std::size_t next_j = (j + 1) % count;
            const std::size_t a = i * count + j;
            const std::size_t b = next_i * count + j;
            const std::size_t c = next_i * count + next_j;
            const std::size_t d = i * count + next_j;
            body.triangles.insert(body.triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return body;
}

/// How often the surface goes around a place: 1 inside, 0 outside. The solid angles of the triangles are those of
/// A. van Oosterom and J. Strackee, IEEE Transactions on Biomedical Engineering 30 (1983) 125-126.
inline double winding_number(const Polyhedron& body, const Vector3& place)
{
    double angle = 0.0;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        auto [a, b, c] = body.corners(t);
        a -= place, b -= place, c -= place;
        const double la = a.norm();
        const double lb = b.norm();
        const double lc = c.norm();
        angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle / (4.0 * std::numbers::pi);
}

inline double distance_from_segment(const Vector3& place, const Vector3& a, const Vector3& b)
{
    const Vector3 edge = b - a;
    const double along = std::clamp((place - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    return (place - a - along * edge).norm();
}

inline double distance_from_triangle(const Vector3& place, const std::array<Vector3, 3>& triangle)
{
    const auto& [a, b, c] = triangle;
    Eigen::Matrix3d axes;
    axes << b - a, c - a, (b - a).cross(c - a);
    const Vector3 parts = axes.inverse() * (place - a);
    if (parts.x() >= 0.0 && parts.y() >= 0.0 && parts.x() + parts.y() <= 1.0)
        return std::abs(parts.z()) * axes.col(2).norm();
    return std::min(
        {distance_from_segment(place, a, b), distance_from_segment(place, b, c), distance_from_segment(place, c, a)});
}

/// From the nearest of all triangles.
inline double distance_from_surface(const Polyhedron& body, const Vector3& place)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < body.triangles.size(); ++t)
        nearest = std::min(nearest, distance_from_triangle(place, body.corners(t)));
    return nearest;
}

} // namespace periporo::test
