// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How far away a surface of triangles is, and in which direction.
#pragma once

#include "common/distance.hpp"
#include "common/triangle_mesh.hpp"

#include "periporo/geometry.hpp"

#include <memory>

namespace periporo::geometry {

/// Finds the nearest of many triangles. Its calls are safe from several threads at once.
class SurfaceDistance {
public:
    /// @param mesh see ClosedMesh
    explicit SurfaceDistance(const Mesh& mesh);
    ~SurfaceDistance();
    SurfaceDistance(const SurfaceDistance&) = delete;
    SurfaceDistance& operator=(const SurfaceDistance&) = delete;

    /// See Geometry::signed_distance(). At the surface itself `outward` is the normal of a facet there.
    /// @param inside whether the position is in the body, which the nearest triangle alone does not tell
    SignedDistance at(const Vector3& position, bool inside) const;
    /// Adds all triangles nearer than `reach` [m], as seen from the side of them that the position is on.
    void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const;

private:
    struct Search;

    double size_; ///< of the largest coordinate [m]
    std::unique_ptr<const Search> search_;
};

} // namespace periporo::geometry
