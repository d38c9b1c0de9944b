// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A contact law acts inside its reach only, and gives numbers there.
#pragma once

#include "periporo/contact_kit/range.hpp"
#include "periporo/kit/text.hpp"

#include <cmath>

namespace periporo::kit {

/// Reach and friction must be finite, the reach positive, and the friction not negative.
inline Faults check_reach(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    Faults faults;
    if (!(law.cutoff() > 0.0) || !std::isfinite(law.cutoff()))
        faults.push_back(sentence("reach: cutoff() is ", law.cutoff(), " m ", detail::where(partner)));
    if (!(law.friction() >= 0.0) || !std::isfinite(law.friction()))
        faults.push_back(sentence("friction: friction() is ", law.friction()));
    if (!faults.empty())
        return faults;
    for (const double beyond : {1.0, 1.0 + 1e-12, 1.5})
        for (const double speed : {-1.0, 0.0, 1.0}) {
            const ContactResponse apart =
                detail::response_of(law, detail::pair_of(range, partner, beyond * law.cutoff(), speed));
            if (apart.force != 0.0 || apart.stiffness != 0.0 || apart.energy != 0.0 || apart.damping_force != 0.0)
                return {sentence("reach: at ", beyond, " of cutoff() ", detail::where(partner), " the force is ",
                                 apart.force, " N, the stiffness ", apart.stiffness, " N/m and the energy ",
                                 apart.energy, " J; all must be 0")};
        }
    return faults;
}

/// All results must be finite, at any overlap, speed and size of the points.
inline Faults check_finite(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    for (const double distance : detail::distances_of(law, partner))
        for (const double speed : {-1e3, 0.0, 1e-9, 1e3})
            for (const double size : {1e-3, 1.0, 8.0})
                for (const double time_step : {0.0, 1e-6, 1e-3}) {
                    const ContactResponse found =
                        detail::response_of(law, detail::pair_of(range, partner, distance, speed, time_step, size));
                    if (!std::isfinite(found.force) || !std::isfinite(found.stiffness) ||
                        !std::isfinite(found.energy) || !std::isfinite(found.damping_force))
                        return {sentence("not finite: at a distance of ", distance, " m ", detail::where(partner),
                                         " and ", speed, " m/s the force is ", found.force, " N, the stiffness ",
                                         found.stiffness, " N/m, the energy ", found.energy,
                                         " J and the damping force ", found.damping_force, " N")};
                }
    return {};
}

/// A block gives each pair what the pair alone gives, to the last bit, however often it is evaluated.
inline Faults check_blocks(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    std::vector<ContactPair> pairs;
    for (const double distance : detail::distances_of(law, partner))
        for (const double speed : {-0.1, 0.1})
            pairs.push_back(detail::pair_of(range, partner, distance, speed));
    std::vector<ContactResponse> block(pairs.size());
    law.evaluate(pairs, block);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const ContactResponse alone = detail::response_of(law, pairs[i]);
        if (alone.force != block[i].force || alone.energy != block[i].energy || alone.stiffness != block[i].stiffness ||
            alone.damping_force != block[i].damping_force)
            return {sentence("blocks: pair ", i, " of a block of ", pairs.size(), " ", detail::where(partner),
                             " gets a force of ", block[i].force, " N, and alone ", alone.force, " N")};
    }
    return {};
}

} // namespace periporo::kit
