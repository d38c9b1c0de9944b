// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families: for every point the points of its body within the horizon that are of one piece with it.
#pragma once

#include "neighbourhood/images.hpp"
#include "neighbourhood/links.hpp"
#include "periporo/pack.hpp"
#include "state/aligned.hpp"
#include "state/points.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace periporo {

/// Lane bits of the first so many lanes of a pack.
constexpr std::uint8_t first_lanes(std::size_t count)
{
    return static_cast<std::uint8_t>((1u << count) - 1u);
}

/// The family of one point. Bonds lie in packs of pack_width lanes; the lanes behind the last bond name the point
/// itself, so that whatever is gathered there is finite. Another pack_width neighbours may be read behind them, too:
/// they name some point.
struct FamilyView {
    std::size_t count = 0;      ///< bonds
    std::size_t packs = 0;      ///< packs of bonds
    std::size_t first_pack = 0; ///< of this point among all packs; bond b has slot first_pack * pack_width + b
    std::size_t lower = 0;      ///< the first so many neighbours are points of smaller number; images come last
    /// Neighbour of each bond: a point, or points + n for image n.
    const std::uint32_t* neighbours = nullptr;

    /// Number of bonds in a pack: pack_width but for the last.
    std::size_t bonds_in(std::size_t pack) const { return std::min(pack_width, count - pack * pack_width); }
    /// The same as lane bits.
    std::uint8_t lanes(std::size_t pack) const { return first_lanes(bonds_in(pack)); }
};

/// Points of a block lie side by side on a space-filling curve; one thread works on a block at a time.
inline constexpr std::size_t block_size = 64;

/// Most bonds of a point; a lattice at delta = 3.015 dx has 122.
inline constexpr std::uint32_t largest_family = 1000;

class Families {
public:
    /// Families of all points from their current positions, images included: neighbours within the horizon that a chain
    /// of links joins to the point, see Links and ChainSearch. They are mutual: every bond has one in the opposite
    /// direction, held by the neighbour or by the parent of the image.
    /// @throws std::runtime_error naming the point when a family is larger than largest_family.
    static Families find(const Points& points, IsometryTable& isometries, const FamilyRule& rule);

    /// Neighbours of all points, as a checkpoint keeps them: families depend on those before them.
    struct Kept {
        std::vector<std::uint32_t> family_counts, family_neighbours, apart_counts, apart_neighbours;

        template <class Self, class Visit>
        static void members(Self& self, Visit& visit, std::size_t points)
        {
            const auto sum = [](const std::vector<std::uint32_t>& counts) {
                return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
            };
            visit("counts", exactly(self.family_counts, points));
            visit("neighbours", exactly(self.family_neighbours, sum(self.family_counts)));
            visit("apart_counts", exactly(self.apart_counts, points));
            visit("apart", exactly(self.apart_neighbours, sum(self.apart_counts)));
        }
    };
    Kept kept() const;
    /// The families that were kept, for the positions that they were found from.
    /// @throws std::runtime_error when they are no families of these points.
    static Families restore(const Points& points, IsometryTable& isometries, double horizon, const Kept& kept);

    FamilyView operator[](std::size_t point) const
    {
        const std::size_t first = first_pack_[point];
        return {count_[point], first_pack_[point + 1] - first, first, lower_[point],
                neighbours_.data() + first * pack_width};
    }

    /// Points and images of the body within the horizon of a point that are not of its family: pieces apart.
    std::span<const std::uint32_t> apart(std::size_t point) const
    {
        return {apart_.data() + first_apart_[point], first_apart_[point + 1] - first_apart_[point]};
    }
    /// Is the neighbour with this key of the family of a point?
    bool holds(std::uint32_t point, std::uint64_t key) const { return find_bond(point, key).has_value(); }

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
    std::uint64_t key(std::uint32_t neighbour) const { return neighbour_key(isometry(neighbour), parent(neighbour)); }
    /// What `point` is called by the parent of its neighbour: the image of the point that lies beside the parent.
    std::uint64_t opposite_key(std::uint32_t point, std::uint32_t neighbour, const IsometryTable& isometries) const
    {
        return neighbour_key(isometries.inverse(isometry(neighbour)), point);
    }
    /// The bond of the parent of `neighbour` in the opposite direction, towards `point` as seen from there: its number
    /// in that family.
    /// @throws std::logic_error when there is none.
    std::size_t opposite(std::uint32_t point, std::uint32_t neighbour, const IsometryTable& isometries) const;
    /// Bytes held.
    std::size_t memory() const;

private:
    /// Neighbours of the points of each block, one point after the other.
    using Found = std::vector<std::vector<std::uint32_t>>;

    /// Number in the family of a point of the bond to the neighbour with this key.
    std::optional<std::size_t> find_bond(std::uint32_t point, std::uint64_t key) const;
    std::vector<Vector3> positions_with_images(const Points& points, const IsometryTable& isometries) const;
    void find_neighbours(const Points& points, const IsometryTable& isometries, const FamilyRule& rule);
    void check_sizes(const Points& points) const;
    /// Lays out families found block by block; `count_` must be set.
    void lay_out(const Found& found);
    void lay_out_apart(const Found& found, std::span<const std::uint32_t> counts);
    /// Is every family ordered by key, of points of one body within the horizon, and mutual?
    bool are_sound(const Points& points, const IsometryTable& isometries, double horizon) const;
    /// Takes bonds to images out that have no opposite: the two ends measure a chain through images from different
    /// sides, and rounding may tell them apart.
    void drop_one_sided(const IsometryTable& isometries);

    std::vector<Image> images_;
    std::vector<std::uint32_t> count_;
    std::vector<std::uint16_t> lower_;
    std::vector<std::size_t> first_pack_; // points + 1
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::size_t> first_apart_; // points + 1
    std::vector<std::uint32_t> apart_;
};

} // namespace periporo
