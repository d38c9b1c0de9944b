// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What kind of contact an assignment is, and the rigid surface of those that have one.
#pragma once

#include "contact/contact_forces.hpp"

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
        : obstacle_(assignment.obstacle ? &model.obstacles[*assignment.obstacle] : nullptr),
          own_(assignment.law->surface())
    {
    }

    bool present() const { return obstacle_ == nullptr || obstacle_->present; }
    Vector3 velocity() const { return obstacle_ == nullptr ? Vector3(Vector3::Zero()) : obstacle_->velocity; }
    double distance(const Vector3& position, Vector3& normal) const
    {
        return obstacle_ == nullptr ? own_->distance(position, normal) : obstacle_->distance(position, normal);
    }
    bool is_near(const Vector3& position, double reach) const
    {
        Vector3 normal;
        return (obstacle_ == nullptr || obstacle_->may_touch(position, reach)) && distance(position, normal) < reach;
    }

private:
    const Obstacle* obstacle_;
    const RigidSurface* own_;
};

} // namespace periporo
