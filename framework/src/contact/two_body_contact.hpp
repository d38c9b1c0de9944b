// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of the points of two bodies, point against point.
#pragma once

#include "contact/point_contact.hpp"

namespace periporo {

class TwoBodyContact : public PointContact {
public:
    using PointContact::PointContact;

    void find_candidates(const Model& model, double slack) override;

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t /*points*/)
    {
        visit("deepest_overlap", self.deepest_overlap_);
    }
    void visit_members(ArchiveWriter& archive, std::size_t points) const override { members(*this, archive, points); }
    void visit_members(ArchiveReader& archive, std::size_t points) override { members(*this, archive, points); }

private:
    /// Those with candidates, from one refresh to the next.
    void find_active_points(const Model& /*model*/) override {}
    std::array<TouchingNeighbours, 2> touching(const Model& /*model*/, std::uint32_t point) const override
    {
        return {{{candidates_.of(point), {law().cutoff()}}, {}}};
    }
};

} // namespace periporo
