// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values that a law forgets to set: what it returns then is what happened to lie in memory.
#pragma once

#include "periporo/kit/block.hpp"

#include <array>
#include <cstddef>

namespace periporo::kit {

namespace detail {

/// Fills the stack below the caller, where the next call has its variables.
[[gnu::noinline]] inline void fill_stack(double value)
{
    std::array<volatile double, 4096> below;
    for (volatile double& number : below)
        number = value;
}

/// What differs between two outcomes of `act` on a block of one point, with two fillings of the stack before.
template <class Act>
std::string unset_value(const Material& material, const BlockPoint& point, Act&& act)
{
    const auto outcome_over = [&](double filling) {
        Block block(material, {point});
        fill_stack(filling);
        act(block);
        return block.values(0);
    };
    const Values one = outcome_over(17.0);
    return difference(outcome_over(-1e5), one, material, 0.0, 0.0);
}

} // namespace detail

/// `initialize` and `update` set every value that they return: what lay on the stack before makes no difference.
inline Faults check_unset(const Material& material, const Range& range = {})
{
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random)) {
        const BlockPoint point = block_point(start, random.tensor(range.strain_increments.back()));
        if (const std::string found = detail::unset_value(
                material, point, [&](Block& block) { block.initialize(range.overconsolidation_ratio); });
            !found.empty())
            return {"unset values: initialize returns what lay in memory: " + found};
        if (const std::string found = detail::unset_value(
                material, point, [&](Block& block) { static_cast<void>(block.update(range.time_step)); });
            !found.empty())
            return {"unset values: update returns what lay in memory: " + found};
    }
    return {};
}

} // namespace periporo::kit
