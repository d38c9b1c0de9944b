// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bounds of contacts for the stable step: each law as a spring and a dashpot at full overlap.
#pragma once

#include "contact/assignment.hpp"
#include "model/model.hpp"
#include "periporo/contact_slopes.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace periporo {

/// A contact counts in the estimate of the largest frequency when its gap is below this margin, in spacings: it may
/// close before the next estimate. The margin between points is small, since the points of a deposit lie just out of
/// reach of each other everywhere.
inline constexpr double surface_margin = 0.5;
inline constexpr double pair_margin = 0.1;

/// Stiffness and damping of a point against the ground, over its mass, that together with those of all other points are
/// nowhere below those of the contacts: with blocks S_i and C_i, sum u_i . S_i u_i m_i is at least twice the energy of
/// the contacts for all displacements u, and the same holds of C_i and the power of the dashpots.
struct ContactBound {
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(); ///< [1/s2]
    Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();   ///< [1/s]
    double sharpest = 0.0; ///< square of the largest angular frequency of one contact alone [1/s2]
};

/// @param mobility acceleration along the normal for 1 N [1/kg]
inline void add(ContactBound& bound, const Vector3& normal, const ContactPair& pair, const ContactSlopes& slopes,
                double mobility)
{
    const Eigen::Matrix3d along = mobility * normal * normal.transpose();
    bound.stiffness += slopes.stiffness * along;
    bound.damping += slopes.damping * along;
    bound.sharpest = std::max(bound.sharpest, sharpness(pair, slopes));
}

/// The same along every direction, as in the corner of several faces.
inline void add_everywhere(ContactBound& bound, const ContactPair& pair, const ContactSlopes& slopes, double mobility)
{
    const Eigen::Matrix3d along = mobility * Eigen::Matrix3d::Identity();
    bound.stiffness += slopes.stiffness * along;
    bound.damping += slopes.damping * along;
    bound.sharpest = std::max(bound.sharpest, sharpness(pair, slopes));
}

/// Largest angular frequency of a contact of any point of the bodies with a rigid surface [1/s]
double sharpest_at_rigid_surface(const Model& model, const ContactAssignment& assignment);
/// Largest angular frequency of a contact of any two points of the two bodies [1/s]
double sharpest_between_points(const Model& model, const ContactAssignment& assignment);

} // namespace periporo
