// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Collisions in the steps that a run makes: restitution, energy, and the rigid surface.
#pragma once

#include "periporo/contact_kit/range.hpp"
#include "periporo/kit/text.hpp"

#include <algorithm>
#include <cmath>

namespace periporo::kit {

namespace detail {

constexpr double largest_angle = 0.3; ///< of a contact with dashpots in one step of a run, omega dt [-]

constexpr double part_of_dashpot = 0.4; ///< of its rate c/m, that counts as a frequency for the step of a run [-]

/// The outcome of a head-on collision.
struct Collision {
    double speed = 0.0;       ///< of the approach [m/s]
    double restitution = 0.0; ///< speed after over speed before; 0 when the pair stays together [-]
};

/// A collision in leapfrog steps, as a run makes it. The step is that of the stiffest overlap, or of the strongest
/// dashpot.
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
    double stiffest = 0.0, strongest = 0.0; // spring [N/m] and dashpot [N s/m]
    constexpr double slow = 1e-6;           // [m/s]: the slope of the dashpot, however the law writes it
    for (const double distance : distances_of(law, partner)) {
        stiffest = std::max(stiffest, at(distance, 0.0, 0.0).stiffness);
        strongest = std::max(strongest, at(distance, slow, 0.0).damping_force / slow);
    }
    const double mass = reduced_mass(pair_of(range, partner, 0.0, 0.0));
    const double energy = at(reach + depth * (deepest - reach), 0.0, 0.0).energy;
    Collision result;
    if (!(stiffest > 0.0) || !(energy > 0.0))
        return result; // an adhesive law: it does not push at this depth
    result.speed = std::sqrt(2.0 * energy / mass);
    const double step = largest_angle / std::max(std::sqrt(stiffest / mass), part_of_dashpot * strongest / mass);
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
