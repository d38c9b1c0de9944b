// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families: for every point all points of its body within the horizon, and which of them share a sub-horizon.
#pragma once

#include "model/aligned.hpp"
#include "model/images.hpp"
#include "model/points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

/// The family of one point. Bonds lie in packs of pack_width lanes; the lanes behind the last bond name the point
/// itself, so that whatever is gathered there is finite.
struct FamilyView {
    std::size_t count = 0;      ///< bonds
    std::size_t packs = 0;      ///< packs of bonds
    std::size_t first_pack = 0; ///< of this point among all packs; bond b has slot first_pack * pack_width + b
    /// Neighbour of each bond: a point, or points + n for image n.
    const std::uint32_t* neighbours = nullptr;
    /// Slot of the bond in the opposite direction, held by the neighbour or by the parent of the image.
    const std::uint32_t* reverse = nullptr;
    /// Row k, one bit a bond: is the neighbour of bond k in the sub-horizon of bond b? Symmetric in k and b.
    const std::uint8_t* membership = nullptr;
};

/// Most bonds of a point; a lattice at delta = 3.015 dx has 122.
inline constexpr std::uint32_t largest_family = 1024;

class Families {
public:
    /// @throws std::runtime_error naming the point when a family is larger than largest_family.
    /// Families of all points from their current positions, images included.
    static Families find(const Points& points, IsometryTable& isometries, double horizon);

    FamilyView operator[](std::size_t point) const
    {
        const std::size_t first = first_pack_[point];
        return {count_[point],
                first_pack_[point + 1] - first,
                first,
                neighbours_.data() + first * pack_width,
                reverse_.data() + first * pack_width,
                membership_.data() + first_byte_[point]};
    }

    std::size_t points() const { return count_.size(); }
    std::size_t packs() const { return first_pack_.empty() ? 0 : first_pack_.back(); }
    std::size_t first_pack(std::size_t point) const { return first_pack_[point]; }
    std::size_t bonds() const;
    const std::vector<Image>& images() const { return images_; }

    /// The point behind a neighbour: itself, or the parent of the image.
    std::uint32_t parent(std::uint32_t neighbour) const
    {
        return neighbour < count_.size() ? neighbour : images_[neighbour - count_.size()].parent;
    }
    /// The isometry of a neighbour; 0 for a point.
    std::uint32_t isometry(std::uint32_t neighbour) const
    {
        return neighbour < count_.size() ? 0 : images_[neighbour - count_.size()].isometry;
    }
    /// What a neighbour is called from one refresh to the next; a family is ordered by it.
    std::uint64_t key(std::uint32_t neighbour) const
    {
        return (static_cast<std::uint64_t>(isometry(neighbour)) << 32) | parent(neighbour);
    }
    /// Bytes held.
    std::size_t memory() const;

private:
    void find_neighbours(const Points& points, const IsometryTable& isometries, double horizon);
    void find_reverse(const IsometryTable& isometries);
    void find_membership(const Points& points, const IsometryTable& isometries, double horizon);

    std::vector<Image> images_;
    std::vector<std::uint32_t> count_;
    std::vector<std::size_t> first_pack_; // points + 1
    std::vector<std::size_t> first_byte_; // points
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::uint32_t> reverse_;
    std::vector<std::uint8_t> membership_;
};

} // namespace periporo
