// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest of many triangles, by CGAL's search tree.
#include "surface_distance.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/iterator/function_output_iterator.hpp>

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

Vector3 nearest_on_segment(const Vector3& position, const Vector3& a, const Vector3& b)
{
    const Vector3 edge = b - a;
    return a + std::clamp((position - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
}

/// The place on a triangle that is nearest to a position.
Vector3 nearest_on(const PlainTriangle& triangle, const Vector3& position)
{
    const Vector3 corner[3] = {vector(triangle[0]), vector(triangle[1]), vector(triangle[2])};
    const Vector3 across = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    bool above = true;
    Vector3 nearest = Vector3::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Vector3& from = corner[k];
        const Vector3& to = corner[(k + 1) % 3];
        if (across.cross(to - from).dot(position - from) >= 0.0)
            continue;
        above = false;
        const Vector3 place = nearest_on_segment(position, from, to);
        if (const double distance = (position - place).squaredNorm(); distance < least)
            least = distance, nearest = place;
    }
    if (!above)
        return nearest;
    return position - (position - corner[0]).dot(across) / across.squaredNorm() * across;
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

void SurfaceDistance::find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const
{
    if (!(reach > 0.0))
        return;
    const double rounding = std::sqrt(std::numeric_limits<double>::epsilon()) * size_;
    const auto add = [&](const auto& triangle) {
        const Vector3 offset = position - nearest_on(*triangle, position);
        const double distance = offset.norm();
        if (distance < reach && distance > rounding)
            pieces.add(distance, offset / distance);
    };
    const Vector3 to_side = Vector3::Constant(reach);
    search_->tree.all_intersected_primitives(
        PlainKernel::Iso_cuboid_3(plain_point(position - to_side), plain_point(position + to_side)),
        boost::make_function_output_iterator(add));
}

} // namespace periporo::geometry
