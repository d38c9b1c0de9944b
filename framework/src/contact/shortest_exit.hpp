// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shortest move that takes a point out of reach of a rigid solid, past all faces that obstruct it.
#pragma once

#include "periporo/geometry.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace periporo {

/// The shortest move u that takes a point out of reach. The overlap of the contact is |u|, and its reaction is along u:
/// as |u| is the distance from a set of places, every law keeps energy in concave corners too. At one face u is along
/// its normal. At a right angle between two faces a linear law gives each face the force of its own overlap.
struct ShortestExit {
    Vector3 move = Vector3::Zero();    ///< u = sum of shares times normals [m]
    std::size_t faces = 0;             ///< that take part, 3 at most; none: the point is out of reach
    std::array<Vector3, 3> normals;    ///< of these faces, unit vectors to the free side
    std::array<double, 3> shares = {}; ///< not negative [m]

    /// Sum of the normal forces on the faces for a reaction of 1 N along u; 1 at one face [-].
    double normal_force_factor() const;
};

/// A limit that a face sets to a move: normal . move >= least [m].
struct FaceLimit {
    Vector3 normal;
    double least;
};

/// Finds the shortest move that satisfies all limits, each to the tolerance [m]. False when no move does.
bool find_shortest_exit(std::span<const FaceLimit> limits, double tolerance, ShortestExit& exit);

/// The contact of a point with a solid.
struct SolidContact {
    ShortestExit exit;
    /// The nearest position without contact; the position of the point when it does not touch [m].
    Vector3 free_position = Vector3::Zero();
    /// The point has passed through the solid and lies at another side of it. There is no exit to that side.
    bool crossed = false;
};

/// Finds the exit of a point that comes from `last_free_position`.
/// The exit of a point deep inside leads to the side from which it came, not to the nearest side: a thin plate so
/// pushes the point back until it has passed through.
/// @param distance of the position, and `normal` its direction, as Geometry::signed_distance() returns them [m]
/// @param reach the distance at which the point does not touch [m], above 0
/// @param last_free_position free_position of the last contact [m]; not a number when there was none
SolidContact find_exit(const Geometry& geometry, const Vector3& position, double distance, const Vector3& normal,
                       double reach, const Vector3& last_free_position);

/// Finds the exit past the nearest face alone.
SolidContact exit_at_nearest_face(const Vector3& position, double distance, const Vector3& normal, double reach);

} // namespace periporo
