// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Brakes a point in a corner with the dashpot that the law has along the exit.
#include "contact/corner_dashpot.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace periporo {
namespace {

/// The part of a velocity that leads into or out of the faces that push.
Vector3 across_faces(const ShortestExit& exit, const Vector3& velocity)
{
    if (exit.faces == 3)
        return velocity;
    if (exit.faces == 1)
        return velocity.dot(exit.normals[0]) * exit.normals[0];
    const Vector3 edge = exit.normals[0].cross(exit.normals[1]).normalized();
    return velocity - velocity.dot(edge) * edge;
}

} // namespace

Vector3 corner_dashpot(const Contact& law, ContactPair pair, const ShortestExit& exit, const Vector3& velocity,
                       const Vector3& reaction)
{
    const Vector3 out = exit.move.normalized();
    const Vector3 into = across_faces(exit, velocity);
    const Vector3 across = into - into.dot(out) * out;
    pair.approach_speed = across.norm();
    if (pair.approach_speed <= 0.0)
        return Vector3::Zero();
    ContactResponse response;
    law.evaluate({&pair, 1}, {&response, 1});
    const Vector3 braking = -response.damping_force / pair.approach_speed * across;
    // Shares of the faces in the braking, by the reciprocal base of their normals.
    double part = 1.0;
    for (std::size_t f = 0; f < exit.faces; ++f) {
        Vector3 reciprocal = exit.normals[f];
        if (exit.faces == 2) {
            reciprocal -= reciprocal.dot(exit.normals[1 - f]) * exit.normals[1 - f];
        } else {
            reciprocal = exit.normals[(f + 1) % 3].cross(exit.normals[(f + 2) % 3]);
        }
        reciprocal /= reciprocal.dot(exit.normals[f]);
        const double pushing = reaction.dot(reciprocal);
        const double share = braking.dot(reciprocal);
        if (pushing + share < 0.0)
            part = std::min(part, std::max(0.0, -pushing / share));
    }
    return part * braking;
}

} // namespace periporo
