// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of a simulation side by side: its state, its neighbourhood, the states on bonds, and the last evaluation.
#pragma once

#include "model/bond_states.hpp"
#include "model/operator_result.hpp"
#include "neighbourhood/bond_ends.hpp"
#include "neighbourhood/neighbourhood.hpp"
#include "state/state.hpp"

#include <cstddef>

namespace periporo {

/// Memory of an evaluation, kept from one to the next. Between evaluations its values mean nothing.
struct OperatorWorkspace {
    AlignedVector<double> accumulators; ///< of Neighbourhood::blocks
    AlignedVector<double> end_fields;   ///< fields over the ends of bonds, see EndField
};

struct Model {
    State state;
    Neighbourhood neighbourhood;
    BondStates bonds;
    BondEnds ends;         ///< at the last gather_ends()
    OperatorResult result; ///< of the last evaluation
    OperatorWorkspace workspace;

    std::size_t size() const { return state.size(); }
    const Body& body_of(std::size_t point) const { return state.body_of(point); }
    std::size_t rows(std::size_t point) const { return state.rows(point); }

    /// Sets the sizes of everything that has one value for each point, once bodies and points are there.
    void allocate();
    /// Gathers positions, velocities, volumes and water of the points at the ends of bonds.
    void gather_ends() { ends.gather(state.points, state.points.velocity, neighbourhood); }

    /// The bonds whose state a point holds.
    HeldBonds held(std::size_t point) { return bonds.held(point, neighbourhood.families[point], rows(point)); }
    ConstHeldBonds held(std::size_t point) const
    {
        return bonds.held(point, neighbourhood.families[point], rows(point));
    }
    /// First of the rows of bond b of a point, held by whichever end; rows are pack_width apart.
    double* bond_state(std::size_t point, std::size_t b)
    {
        const Holder holder = holder_of(point, b);
        return held(holder.point).bond(holder.held);
    }
    const double* bond_state(std::size_t point, std::size_t b) const
    {
        const Holder holder = holder_of(point, b);
        return held(holder.point).bond(holder.held);
    }

    std::size_t memory() const; ///< in points, families and bonds [bytes]

    /// What a checkpoint keeps besides families and bonds.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit.part("state", self.state);
        visit.part("neighbourhood", self.neighbourhood, self.size());
    }

private:
    /// Who holds bond b of a point, and as which of its held bonds.
    struct Holder {
        std::size_t point;
        std::size_t held;
    };
    Holder holder_of(std::size_t point, std::size_t b) const;
};

} // namespace periporo
