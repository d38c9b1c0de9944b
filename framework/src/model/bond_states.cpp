// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The memory of bond states.
#include "model/bond_states.hpp"

namespace periporo {

void BondStates::resize(std::size_t blocks, std::size_t points)
{
    states_.resize(blocks);
    first_.resize(points);
}

void BondStates::lay_out(std::size_t block, const State& state, const Neighbourhood& neighbourhood)
{
    std::size_t values = 0;
    for (std::size_t i = neighbourhood.blocks.first_point(block); i < neighbourhood.blocks.end_point(block); ++i) {
        first_[i] = static_cast<std::uint32_t>(values);
        values += held_bonds<double>(neighbourhood.families[i], state.rows(i), nullptr).values();
    }
    UnsetVector<double>& states = states_[block];
    states.clear(); // so that growing moves no values
    if (values > states.capacity())
        states.reserve(values + values / 16); // families grow and shrink a little from one refresh to the next
    states.resize(values);
}

std::size_t BondStates::memory() const
{
    std::size_t bytes = first_.capacity() * sizeof(std::uint32_t);
    for (const UnsetVector<double>& block : states_)
        bytes += sizeof(block) + block.capacity() * sizeof(double);
    return bytes;
}

} // namespace periporo
