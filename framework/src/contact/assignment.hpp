// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What kind of contact an assignment is, and the rigid surface of those that have one.
#pragma once

#include "contact/contact_forces.hpp"
#include "contact/way_out.hpp"

#include <algorithm>

namespace periporo {

inline bool names(const ContactAssignment& assignment, std::uint32_t body)
{
    return std::find(assignment.bodies.begin(), assignment.bodies.end(), body) != assignment.bodies.end();
}

inline bool at_rigid_surface(const ContactAssignment& assignment)
{
    return assignment.obstacle || assignment.law->surface() != nullptr;
}

inline bool within_one_body(const ContactAssignment& assignment)
{
    return assignment.bodies.size() == 2 && assignment.bodies[0] == assignment.bodies[1];
}

inline bool between_points_of_two_bodies(const ContactAssignment& assignment)
{
    return !at_rigid_surface(assignment) && !assignment.surface_body && !within_one_body(assignment);
}

/// The obstacle or the law's own surface, whichever the assignment has.
class RigidContactSurface {
public:
    RigidContactSurface(const Model& model, const ContactAssignment& assignment)
        : obstacle_(assignment.obstacle ? &model.state.obstacles[*assignment.obstacle] : nullptr),
          own_(assignment.law->surface())
    {
    }

    bool present() const { return obstacle_ == nullptr || obstacle_->present; }
    Vector3 velocity() const { return obstacle_ == nullptr ? Vector3(Vector3::Zero()) : obstacle_->velocity; }
    double distance(const Vector3& position, Vector3& normal) const
    {
        return obstacle_ == nullptr ? own_->distance(position, normal) : obstacle_->distance(position, normal);
    }
    /// What the surface does to a point that comes from `last_free`: see meet(). Both places are those of an obstacle
    /// that has not moved yet; a plugin's own surface has one face, and pushes to any depth.
    SolidMeeting meeting(const Vector3& position, double distance, const Vector3& normal, double reach,
                         const Vector3& last_free) const
    {
        return obstacle_ == nullptr ? meet_nearest(position, distance, normal, reach)
                                    : meet(*obstacle_->geometry, position, distance, normal, reach, last_free);
    }
    /// How far the surface has moved [m].
    Vector3 shift() const { return obstacle_ == nullptr ? Vector3(Vector3::Zero()) : obstacle_->shift; }
    /// May several faces push a point at once that lies nearer than `reach` to them [m]?
    bool may_hold_in_corner(const Vector3& position, double reach) const
    {
        if (obstacle_ == nullptr || !obstacle_->geometry->has_pieces())
            return false;
        SurfacePieces pieces;
        obstacle_->geometry->find_pieces(position - obstacle_->shift, reach, pieces);
        return pieces.size() > 1;
    }
    /// @param place of a point, as an obstacle lies in its geometry [m]
    bool is_near(const Vector3& place, double reach) const
    {
        Vector3 normal;
        if (obstacle_ == nullptr)
            return own_->distance(place, normal) < reach;
        return may_touch(obstacle_->geometry->bounds(), place, reach) &&
               obstacle_->geometry->signed_distance(place, normal) < reach;
    }

private:
    /// May a place be nearer than `reach` to what lies within the bounds? False is certain.
    static bool may_touch(const Bounds& bounds, const Vector3& place, double reach)
    {
        return ((place - bounds.upper).array() < reach).all() && ((bounds.lower - place).array() < reach).all();
    }

    const Obstacle* obstacle_;
    const RigidSurface* own_;
};

} // namespace periporo
