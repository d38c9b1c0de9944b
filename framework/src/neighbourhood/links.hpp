// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Links: pairs of close neighbours that are one piece of matter. Chains of links make families.
#pragma once

#include "neighbourhood/images.hpp"
#include "state/points.hpp"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

class Families;

/// What a neighbour is called from one refresh to the next: its isometry (0 for a point) and the point behind it.
/// Families are ordered by it.
constexpr std::uint64_t neighbour_key(std::uint32_t isometry, std::uint32_t parent)
{
    return std::uint64_t{isometry} << 32 | parent;
}

/// Two points of a body, or a point and an image, that were apart and have closed: from now on they are linked. Both
/// directions are listed.
struct ClosedPair {
    std::uint32_t point;
    std::uint64_t key; ///< of the neighbour

    friend auto operator<=>(const ClosedPair&, const ClosedPair&) = default;
};

/// Greatest length of a link [m]: 1.8 spacings, so that the neighbours (1,1,1) of a lattice are linked and soil that
/// flows stays whole, or 0.53 horizons where that is more, so that three links reach every neighbour of a lattice.
inline double link_length(double spacing, double horizon)
{
    return std::min(std::max(1.8 * spacing, 0.53 * horizon), horizon);
}

/// Which points within a horizon make a family.
struct FamilyRule {
    double horizon = 0.0;                    ///< delta [m]
    double link = 0.0;                       ///< greatest length of a link [m]
    const Families* before = nullptr;        ///< the families until now; null: all pairs close enough are linked
    std::span<const ClosedPair> closed = {}; ///< sorted; pairs that become linked
    std::span<const double> joining = {};    ///< for each body: pairs closer than this are linked at once [m]
};

/// The links of every point and every image: other points and images of the body, no farther apart than the rule says,
/// that were of one family until now, or have closed. Images under an isometry that had none until now, as those of a
/// symmetry plane that a stage adds, are linked at once.
class Links {
public:
    Links(const Points& points, std::span<const Image> images, const IsometryTable& isometries, const FamilyRule& rule);

    /// Is a neighbour of a point, `distance_squared` away, linked to it?
    bool linked(std::uint32_t point, std::uint32_t neighbour, double distance_squared) const;

    /// Stores the links of the points, block after block, and finds those of the images.
    /// @param of_points for each block of points the links of its points, one after the other
    /// @param counts how many each point has
    void store(std::span<const std::vector<std::uint32_t>> of_points, std::span<const std::uint32_t> counts);

    std::span<const std::uint32_t> operator[](std::uint32_t record) const
    {
        return {linked_.data() + first_[record], count_[record]};
    }

private:
    std::uint32_t parent(std::uint32_t record) const
    {
        return record < points_.size() ? record : images_[record - points_.size()].parent;
    }
    std::uint32_t isometry(std::uint32_t record) const
    {
        return record < points_.size() ? 0 : images_[record - points_.size()].isometry;
    }
    void find_products();
    void find_links_of_image(std::size_t image);

    static constexpr std::uint32_t none = ~std::uint32_t{0};

    const Points& points_;
    std::span<const Image> images_;
    const IsometryTable& isometries_;
    const FamilyRule& rule_;
    std::vector<std::uint8_t> had_images_; // for each isometry: in the families before
    std::vector<std::size_t> first_;       // of each record
    std::vector<std::uint32_t> count_;
    std::vector<std::uint32_t> linked_;
    std::vector<std::uint32_t> place_;     // of an isometry in use, by its number; `none` for others
    std::vector<std::size_t> first_image_; // of the isometries in use, and the end of the last
    std::vector<std::uint32_t> products_;  // of two isometries in use: their place, or `none`
    std::size_t in_use_ = 0;               // isometries, the identity among them
};

/// Finds which neighbours within the horizon of a point are joined to it by a chain of at most three links, each point
/// of the chain within the horizons of both its ends. Kept by a thread for its memory.
class ChainSearch {
public:
    /// @param near points and images of the body within the horizon of the point
    /// @param connected,apart each of them is added to one of the two, in their order
    void find(const Links& links, std::span<const Vector3> positions, double horizon, std::uint32_t point,
              std::span<const std::uint32_t> near, std::vector<std::uint32_t>& connected,
              std::vector<std::uint32_t>& apart);

private:
    bool reached_by_three(const Links& links, std::span<const Vector3> positions, double horizon_squared,
                          std::uint32_t neighbour) const;

    std::vector<std::uint8_t> links_to_; // of each record near: 1 not reached yet, 2 by one link, 3 by two
};

} // namespace periporo
