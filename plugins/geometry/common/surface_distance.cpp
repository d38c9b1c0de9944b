// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest of many triangles, by CGAL's search tree.
#include "surface_distance.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace periporo::geometry {

namespace {

/// A distance is rounded anyway, and twice as fast found in plain doubles as with exact decisions on the way.
using PlainKernel = CGAL::Simple_cartesian<double>;
using PlainTriangle = PlainKernel::Triangle_3;

PlainKernel::Point_3 plain_point(const Vector3& position)
{
    return {position.x(), position.y(), position.z()};
}

std::vector<PlainTriangle> plain_triangles(const Mesh& mesh)
{
    std::vector<PlainTriangle> triangles;
    triangles.reserve(mesh.number_of_faces());
    for (const Mesh::Face_index face : mesh.faces()) {
        const auto [a, b, c] = corners(mesh, face);
        triangles.emplace_back(plain_point(a), plain_point(b), plain_point(c));
    }
    return triangles;
}

Vector3 normal_of(const PlainTriangle& triangle)
{
    const Vector3 a = vector(triangle[0]);
    return (vector(triangle[1]) - a).cross(vector(triangle[2]) - a).normalized();
}

double largest_coordinate(const Mesh& mesh)
{
    const Bounds bounds = bounds_of(mesh);
    return std::max(bounds.lower.lpNorm<Eigen::Infinity>(), bounds.upper.lpNorm<Eigen::Infinity>());
}

} // namespace

struct SurfaceDistance::Search {
    using Primitive = CGAL::AABB_triangle_primitive<PlainKernel, std::vector<PlainTriangle>::const_iterator>;

    explicit Search(const Mesh& mesh) : triangles(plain_triangles(mesh)), tree(triangles.cbegin(), triangles.cend())
    {
        // Now, so that no question waits for what it would build.
        tree.build();
        tree.accelerate_distance_queries();
    }

    std::vector<PlainTriangle> triangles;
    CGAL::AABB_tree<CGAL::AABB_traits<PlainKernel, Primitive>> tree;
};

SurfaceDistance::SurfaceDistance(const Mesh& mesh)
    : size_(largest_coordinate(mesh)), search_(std::make_unique<Search>(mesh))
{
}

SurfaceDistance::~SurfaceDistance() = default;

SignedDistance SurfaceDistance::at(const Vector3& position, bool inside) const
{
    const auto [point, triangle] = search_->tree.closest_point_and_primitive(plain_point(position));
    const Vector3 offset = position - vector(point);
    const double distance = offset.norm();
    const double sign = inside ? -1.0 : 1.0;
    // Nearer than this much of the offset is rounding.
    const bool at_surface = distance <= std::sqrt(std::numeric_limits<double>::epsilon()) * size_;
    return {sign * distance, at_surface ? normal_of(*triangle) : Vector3(sign / distance * offset)};
}

} // namespace periporo::geometry
