// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The body bounded by triangles, by the divergence theorem and by CGAL's search tree.
#include "closed_mesh.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <Eigen/Geometry>

#include <array>
#include <utility>

namespace periporo::geometry {

namespace {

/// Sums over the tetrahedra between the facets and `middle`, from where far-away coordinates lose no digits. With
/// corners at 0, a, b, c a tetrahedron has the volume V = a.(b x c)/6, the first moment V (a + b + c)/4 and the second
/// V (a a + b b + c c + s s)/20 with s = a + b + c. What all terms have in common is divided by at the end.
VolumeMoments moments_of(const Mesh& mesh, const Vector3& middle)
{
    double volume = 0.0;
    Vector3 first = Vector3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const Mesh::Face_index face : mesh.faces()) {
        std::array<Vector3, 3> triangle = corners(mesh, face);
        for (Vector3& corner : triangle)
            corner -= middle;
        const auto& [a, b, c] = triangle;
        const Vector3 sum = a + b + c;
        const double sixfold = a.dot(b.cross(c));
        volume += sixfold;
        first += sixfold * sum;
        second += sixfold * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    volume /= 6.0;
    first /= 6.0 * 4.0;
    second /= 6.0 * 20.0;
    const Vector3 offset = first / volume;
    second -= volume * offset * offset.transpose();
    return {volume, middle + offset, second.trace() * Eigen::Matrix3d::Identity() - second};
}

} // namespace

/// Decides exactly.
struct ClosedMesh::Search {
    using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;

    explicit Search(const Mesh& mesh) : tree(faces(mesh).begin(), faces(mesh).end(), mesh), side(tree)
    {
        tree.build(); // now, so that no question waits for it
    }

    CGAL::AABB_tree<CGAL::AABB_traits<MeshKernel, Primitive>> tree;
    CGAL::Side_of_triangle_mesh<Mesh, MeshKernel> side;
};

ClosedMesh::ClosedMesh(Mesh mesh)
    : mesh_(std::move(mesh)), bounds_(bounds_of(mesh_)),
      moments_(moments_of(mesh_, 0.5 * (bounds_.lower + bounds_.upper))), distance_(mesh_),
      search_(std::make_unique<Search>(mesh_))
{
}

ClosedMesh::~ClosedMesh() = default;

bool ClosedMesh::contains(const Vector3& position) const
{
    return position.allFinite() && search_->side(mesh_point(position)) != CGAL::ON_UNBOUNDED_SIDE;
}

} // namespace periporo::geometry
