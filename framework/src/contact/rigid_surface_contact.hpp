// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of points with a rigid surface: an obstacle, or the surface that the law brings along.
#pragma once

#include "contact/contact_interaction.hpp"
#include "contact/shortest_exit.hpp"

#include <cstdint>
#include <vector>

namespace periporo {

class RigidContactSurface;

class RigidSurfaceContact : public ContactInteraction {
public:
    using ContactInteraction::ContactInteraction;

    std::int64_t crossed_points() const override { return crossed_points_; }

    /// find_near_points() finds them.
    void find_candidates(const Model& /*model*/, double /*slack*/) override {}
    void find_near_points(const Model& model, const SurfaceSearch& last, const SurfaceSearch& now) override;
    /// When the surface first acts, a point that lies deep in it, as on a lattice that does not follow the surface,
    /// gets its distance as its reach. The reach grows to that of the law as the point moves away. With the whole reach
    /// at once the overlap would be energy from nowhere.
    void begin_stage(const Model& model) override;

    void add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                       std::vector<Vector3>& force) override;
    /// Adds Coulomb friction: it takes from the tangential force and momentum of a point what stops its slip within the
    /// step, but not more than mu F_n.
    void add_friction_last(const Model& model, double time_step, ContactSums& sums,
                           std::vector<Vector3>& force) override;

    void add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds) override;
    double sharpest_possible(const Model& model) const override
    {
        return sharpest_at_rigid_surface(model, assignment());
    }

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        visit("reach", empty_or(self.reach_, points));
        visit("free_positions", any_reals(empty_or(self.free_positions_, points)));
        visit("stored/point", at_most(self.stored_points_, points));
        visit("stored/energy", at_most(self.stored_energies_, points));
        visit("deepest_overlap", self.deepest_overlap_);
        visit("crossed_points", self.crossed_points_);
    }
    void visit_members(ArchiveWriter& archive, std::size_t points) const override { members(*this, archive, points); }
    void visit_members(ArchiveReader& archive, std::size_t points) override { members(*this, archive, points); }
    void resume(const Model& model, double slack, const SurfaceSearch& search) override;

private:
    /// A point that touches the surface in this step.
    struct Touch {
        std::uint32_t point;
        double normal_force; ///< sum of those on all faces that take part [N]
        Vector3 direction;   ///< of the reaction
    };

    void list_near_points(const Model& model, const SurfaceSearch& search);
    /// Number of the reaction of the surface among ContactSums::obstacle_reactions.
    std::size_t number_of_reaction(const Model& model) const;
    /// Finds the exit of a point near the surface; without faces if the point does not touch.
    /// @param whole_reach of the law [m]
    ShortestExit find_exit_of(const Model& model, const RigidContactSurface& surface, double whole_reach,
                              std::uint32_t point, ContactSums& sums);
    void add_reaction(const Model& model, const ContactStep& step, const ContactPair& pair,
                      const ContactResponse& response, std::uint32_t point, const ShortestExit& exit, ContactSums& sums,
                      std::vector<Vector3>& force);
    /// Ends the contact of a point that has crossed the obstacle and lies at a distance from it [m].
    void release(const Model& model, std::uint32_t point, double distance, ContactSums& sums);

    std::vector<std::uint32_t> near_points_; ///< ascending
    std::vector<double> reach_;              ///< of each point, empty before the surface first acts [m]
    /// For an obstacle: of each point near it the last position without contact, or the nearest one to a position with
    /// contact, relative to the shift of the obstacle [m]; not a number for points that have not been near. It says
    /// from which side a point came.
    std::vector<Vector3> free_positions_;
    std::vector<Touch> touches_;
    std::vector<std::uint32_t> stored_points_; ///< that touch at the last evaluation, ascending
    std::vector<double> stored_energies_;      ///< of these [J]
    std::vector<std::uint32_t> last_points_;   ///< the same at the evaluation before
    std::vector<double> last_energies_;
    std::int64_t crossed_points_ = 0;
};

} // namespace periporo
