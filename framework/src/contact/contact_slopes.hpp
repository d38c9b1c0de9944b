// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A contact law as a spring and a dashpot, for the stable step.
#pragma once

#include "contact/contact_forces.hpp"

#include <algorithm>
#include <array>

namespace periporo {

/// Gap below which a contact counts in the estimate of the largest frequency, in spacings: it may close before the next
/// estimate. Between points it is small, as points of a deposit lie just out of reach of each other everywhere.
inline constexpr double surface_margin = 0.5;
inline constexpr double pair_margin = 0.1;

struct ContactSlopes {
    double stiffness; ///< [N/m]
    double damping;   ///< [N s/m]
};

/// Of a law at full overlap.
/// @param pair masses and volumes; not approaching
inline ContactSlopes slopes(const Contact& law, const ContactPair& pair)
{
    constexpr double slow = 1e-6; // [m/s]: the slope of the dashpot, however the law writes it
    std::array<ContactPair, 2> pairs{pair, pair};
    pairs[1].approach_speed = slow;
    std::array<ContactResponse, 2> responses;
    law.evaluate(pairs, responses);
    return {responses[0].stiffness, (responses[1].force - responses[0].force) / slow};
}

/// Square of the angular frequency that a contact alone has for the step: with a dashpot of zeta above 1.25 that of the
/// dashpot, c/m, whose force must not stop the pair within a step before its spring has been felt [1/s2].
inline double sharpness(const ContactPair& pair, const ContactSlopes& slopes)
{
    constexpr double part_of_dashpot = 0.4; // the restitution of zeta = 2 is then met as well as that of others
    const double mass = reduced_mass(pair);
    const double dashpot = part_of_dashpot * slopes.damping / mass;
    return std::max(slopes.stiffness / mass, dashpot * dashpot);
}

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

} // namespace periporo
