// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sub-horizons of all bonds, kept as the way by which sums over them follow from each other.
#pragma once

#include "neighbourhood/families.hpp"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace periporo {

/// The sub-horizons of one point's bonds. The sum of a quantity over the sub-horizon of bond b is the sum over that of
/// an earlier bond, plus the members that enter, minus those that leave. Neighbours that lie near each other share most
/// of their members: a bulk point of a lattice at delta = 3.015 dx has 6,764 members in its 122 sub-horizons, and its
/// sums follow with some 1,300 pairs of an addition and a subtraction. Twins, members 2m and 2m + 1, lie side by side
/// on the space-filling curve and mostly come and go together: they count as one.
struct SubHorizonView {
    struct Change {
        std::uint16_t bond;
        std::uint16_t pairs; ///< as many enter as leave
    };
    std::size_t count = 0; ///< bonds
    /// For each bond the earlier one that its sum follows from, or count: from nothing, or count + 1: from the whole
    /// family.
    const std::uint16_t* from = nullptr;
    /// One a bond, those with fewer pairs first: loops over pairs that end where the last one ended are predicted.
    const Change* changes = nullptr;
    /// For each change `pairs` that enter, then `pairs` that leave: member m < count, nobody (count), or the twins 2m
    /// and 2m + 1 (first_twins() + m). Two bytes each if wide().
    const std::uint8_t* members = nullptr;

    std::size_t twins() const { return count / 2; }
    std::size_t first_twins() const { return count + 1; }
    /// Do their numbers need two bytes?
    bool wide() const { return first_twins() + twins() > 256; }

    /// Calls visit(members), with the members as std::uint8_t or std::uint16_t, as they are kept.
    template <class Visit>
    decltype(auto) with_members(Visit&& visit) const
    {
        return wide() ? visit(reinterpret_cast<const std::uint16_t*>(members)) : visit(members);
    }
};

class SubHorizons {
public:
    /// Finds them anew, for the families of `points` as they are. Memory is used again.
    void find(const Points& points, const IsometryTable& isometries, const Families& families, double horizon);

    SubHorizonView operator[](std::size_t point) const
    {
        const std::size_t first = first_bond_[point];
        return {first_bond_[point + 1] - first, from_.data() + first, changes_.data() + first,
                members_[point / block_size].data() + first_byte_[point]};
    }

    /// Bytes held.
    std::size_t memory() const;

private:
    std::vector<std::uint16_t> from_;
    std::vector<SubHorizonView::Change> changes_;
    std::vector<std::size_t> first_bond_;              // points + 1
    std::vector<AlignedVector<std::uint8_t>> members_; // of each block of points
    std::vector<std::uint32_t> first_byte_;            // of a point, in the members of its block
};

} // namespace periporo
