// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shortest way of a point out of reach of a rigid solid, along all faces that are in its way.
#pragma once

#include "periporo/geometry.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace periporo {

/// The shortest move u that takes a point out of reach. The overlap of the contact is |u|, and its reaction is along u:
/// as |u| is the distance from a set of places, every law keeps energy in concave corners too. At one face u is along
/// its normal. At a right angle between two faces a linear law gives each face the force of its own overlap.
struct WayOut {
    Vector3 move = Vector3::Zero();    ///< u = sum of shares times normals [m]
    std::size_t faces = 0;             ///< that take part, 3 at most; none: the point is out of reach
    std::array<Vector3, 3> normals;    ///< of these faces, unit vectors to the free side
    std::array<double, 3> shares = {}; ///< not negative [m]

    /// Sum of the normal forces on the faces for a reaction of 1 N along u; 1 at one face [-].
    double pressing() const;
};

/// A face in the way: normal . move >= least [m].
struct FaceLimit {
    Vector3 normal;
    double least;
};

/// Finds the shortest move that satisfies all limits, each to the tolerance [m]. False when no move does.
bool find_shortest_move(std::span<const FaceLimit> limits, double tolerance, WayOut& way);

/// A point and a solid.
struct SolidMeeting {
    WayOut way;
    /// The nearest place from which the point would not touch; its own position when it does not [m].
    Vector3 free_place = Vector3::Zero();
    /// The point has been through the solid and out at another side. There is no way out to that side.
    bool crossed = false;
};

/// What a solid does to a point that comes from `last_free`.
/// A point that lies deep inside has the nearest way out to the side from which it came, not the side that it is
/// nearest to: so a thin plate pushes it back until it comes out behind.
/// @param distance of the position, and `normal` its direction, as Geometry::signed_distance() answers [m]
/// @param reach the distance at which the point does not touch [m], above 0
/// @param last_free free_place of the last meeting [m]; not a number when there was none
SolidMeeting meet(const Geometry& geometry, const Vector3& position, double distance, const Vector3& normal,
                  double reach, const Vector3& last_free);

/// The meeting with the nearest face alone.
SolidMeeting meet_nearest(const Vector3& position, double distance, const Vector3& normal, double reach);

} // namespace periporo
