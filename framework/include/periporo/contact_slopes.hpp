// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A contact law as a spring and a dashpot at full overlap, and the time step that resolves it.
#pragma once

#include "periporo/contact.hpp"

#include <algorithm>
#include <array>

namespace periporo {

/// Largest product of the time step of a run and the angular frequency of one contact, while dashpots act [-]. A
/// collision then keeps its restitution within 0.02.
inline constexpr double damped_contact_resolution = 0.3;

struct ContactSlopes {
    double stiffness; ///< [N/m]
    double damping;   ///< [N s/m]
};

/// Spring and dashpot of a law.
/// @param pair masses and volumes, at the distance of full overlap, 0; not approaching
inline ContactSlopes slopes(const Contact& law, const ContactPair& pair)
{
    constexpr double slow = 1e-6; // [m/s]: the slope of the dashpot, however the law writes it
    std::array<ContactPair, 2> pairs{pair, pair};
    pairs[1].approach_speed = slow;
    std::array<ContactResponse, 2> responses;
    law.evaluate(pairs, responses);
    return {responses[0].stiffness, (responses[1].force - responses[0].force) / slow};
}

/// Square of the angular frequency of one contact, for the time step. With a dashpot of zeta above 1.25 it is that of
/// the dashpot, c/m, whose force must not stop the pair within a step before its spring has acted [1/s2].
inline double sharpness(const ContactPair& pair, const ContactSlopes& slopes)
{
    constexpr double part_of_dashpot = 0.4; // the restitution of zeta = 2 is then met as well as that of others
    const double mass = reduced_mass(pair);
    const double dashpot = part_of_dashpot * slopes.damping / mass;
    return std::max(slopes.stiffness / mass, dashpot * dashpot);
}

} // namespace periporo
