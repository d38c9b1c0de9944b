// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Internal forces of points from the forces of bonds, and what every force state reports.
#pragma once

#include "model/model.hpp"
#include "operator/evaluation.hpp"
#include "operator/transpose.hpp"
#include "periporo/material.hpp"

#include <limits>
#include <vector>

namespace periporo {

/// Sums internal_force_i = V_i sum_j V_j (T_ij - T_ji) bond by bond: V_i V_j T_ij goes to i and, reversed, to j; that
/// of a bond to an image goes, mirrored, to its point. The forces of a block of points are summed in its accumulators
/// and distributed afterwards, so that no result depends on the number of threads.
class BondForces {
public:
    /// Before the first block of an evaluation: room, and no forces.
    static void prepare(const BlockAccumulators& blocks, OperatorWorkspace& workspace, OperatorResult& result)
    {
        workspace.accumulators.resize(blocks.size() * stride);
        std::fill(result.internal_force.begin(), result.internal_force.end(), Vector3::Zero());
    }

    /// Begins a block: its accumulators are zero.
    BondForces(const BlockAccumulators& blocks, std::size_t block, OperatorWorkspace& workspace)
        : blocks_(blocks), first_point_(blocks.first_point(block)),
          sums_(workspace.accumulators.data() + blocks.first(block) * stride)
    {
        std::fill(sums_, workspace.accumulators.data() + blocks.first(block + 1) * stride, 0.0);
    }

    /// Subtracts the forces of a pack of bonds, V_i V_j T_ij of the first `bonds` lanes [N], from the neighbours.
    void subtract_from_neighbours(std::size_t pack, std::size_t bonds, const std::array<Pack, 3>& force)
    {
        subtract(blocks_.of_neighbours(pack), bonds, force, [](std::size_t) { return true; });
    }

    /// The same for a pack of bonds that the point holds, without those to images: their points hold the mirrored bond.
    /// @param points number of points
    void subtract_from_points(std::size_t points, const FamilyView& family, const HeldBonds& held, std::size_t pack,
                              const std::array<Pack, 3>& force)
    {
        const std::size_t first = pack * pack_width;
        subtract(blocks_.of_neighbours(family.first_pack) + held.first + first, held.bonds_in(pack), force,
                 [&](std::size_t lane) { return held.neighbours[first + lane] < points; });
    }

    /// Adds the sum of the forces of its bonds to a point of the block.
    void add_to(std::size_t point, const std::array<Pack, 3>& force)
    {
        double* at = sums_ + (point - first_point_) * stride;
        for (std::size_t c = 0; c < 3; ++c)
            at[c] += reduce(force[c]);
    }

    /// After the last block: adds the contributions of all blocks to the internal forces of the points.
    static void distribute(const Neighbourhood& neighbourhood, const OperatorWorkspace& workspace,
                           OperatorResult& result);

private:
    /// Subtracts the forces of the lanes for which concerns(lane) holds.
    template <class Concerns>
    void subtract(const std::uint16_t* accumulator, std::size_t bonds, const std::array<Pack, 3>& force,
                  Concerns&& concerns)
    {
        alignas(64) double rows[pack_width * stride];
        store_rows_of_lanes(force, rows);
        for (std::size_t lane = 0; lane < bonds; ++lane) {
            if (!concerns(lane))
                continue;
            double* at = sums_ + accumulator[lane] * stride;
            (load_sum(at) - load_sum(rows + lane * stride)).copy_to(at, std::experimental::vector_aligned);
        }
    }

    static constexpr std::size_t stride = 4; // three components of force, and one that fills the vector
    using Sum = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, stride>>;
    static Sum load_sum(const double* at) { return Sum(at, std::experimental::vector_aligned); }

    const BlockAccumulators& blocks_;
    std::size_t first_point_;
    double* sums_; // of the block
};

/// Keeps the failure of the first point, whichever thread met it.
class FirstFailure {
public:
    void report(std::size_t point, const MaterialStatus& status)
    {
#pragma omp critical(periporo_material_failure)
        if (point < point_) {
            point_ = point;
            status_ = status;
        }
    }
    /// @throws MaterialFailure when one was reported.
    void raise(const State& state, const Families& families) const;

private:
    std::size_t point_ = std::numeric_limits<std::size_t>::max();
    MaterialStatus status_;
};

} // namespace periporo
