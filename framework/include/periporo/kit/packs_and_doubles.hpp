// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A law written once gives the same for a double, for a pack and for a pair of packs.
#pragma once

#include "periporo/kit/block.hpp"
#include "periporo/kit/packed.hpp"

#include <string>

namespace periporo::kit {

namespace detail {

/// Compares an update of a pack or a pair with those of its lanes alone.
template <class Real, class Law, class Input>
std::string update_fault(const Law& law, const Material& material, const std::vector<Input>& lanes, const Range& range)
{
    const auto result = law.template update<Real>(packed<Real>(lanes));
    const Real failed = select(result.failed, Real(1.0), Real(0.0));
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        const auto expected = law.template update<double>(lanes[lane]);
        if ((lane_of(failed, lane) != 0.0) != expected.failed)
            return sentence("lane ", lane, expected.failed ? " fails as a double only" : " fails in the pack only");
        const double scale = stress_scale(material, lanes[lane].stress, lanes[lane].strain_increment);
        const std::string fault = difference({lane_of_tensor(result.stress, lane), lane_of_state(result.state, lane)},
                                             {expected.stress, lane_of_state(expected.state, 0)}, material,
                                             range.accuracy * scale, range.accuracy);
        if (!fault.empty())
            return sentence("in lane ", lane, " ", fault);
    }
    return {};
}

} // namespace detail

/// Compares updates by Pack and PackPair, and initial states by Pack, lane by lane with those by double, along random
/// paths. The operations are the same up to fused multiply-adds, the exponential of packs (two units in the last place)
/// and the iterations of the law, which may stop one sooner: what these leave is `Range::accuracy`.
template <class Law>
Faults check_packs(const Law& law, const Material& material, const Range& range = {})
{
    using Input = LawInput<double, Law::state_count>;
    Random random;
    std::vector<Input> lanes(2 * pack_width);
    for (int round = 0; round < 50; ++round) {
        for (Input& lane : lanes) {
            lane = {};
            const double pressure = range.pressures[static_cast<std::size_t>(round) % range.pressures.size()];
            lane.stress = random_stress(random, pressure * random.number(0.2, 1.0), range.stress_ratio);
            lane.suction = range.suction;
            lane.saturation = range.saturation;
            lane.time_step = range.time_step;
        }
        const std::vector<Input> first(lanes.begin(), lanes.begin() + static_cast<std::ptrdiff_t>(pack_width));
        const auto initial = law.template initial_state<Pack>(packed<Pack>(first), range.overconsolidation_ratio);
        for (std::size_t n = 0; n < lanes.size(); ++n) {
            lanes[n].state = law.template initial_state<double>(lanes[n], range.overconsolidation_ratio);
            if (n >= pack_width)
                continue;
            const std::string fault =
                difference({lanes[n].stress, lane_of_state(initial, n)},
                           {lanes[n].stress, lane_of_state(lanes[n].state, 0)}, material, 0.0, range.accuracy);
            if (!fault.empty())
                return {sentence("packs: of an initial state by packs, in lane ", n, " ", fault)};
        }
        for (int step = 0; step < 10; ++step) {
            for (Input& lane : lanes) {
                const double choice = random.number(0.0, static_cast<double>(range.strain_increments.size()));
                lane.strain_increment = random.tensor(range.strain_increments[static_cast<std::size_t>(choice)]);
            }
            const std::vector<Input> half(lanes.begin(), lanes.begin() + static_cast<std::ptrdiff_t>(pack_width));
            if (std::string fault = detail::update_fault<Pack>(law, material, half, range); !fault.empty())
                return {"packs: of an update by packs, " + fault};
            if (std::string fault = detail::update_fault<PackPair>(law, material, lanes, range); !fault.empty())
                return {"packs: of an update by pairs of packs, " + fault};
            for (Input& lane : lanes) {
                const auto next = law.template update<double>(lane);
                lane.stress = next.stress;
                lane.state = next.state;
            }
        }
    }
    return {};
}

} // namespace periporo::kit
