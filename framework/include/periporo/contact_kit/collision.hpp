// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Collisions in the steps that a run makes: restitution, energy, and the rigid surface.
#pragma once

#include "periporo/contact_kit/range.hpp"
#include "periporo/contact_slopes.hpp"
#include "periporo/kit/text.hpp"

#include <algorithm>
#include <cmath>

namespace periporo::kit {

namespace detail {

/// The outcome of a head-on collision.
struct Collision {
    double speed = 0.0;       ///< of the approach [m/s]
    double restitution = 0.0; ///< speed after over speed before; 0 when the pair stays together [-]
};

/// A collision in the leapfrog steps of a run, see sharpness().
/// @param depth   about how deep the pair presses, as a part of the way from touch to deepest overlap [-]
/// @param phase   of the first touch in its step, 0 to 1 [-]
inline Collision collide(const Contact& law, ContactPartner partner, const ContactRange& range, double depth,
                         double phase)
{
    const double reach = law.cutoff();
    const double deepest = partner == ContactPartner::points ? 0.0 : -reach;
    const auto at = [&](double distance, double speed, double time_step) {
        return response_of(law, pair_of(range, partner, distance, speed, time_step));
    };
    const ContactPair full = pair_of(range, partner, 0.0, 0.0);
    const double squared = sharpness(full, slopes(law, full));
    const double mass = reduced_mass(full);
    const double energy = at(reach + depth * (deepest - reach), 0.0, 0.0).energy;
    Collision result;
    if (!(squared > 0.0) || !(energy > 0.0))
        return result; // an adhesive law: it does not push at this depth
    result.speed = std::sqrt(2.0 * energy / mass);
    const double step = damped_contact_resolution / std::sqrt(squared);
    double distance = reach + phase * result.speed * step;
    double approach = result.speed;
    constexpr int most_steps = 100000; // a soft touch takes long; a pair that stays together never ends
    for (int n = 0; n < most_steps && (approach > 0.0 || distance < reach); ++n) {
        distance -= step * approach;
        approach -= step * at(distance, approach, step).force / mass;
    }
    result.restitution = distance >= reach ? std::max(0.0, -approach / result.speed) : 0.0;
    return result;
}

constexpr double restitution_tolerance = 0.02; ///< what steps of 0.3 of a radian leave open [-]
constexpr double collision_depths[] = {1e-4, 1e-2, 0.3, 0.7};

} // namespace detail

/// A collision must not end faster than it began, nor with another restitution than the law claims.
inline Faults check_collision(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    for (const double depth : detail::collision_depths)
        for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
            const detail::Collision collision = detail::collide(law, partner, range, depth, phase);
            if (collision.speed == 0.0)
                continue;
            if (collision.restitution > 1.0 + detail::restitution_tolerance)
                return {sentence("collision: ", detail::where(partner), " a pair that meets at ", collision.speed,
                                 " m/s parts at ", collision.restitution, " times this speed")};
            if (range.restitution &&
                std::abs(collision.restitution - *range.restitution) > detail::restitution_tolerance)
                return {sentence("restitution: ", detail::where(partner), " a collision at ", collision.speed,
                                 " m/s has ", collision.restitution, "; the law claims ", *range.restitution)};
        }
    return {};
}

/// A dashpot that acts between points must act at a rigid surface too, whose mass is without limit (`mass_b` is 0).
/// @param between_points, at_surface the law, scaled for the partner
inline Faults check_rigid_surface(const Contact& between_points, const Contact& at_surface,
                                  const ContactRange& range = {})
{
    constexpr double depth = 0.3;
    const auto collide = [&](const Contact& law, ContactPartner partner) {
        return detail::collide(law, partner, range, depth, 0.5);
    };
    const detail::Collision points = collide(between_points, ContactPartner::points);
    const detail::Collision surface = collide(at_surface, ContactPartner::surface);
    if (points.speed == 0.0 || surface.speed == 0.0)
        return {};
    // Half of the loss leaves room for a law whose dashpot grows with the size of the points.
    if (1.0 - surface.restitution < 0.5 * (1.0 - points.restitution) - detail::restitution_tolerance)
        return {sentence("rigid surface: a collision there has a restitution of ", surface.restitution,
                         ", and between points ", points.restitution,
                         "; mass_b is 0 at a rigid surface, see reduced_mass()")};
    return {};
}

} // namespace periporo::kit
