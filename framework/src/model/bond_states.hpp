// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What bonds carry from step to step: stress and internal variables.
#pragma once

#include "neighbourhood/neighbourhood.hpp"
#include "state/aligned.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace periporo {

/// The bonds of a point whose state it holds: a family from bond `first` on, in packs of their own.
template <class Value>
struct HeldBondsOf {
    std::size_t first;
    std::size_t count;
    std::size_t packs;
    std::size_t rows; ///< of a bond
    const std::uint32_t* neighbours;
    Value* state;

    /// Number of bonds in a pack: pack_width but for the last.
    std::size_t bonds_in(std::size_t pack) const { return std::min(pack_width, count - pack * pack_width); }
    /// The same as lane bits.
    std::uint8_t lanes(std::size_t pack) const { return first_lanes(bonds_in(pack)); }
    /// Doubles of their state.
    std::size_t values() const { return packs * rows * pack_width; }
    /// First of the rows of one of these bonds; its rows are pack_width apart.
    Value* bond(std::size_t held) const { return state + held / pack_width * rows * pack_width + held % pack_width; }
};
using HeldBonds = HeldBondsOf<double>;
using ConstHeldBonds = HeldBondsOf<const double>;

/// States of all bonds: for each block of points the states of its points, for each point the packs of the bonds that
/// it holds, for each pack its rows of pack_width: six of effective stress, then state variables.
class BondStates {
public:
    /// Do (i,j) and (j,i) have one state? Then the point of smaller number holds it, and both ends hold bonds to
    /// images: their states are mirrored.
    bool shared = false;

    /// The bonds that a point holds, or held when it had another family and other states.
    /// @param rows of a bond of the point
    HeldBonds held(std::size_t point, const FamilyView& family, std::size_t rows)
    {
        return held_bonds(family, rows, state(point));
    }
    ConstHeldBonds held(std::size_t point, const FamilyView& family, std::size_t rows) const
    {
        return held_bonds(family, rows, state(point));
    }
    ConstHeldBonds held(const FamilyView& family, std::size_t rows, const double* state) const
    {
        return held_bonds(family, rows, state);
    }

    /// Makes room for the bonds of all points, block by block with lay_out().
    void resize(std::size_t blocks, std::size_t points);
    /// Lays out the states of a block of points for their present families; values are not set.
    void lay_out(std::size_t block, const State& state, const Neighbourhood& neighbourhood);

    double* state(std::size_t point) { return states_[point / block_size].data() + first_[point]; }
    const double* state(std::size_t point) const { return states_[point / block_size].data() + first_[point]; }
    /// All states of a block, and where the states of a point begin among them.
    const UnsetVector<double>& of_block(std::size_t block) const { return states_[block]; }
    std::uint32_t first(std::size_t point) const { return first_[point]; }
    std::size_t memory() const; ///< [bytes]

    /// Lengths are those that the families ask for.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        for (std::size_t block = 0; block < self.states_.size(); ++block)
            visit("states/" + std::to_string(block), any_reals(self.states_[block]));
    }

private:
    template <class Value>
    HeldBondsOf<Value> held_bonds(const FamilyView& family, std::size_t rows, Value* state) const
    {
        const std::size_t first = shared ? family.lower : 0;
        const std::size_t count = family.count - first;
        return {first, count, (count + pack_width - 1) / pack_width, rows, family.neighbours + first, state};
    }

    std::vector<UnsetVector<double>> states_; // of each block
    std::vector<std::uint32_t> first_;        // of each point, in the states of its block
};

} // namespace periporo
