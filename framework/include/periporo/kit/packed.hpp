// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Single points side by side in the lanes of a pack or of a pair of packs, and single ones taken out of it.
#pragma once

#include "periporo/material_law.hpp"

#include <type_traits>
#include <vector>

namespace periporo::kit {

/// An input of a law with these points in its lanes, one after the other.
/// @param lanes as many as a Real has: pack_width for Pack, twice that for PackPair. The time step is that of the
/// first.
template <class Real, std::size_t state_count>
LawInput<Real, state_count> packed(const std::vector<LawInput<double, state_count>>& lanes)
{
    const auto gather = [&](auto value) {
        if constexpr (std::is_same_v<Real, PackPair>)
            return PackPair(Pack([&](auto lane) { return value(lanes[lane]); }),
                            Pack([&](auto lane) { return value(lanes[lane + pack_width]); }));
        else
            return Pack([&](auto lane) { return value(lanes[lane]); });
    };
    const auto tensor = [&](auto member) {
        return SymmetricTensor<Real>{
            gather([&](auto& i) { return (i.*member).xx; }), gather([&](auto& i) { return (i.*member).yy; }),
            gather([&](auto& i) { return (i.*member).zz; }), gather([&](auto& i) { return (i.*member).xy; }),
            gather([&](auto& i) { return (i.*member).yz; }), gather([&](auto& i) { return (i.*member).xz; })};
    };
    using Single = LawInput<double, state_count>;
    LawInput<Real, state_count> input;
    input.stress = tensor(&Single::stress);
    input.strain_increment = tensor(&Single::strain_increment);
    for (std::size_t s = 0; s < state_count; ++s)
        input.state[s] = gather([&](auto& i) { return i.state[s]; });
    input.suction = gather([](auto& i) { return i.suction; });
    input.saturation = gather([](auto& i) { return i.saturation; });
    input.time_step = lanes[0].time_step;
    return input;
}

template <class Real>
SymmetricTensor<double> lane_of_tensor(const SymmetricTensor<Real>& a, std::size_t lane)
{
    return {lane_of(a.xx, lane), lane_of(a.yy, lane), lane_of(a.zz, lane),
            lane_of(a.xy, lane), lane_of(a.yz, lane), lane_of(a.xz, lane)};
}

template <class Real, std::size_t state_count>
std::vector<double> lane_of_state(const std::array<Real, state_count>& state, std::size_t lane)
{
    std::vector<double> values;
    for (const Real& value : state)
        values.push_back(lane_of(value, lane));
    return values;
}

} // namespace periporo::kit
