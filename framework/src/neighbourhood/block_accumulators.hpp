// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Accumulators of the sums that the bonds of a block of points add to their ends.
#pragma once

#include "neighbourhood/families.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

static_assert(block_size * (largest_family + 1) <= 65536, "accumulators of a block are numbered with two bytes");

/// The bonds of a block of points add to the points of the block and to ends beyond it. Each block has accumulators of
/// its own for all of these, so that a point receives the same sum however blocks are spread over threads. The first
/// accumulators of a block are those of its points.
class BlockAccumulators {
public:
    /// Finds them anew. Memory is used again.
    void find(const Families& families);

    std::size_t blocks() const { return first_.size() - 1; }
    std::size_t first_point(std::size_t block) const { return block * block_size; }
    std::size_t end_point(std::size_t block) const
    {
        return std::min((block + 1) * block_size, first_contribution_.size() - 1);
    }

    /// Number of accumulators of all blocks; those of a block follow each other.
    std::size_t size() const { return first_.back(); }
    std::size_t first(std::size_t block) const { return first_[block]; }

    /// For each lane of a pack (its number among all packs) the accumulator of the neighbour among those of the block.
    const std::uint16_t* of_neighbours(std::size_t pack) const { return of_neighbours_.data() + pack * pack_width; }

    /// An accumulator that holds a part of the sum of a point.
    struct Contribution {
        std::uint32_t accumulator;
        std::uint32_t isometry; ///< under which the bonds of the block see the point
    };
    std::span<const Contribution> contributions(std::size_t point) const
    {
        return {contributions_.data() + first_contribution_[point],
                first_contribution_[point + 1] - first_contribution_[point]};
    }

    std::size_t memory() const; ///< [bytes]

private:
    std::vector<std::size_t> first_{0}; // blocks + 1
    std::vector<std::uint16_t> of_neighbours_;
    std::vector<std::size_t> first_contribution_{0}; // points + 1
    std::vector<Contribution> contributions_;
};

} // namespace periporo
