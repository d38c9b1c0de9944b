// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Points in blocks, and the points and images around each block that its bonds reach.
#pragma once

#include "families/families.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

static_assert(block_size * (largest_family + 1) <= 65536, "places are numbered with two bytes");

/// What the bonds of a block add to points, its own and others, gathers at places that only this block writes to: what
/// a point receives does not depend on who computes which block when. The first places of a block are its points.
class Halos {
public:
    /// Finds them anew. Memory is used again.
    void find(const Families& families);

    std::size_t blocks() const { return first_place_.size() - 1; }
    std::size_t first_point(std::size_t block) const { return block * block_size; }
    std::size_t end_point(std::size_t block) const
    {
        return std::min((block + 1) * block_size, first_arrival_.size() - 1);
    }

    /// Places of all blocks; those of a block follow each other.
    std::size_t places() const { return first_place_.back(); }
    std::size_t first_place(std::size_t block) const { return first_place_[block]; }

    /// For each lane of a pack (its number among all packs) the place of the neighbour among those of the block.
    const std::uint16_t* place_of_neighbours(std::size_t pack) const { return place_of_.data() + pack * pack_width; }

    /// What arrives at a point from all blocks.
    struct Arrival {
        std::uint32_t place;
        std::uint32_t isometry; ///< under which the point was seen there
    };
    std::span<const Arrival> arrivals(std::size_t point) const
    {
        return {arrivals_.data() + first_arrival_[point], first_arrival_[point + 1] - first_arrival_[point]};
    }

    /// Bytes held.
    std::size_t memory() const;

private:
    std::vector<std::size_t> first_place_{0}; // blocks + 1
    std::vector<std::uint16_t> place_of_;
    std::vector<std::size_t> first_arrival_{0}; // points + 1
    std::vector<Arrival> arrivals_;
};

} // namespace periporo
