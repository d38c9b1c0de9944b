// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of the points of one body: pieces that are apart, and detached points, which have no active bond.
#pragma once

#include "contact/point_contact.hpp"

namespace periporo {

/// Points of pieces that are apart touch at the cut-off of the law. A detached point may touch all members of its
/// family, at the smaller reach of the two.
///
/// A point that detaches starts with the distance of its nearest neighbour as its reach. The reach grows, up to the
/// cut-off, as the point moves away. With the whole cut-off at once its first overlap would be energy from nowhere: in
/// a trial 15 per cent of the energy of the collapse from a single point. A point that bonds again keeps its reach
/// against detached points: a pair that had the reach of one end must not overlap with that of the other (in a sliding
/// sheet 4 per cent of the energy from two points).
class OneBodyContact : public PointContact {
public:
    using PointContact::PointContact;

    void find_candidates(const Model& model, double slack) override;
    RefreshLoss refresh_loss() const override { return RefreshLoss::of_closed_pairs; }
    /// A pair is at rest when its motion has no more than a tenth of the energy that its contact stores.
    void add_closed_pairs(const Model& model, std::vector<ClosedPair>& closed) const override;

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        visit("reach", any_reals(empty_or(self.reach_, points)));
        visit("deepest_overlap", self.deepest_overlap_);
    }
    void visit_members(ArchiveWriter& archive, std::size_t points) const override { members(*this, archive, points); }
    void visit_members(ArchiveReader& archive, std::size_t points) override { members(*this, archive, points); }

private:
    void update_reach(const Model& model);
    void find_active_points(const Model& model) override;
    std::array<TouchingNeighbours, 2> touching(const Model& model, std::uint32_t point) const override;

    /// Reach of each point against detached points [m]; below zero while the point is bonded, minus infinity if it
    /// always was. Empty before the first evaluation.
    std::vector<double> reach_;
    // of each end of bonds
    std::vector<std::uint8_t> detached_;
    std::vector<double> reach_of_end_; ///< without its sign [m]
    std::vector<std::uint8_t> active_; ///< 1: the point may touch another point now
};

} // namespace periporo
