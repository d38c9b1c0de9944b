// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A body bounded by triangles: what lies inside, how far away its surface is, how large and how heavy it is.
#pragma once

#include "common/surface_distance.hpp"
#include "common/triangle_mesh.hpp"

#include <memory>

namespace periporo::geometry {

/// A body of density 1.
struct VolumeMoments {
    double volume = 0.0;                               ///< [m3]
    Vector3 centre = Vector3::Zero();                  ///< of mass [m]
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); ///< tensor of inertia about the centre [m5]
};

/// The body bounded by a triangle mesh. Its calls are safe from several threads at once.
class ClosedMesh {
public:
    /// @param mesh closed, of triangles that are not degenerate and meet in common edges and corners only; the
    /// corners of each run counter-clockwise as seen from outside the body
    explicit ClosedMesh(Mesh mesh);
    ~ClosedMesh();
    ClosedMesh(const ClosedMesh&) = delete;
    ClosedMesh& operator=(const ClosedMesh&) = delete;

    /// True inside and on the surface, decided exactly.
    bool contains(const Vector3& position) const;
    const Bounds& bounds() const { return bounds_; }
    const VolumeMoments& moments() const { return moments_; }
    double volume() const { return moments_.volume; }
    /// See SurfaceDistance.
    SignedDistance signed_distance(const Vector3& position) const { return distance_.at(position, contains(position)); }
    /// See SurfaceDistance.
    void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const
    {
        distance_.find_pieces(position, reach, pieces);
    }

private:
    struct Search;

    Mesh mesh_;
    Bounds bounds_;
    VolumeMoments moments_;
    SurfaceDistance distance_;
    std::unique_ptr<const Search> search_;
};

} // namespace periporo::geometry
