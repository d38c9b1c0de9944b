// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pairs that a contact law is checked on, and the limits that the law claims for itself.
#pragma once

#include "periporo/contact.hpp"
#include "periporo/kit/range.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace periporo::kit {

/// The defaults suit soil in points of one centimetre.
struct ContactRange {
    double spacing = 0.01;   ///< dx [m]
    double horizon = 0.03;   ///< delta [m]
    double density = 2000.0; ///< of the points [kg/m3]
    /// The largest pull of one contact [N]; 0 for a law without adhesion.
    double pull_limit = 0.0;
    /// The coefficient of restitution that the law claims, at every speed [-]; none: it only must not exceed 1.
    std::optional<double> restitution;
};

namespace detail {

/// Two equal points, or one point and a rigid surface.
/// @param size of the points, as a factor on the volume of a cell [-]
inline ContactPair pair_of(const ContactRange& range, ContactPartner partner, double distance, double approach_speed,
                           double time_step = 0.0, double size = 1.0)
{
    const double volume = size * range.spacing * range.spacing * range.spacing;
    const bool points = partner == ContactPartner::points;
    const double other = points ? volume : 0.0;
    return {distance, approach_speed, volume, other, range.density * volume, range.density * other, time_step};
}

/// The response of one pair. A law that leaves it unset gives not-a-number.
inline ContactResponse response_of(const Contact& law, const ContactPair& pair)
{
    constexpr double unset = std::numeric_limits<double>::quiet_NaN();
    ContactResponse response{unset, unset, unset, unset};
    law.evaluate({&pair, 1}, {&response, 1});
    return response;
}

/// Distances inside the reach of a law, from first touch to deep overlap: two points at one place, or a point as deep
/// below a surface as the reach is long [m].
inline std::vector<double> distances_of(const Contact& law, ContactPartner partner)
{
    const double deepest = partner == ContactPartner::points ? 0.0 : -law.cutoff();
    std::vector<double> distances;
    for (const double depth : {1e-4, 0.0313, 0.107, 0.211, 0.331, 0.457, 0.617, 0.783, 1.0})
        distances.push_back(law.cutoff() + depth * (deepest - law.cutoff()));
    return distances;
}

/// "between points" or "at a rigid surface".
inline const char* where(ContactPartner partner)
{
    return partner == ContactPartner::points ? "between points" : "at a rigid surface";
}

} // namespace detail

} // namespace periporo::kit
