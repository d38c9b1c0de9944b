// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The normal force of a contact law: it follows from the stored energy, the dashpot only takes energy, and both points
// of a pair feel the same force.
#pragma once

#include "periporo/contact_kit/range.hpp"
#include "periporo/kit/text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace periporo::kit {

/// Without motion the force must be the slope of the stored energy, -dE/d(distance), and the energy must vanish at the
/// reach: else a contact that begins and ends creates energy. The stiffness must not be less than the slope of the
/// force, since the stable step follows from it. Slopes are central differences.
inline Faults check_stored_energy(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    constexpr double tolerance = 1e-5; // differences over 1e-6 of the reach keep ten digits of the energy
    const double half = 0.5e-6 * law.cutoff();
    const auto at = [&](double distance) {
        return detail::response_of(law, detail::pair_of(range, partner, distance, 0.0));
    };
    double largest_force = 0.0, largest_stiffness = 0.0;
    for (const double distance : detail::distances_of(law, partner)) {
        largest_force = std::max(largest_force, std::abs(at(distance).force));
        largest_stiffness = std::max(largest_stiffness, std::abs(at(distance).stiffness));
    }
    const double at_reach = at(law.cutoff() * (1.0 - 1e-9)).energy;
    if (!(std::abs(at_reach) <= tolerance * largest_force * law.cutoff()))
        return {sentence("stored energy: it is ", at_reach, " J just inside cutoff() ", detail::where(partner),
                         " and 0 just outside: a contact that ends changes energy at once")};
    for (const double distance : detail::distances_of(law, partner)) {
        const ContactResponse here = at(distance), nearer = at(distance - half), farther = at(distance + half);
        const double force = (nearer.energy - farther.energy) / (2.0 * half);
        if (!(std::abs(here.force - force) <= tolerance * largest_force))
            return {sentence("stored energy: at a distance of ", distance, " m ", detail::where(partner),
                             " the force at rest is ", here.force, " N and the slope of the energy ", force, " N")};
        const double slope = (nearer.force - farther.force) / (2.0 * half);
        if (!(here.stiffness >= slope - tolerance * std::max(largest_stiffness, std::abs(slope))))
            return {sentence("stiffness: at a distance of ", distance, " m ", detail::where(partner), " it is ",
                             here.stiffness, " N/m and the slope of the force ", slope,
                             " N/m: the stable step would be too long")};
    }
    return {};
}

/// The damping force must oppose the motion, vanish at rest whatever the time step (so that a resting load has the
/// force of the spring alone), and be the only part of the force that depends on speed.
inline Faults check_damping(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    for (const double distance : detail::distances_of(law, partner))
        for (const double time_step : {0.0, 1e-6, 1e-4}) {
            const ContactResponse rest =
                detail::response_of(law, detail::pair_of(range, partner, distance, 0.0, time_step));
            const double round_off = 1e-9 * std::abs(rest.force);
            if (rest.damping_force != 0.0)
                return {sentence("damping: at rest and a distance of ", distance, " m ", detail::where(partner),
                                 " the damping force is ", rest.damping_force, " N with a time step of ", time_step,
                                 " s; it must be 0")};
            for (const double speed : {-10.0, -1e-3, 1e-3, 10.0}) {
                const ContactResponse found =
                    detail::response_of(law, detail::pair_of(range, partner, distance, speed, time_step));
                if (found.damping_force * speed < 0.0)
                    return {sentence("damping: at an approach of ", speed, " m/s and a distance of ", distance, " m ",
                                     detail::where(partner), " the damping force is ", found.damping_force,
                                     " N and drives the motion")};
                const double stored = found.force - found.damping_force;
                if (!(std::abs(stored - rest.force) <= round_off + 1e-12 * std::abs(found.damping_force)))
                    return {sentence("damping: at an approach of ", speed, " m/s and a distance of ", distance, " m ",
                                     detail::where(partner), " the force without its damping part is ", stored,
                                     " N, and at rest ", rest.force, " N")};
            }
        }
    return {};
}

/// No contact may pull more than ContactRange::pull_limit, however fast the points part.
inline Faults check_pull(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    for (const double distance : detail::distances_of(law, partner))
        for (const double speed : {-1e3, -1.0, 0.0, 1.0})
            for (const double time_step : {0.0, 1e-6, 1e-4}) {
                const double force =
                    detail::response_of(law, detail::pair_of(range, partner, distance, speed, time_step)).force;
                if (!(force >= -range.pull_limit * (1.0 + 1e-9)))
                    return {sentence("pull: at a distance of ", distance, " m ", detail::where(partner),
                                     " and an approach of ", speed, " m/s the contact pulls with ", -force,
                                     " N; the limit is ", range.pull_limit, " N")};
            }
    return {};
}

/// Momentum: a pair must feel the same force whichever of its points is named first, to the last bit.
inline Faults check_symmetry(const Contact& law, const ContactRange& range = {})
{
    for (const double distance : detail::distances_of(law, ContactPartner::points))
        for (const double speed : {-0.1, 0.0, 0.1})
            for (const double size : {0.3, 2.7}) {
                ContactPair pair = detail::pair_of(range, ContactPartner::points, distance, speed);
                pair.volume_b *= size;
                pair.mass_b *= size;
                const ContactResponse one = detail::response_of(law, pair);
                std::swap(pair.volume_a, pair.volume_b);
                std::swap(pair.mass_a, pair.mass_b);
                const ContactResponse other = detail::response_of(law, pair);
                if (one.force != other.force || one.energy != other.energy)
                    return {sentence("momentum: at a distance of ", distance, " m a small and a large point push with ",
                                     one.force, " N, and with ", other.force, " N when they change places")};
            }
    return {};
}

} // namespace periporo::kit
