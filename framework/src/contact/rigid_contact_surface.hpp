// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rigid surface of a contact: an obstacle, or the surface that the law brings along.
#pragma once

#include "contact/assignment.hpp"
#include "contact/shortest_exit.hpp"
#include "model/model.hpp"

namespace periporo {

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
    /// Displacement of the surface since the start of the run [m].
    Vector3 shift() const { return obstacle_ == nullptr ? Vector3(Vector3::Zero()) : obstacle_->shift; }
    double distance(const Vector3& position, Vector3& normal) const
    {
        return obstacle_ == nullptr ? own_->distance(position, normal) : obstacle_->distance(position, normal);
    }
    /// Finds the exit of a point, see find_exit(). Positions are relative to the shift. The law's own surface has one
    /// face, and pushes to any depth.
    SolidContact contact(const Vector3& position, double distance, const Vector3& normal, double reach,
                         const Vector3& last_free_position) const
    {
        return obstacle_ == nullptr
                   ? exit_at_nearest_face(position, distance, normal, reach)
                   : find_exit(*obstacle_->geometry, position, distance, normal, reach, last_free_position);
    }
    /// Are several faces nearer to a position than `reach` [m]?
    bool has_several_faces_near(const Vector3& position, double reach) const
    {
        if (obstacle_ == nullptr || !obstacle_->geometry->has_pieces())
            return false;
        SurfacePieces pieces;
        obstacle_->geometry->find_pieces(position - obstacle_->shift, reach, pieces);
        return pieces.size() > 1;
    }
    /// @param position relative to the shift [m]
    bool is_near(const Vector3& position, double reach) const
    {
        Vector3 normal;
        if (obstacle_ == nullptr)
            return own_->distance(position, normal) < reach;
        return is_near(obstacle_->geometry->bounds(), position, reach) &&
               obstacle_->geometry->signed_distance(position, normal) < reach;
    }

private:
    /// False only if everything within the bounds is at least `reach` away.
    static bool is_near(const Bounds& bounds, const Vector3& position, double reach)
    {
        return ((position - bounds.upper).array() < reach).all() && ((bounds.lower - position).array() < reach).all();
    }

    const Obstacle* obstacle_;
    const RigidSurface* own_;
};

} // namespace periporo
