// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Packs of points made of single ones, and single results taken out of packs.
#pragma once

#include "periporo/material_law.hpp"

namespace periporo::test {

template <std::size_t state_count>
using Lanes = std::array<LawInput<double, state_count>, pack_width>;

inline SymmetricTensor<double> lane_of(const SymmetricTensor<Pack>& a, std::size_t lane)
{
    return {a.xx[lane], a.yy[lane], a.zz[lane], a.xy[lane], a.yz[lane], a.xz[lane]};
}

template <std::size_t state_count>
LawInput<Pack, state_count> packed(const Lanes<state_count>& lanes)
{
    const auto gather = [&](auto value) { return Pack([&](auto lane) { return value(lanes[lane]); }); };
    const auto gather_tensor = [&](auto member) {
        return SymmetricTensor<Pack>{
            gather([&](auto& i) { return (i.*member).xx; }), gather([&](auto& i) { return (i.*member).yy; }),
            gather([&](auto& i) { return (i.*member).zz; }), gather([&](auto& i) { return (i.*member).xy; }),
            gather([&](auto& i) { return (i.*member).yz; }), gather([&](auto& i) { return (i.*member).xz; })};
    };
    using Single = LawInput<double, state_count>;
    LawInput<Pack, state_count> input{};
    input.stress = gather_tensor(&Single::stress);
    input.strain_increment = gather_tensor(&Single::strain_increment);
    for (std::size_t s = 0; s < state_count; ++s)
        input.state[s] = gather([&](auto& i) { return i.state[s]; });
    input.suction = gather([](auto& i) { return i.suction; });
    input.saturation = gather([](auto& i) { return i.saturation; });
    input.time_step = lanes[0].time_step;
    return input;
}

} // namespace periporo::test
