// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A contact law as a spring and a dashpot, for the stable step.
#pragma once

#include "contact/contact_forces.hpp"

#include <array>

namespace periporo {

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

/// @param mobility acceleration along the normal for 1 N [1/kg]
inline void add(ContactBound& bound, const Vector3& normal, const ContactSlopes& slopes, double mobility)
{
    const Eigen::Matrix3d along = mobility * normal * normal.transpose();
    bound.stiffness += slopes.stiffness * along;
    bound.damping += slopes.damping * along;
}

} // namespace periporo
