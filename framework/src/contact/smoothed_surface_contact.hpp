// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of the points of one body with the smoothed surface of another.
#pragma once

#include "contact/contact_interaction.hpp"
#include "contact/smoothed_surface.hpp"

#include <cstdint>
#include <vector>

namespace periporo {

/// A contact stores the strength of its support times the energy of the law. Its reactions on the point and on the
/// surface are minus the gradient of that.
class SmoothedSurfaceContact : public ContactInteraction {
public:
    using ContactInteraction::ContactInteraction;

    void find_candidates(const Model& model, double slack) override;
    void add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                       std::vector<Vector3>& force) override;
    void add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds) override;
    double sharpest_possible(const Model& model) const override { return sharpest_between_points(model, assignment()); }

    /// A refresh finds the surface anew, and a point may lose a part of its support. The energy of a point with more
    /// support is not dissipated: an energy from nowhere must show as an error.
    RefreshLoss refresh_loss() const override { return RefreshLoss::of_points; }
    void add_stored_energy(const Model& model, std::vector<double>& energy) override;

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t /*points*/)
    {
        visit("deepest_overlap", self.deepest_overlap_);
    }
    void visit_members(ArchiveWriter& archive, std::size_t points) const override { members(*this, archive, points); }
    void visit_members(ArchiveReader& archive, std::size_t points) override { members(*this, archive, points); }

private:
    /// A point on the surface.
    struct SupportedPoint {
        std::uint32_t point;
        Support support;
    };
    /// How many points press on a surface: all supported points, or each as if it were the only one.
    enum class Load { all, alone };

    /// Finds the points below a distance from the surface [m].
    void find_supported_points(const Model& model, double distance);
    /// The contact of a supported point as the law receives it, at rest.
    ContactPair pair_of(const Model& model, const SupportedPoint& supported, Load load) const;
    /// Calls use(supported point, pair, response) for each supported point in turn. Laws evaluate blocks of pairs.
    /// @param pair_of(supported point) what the law receives
    template <class PairOf, class Use>
    void evaluate(const PairOf& pair_of, const Use& use);
    /// Adds the forces of a contact to its point and to the surface.
    void add_reaction(const Model& model, const SupportedPoint& supported, const ContactPair& pair,
                      const ContactResponse& response, double time_step, ContactSums& sums,
                      std::vector<Vector3>& force);

    SmoothedSurface surface_;
    std::vector<SupportedPoint> supported_; ///< in the order of the points; only ever grows
    std::size_t supported_count_ = 0;       ///< of these are in use
    std::vector<double> total_slope_; ///< of each end of the surface: sum of |slope| of all points that press on it
};

} // namespace periporo
