// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The state that a law finds for a settled stress.
#pragma once

#include "periporo/kit/block.hpp"

namespace periporo::kit {

namespace detail {

/// Whether the state of a stress is finite, and the stress left alone.
inline std::string initial_fault(const Material& material, const Range& range, const SymmetricTensor<double>& stress)
{
    const Values before = values(starting_point(material, range, stress));
    for (std::size_t s = 0; s < before.state.size(); ++s)
        if (!std::isfinite(before.state[s]))
            return sentence("initial state: ", material.state_variables()[s].name, " is ", before.state[s],
                            " at the stress ", text(stress), " Pa");
    if (norm(before.stress - stress) != 0.0)
        return sentence("initial state: initialize changes the stress from ", text(stress), " to ", text(before.stress),
                        " Pa");
    return {};
}

} // namespace detail

/// `initialize` leaves the stress, gives finite states, also for no stress and for tension, and a state under which the
/// stress is admissible: a step without strain changes nothing. (The latter not for laws in which time itself does.)
inline Faults check_initial_state(const Material& material, const Range& range = {})
{
    Random random;
    for (const double pressure : {0.0, -range.pressures.front()})
        if (std::string fault = detail::initial_fault(material, range, SymmetricTensor<double>::isotropic(-pressure));
            !fault.empty())
            return {fault};
    for (const MaterialPoint& start : starting_points(material, range, random)) {
        if (std::string fault = detail::initial_fault(material, range, start.stress()); !fault.empty())
            return {fault};
        if (range.rate_dependent)
            continue;
        MaterialPoint point = start;
        if (const MaterialStatus status = point.step({}, range.time_step); !status.converged)
            return {stopped("initial state", start, {}, status)};
        const double tolerance = range.accuracy * norm(start.stress());
        const std::string change = difference(values(point), values(start), material, tolerance, range.accuracy);
        if (!change.empty())
            return {"initial state: after a step without strain " + change};
    }
    return {};
}

} // namespace periporo::kit
