// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The surface mesh of CGAL that the geometries made of triangles share.
#pragma once

#include "periporo/geometry.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <limits>

namespace periporo::geometry {

/// CGAL's kernel over doubles whose decisions are exact and whose constructed points are rounded.
using MeshKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using MeshPoint = MeshKernel::Point_3;
using Mesh = CGAL::Surface_mesh<MeshPoint>;

/// The coordinates of a point of any of CGAL's kernels over doubles.
template <class Kernel>
Vector3 vector(const CGAL::Point_3<Kernel>& point)
{
    return {point.x(), point.y(), point.z()};
}

inline MeshPoint mesh_point(const Vector3& position)
{
    return {position.x(), position.y(), position.z()};
}

/// In the order of the mesh.
inline std::array<Vector3, 3> corners(const Mesh& mesh, Mesh::Face_index triangle)
{
    std::array<Vector3, 3> positions;
    Mesh::Halfedge_index edge = mesh.halfedge(triangle);
    for (Vector3& corner : positions) {
        corner = vector(mesh.point(mesh.target(edge)));
        edge = mesh.next(edge);
    }
    return positions;
}

inline Bounds bounds_of(const Mesh& mesh)
{
    const double infinity = std::numeric_limits<double>::infinity();
    Bounds bounds{Vector3::Constant(infinity), Vector3::Constant(-infinity)};
    for (const Mesh::Vertex_index corner : mesh.vertices()) {
        bounds.lower = bounds.lower.cwiseMin(vector(mesh.point(corner)));
        bounds.upper = bounds.upper.cwiseMax(vector(mesh.point(corner)));
    }
    return bounds;
}

} // namespace periporo::geometry
