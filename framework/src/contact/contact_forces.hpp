// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All contacts of a model: makes the kind of each, passes them the events of a run, and sums.
#pragma once

#include "contact/contact_interaction.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace periporo {

/// Contact of points with rigid surfaces, with other bodies, and within their body.
class ContactForces {
public:
    explicit ContactForces(std::vector<ContactAssignment> assignments);

    /// Finds what may touch before the next refresh. To be called after every refresh.
    /// @param slack decrease of the distance of two points until then, at most [m]
    void find_candidates(const Model& model, double slack);
    /// To be called before families are found anew, with gathered ends.
    /// @return pairs of points of one body that are apart, touch, and have come to rest against each other, where the
    /// material closes. Sorted, with both directions of each pair.
    std::vector<ClosedPair> begin_refresh(const Model& model);
    /// To be called after families were found anew, with gathered ends. Finds candidates.
    /// @param dissipated the energy that contacts stored before the refresh and do not store now is added to it [J]
    void end_refresh(const Model& model, double slack, double& dissipated);

    /// To be called when a stage begins, after find_candidates(). Where a rigid surface first acts, points that lie
    /// deep in it have a shorter reach.
    void begin_stage(const Model& model);
    /// Finds the points near rigid surfaces anew when points or obstacles have moved far. To be called in every step.
    void update_near_points(const Model& model);

    /// The approach speed that laws receive: the real one, or none while a body settles under artificial damping, which
    /// would multiply the dashpots of a law beyond stability.
    enum class Approach { real, none };

    /// Adds normal forces of all laws and friction between bodies to `force`. Ends must be gathered, with mid-step
    /// velocities.
    /// @param time_step within which friction may stop a slip, longer where its force will be multiplied [s]
    void add_reactions(const Model& model, double time_step, Approach approach, std::vector<Vector3>& force);
    /// Adds Coulomb friction on rigid surfaces, last of all forces.
    void add_surface_friction(const Model& model, double time_step, std::vector<Vector3>& force);

    // Of the last step:
    double energy() const { return energy_; } ///< stored in all contacts at the last add_reactions() [J]
    /// Stored one step ago by points that have crossed an obstacle since: it is lost [J].
    double energy_of_crossings() const { return sums_.energy_of_crossings; }
    /// Part of the normal force on each point that does not come from stored energy [N].
    const std::vector<Vector3>& damping() const { return sums_.damping; }
    /// Friction force on each point [N].
    const std::vector<Vector3>& friction() const { return sums_.friction; }
    const ObstaclePower& obstacle_power() const { return sums_.obstacle_power; }
    /// Force of each obstacle on all points, then that of the surfaces of laws [N].
    const std::vector<Vector3>& reactions_of_obstacles() const { return sums_.obstacle_reactions; }
    /// Points that left an obstacle at another side than they had entered, or jumped over it. Their contact has ended.
    const std::vector<Crossing>& crossings() const { return sums_.crossings; }

    const ContactAssignment& assignment(std::size_t number) const { return interactions_[number]->assignment(); }
    /// Of each assignment, see ContactInteraction.
    std::vector<double> deepest_overlap() const;
    std::vector<std::int64_t> crossed_points() const;

    /// Bounds of every point for the stable step: every law at full overlap, for the contacts at the present positions
    /// and those whose gap is below a margin. Ends must be gathered, and candidates found.
    const std::vector<ContactBound>& bounds(const Model& model);
    /// Largest angular frequency of one contact alone at the last bounds() or is_sharper() [1/s]
    double sharpest() const { return sharpest_; }
    /// Has a contact alone more than `frequency` [1/s]? Counts the contacts that exist, and those whose gap is below
    /// two thirds of the margin of bounds(), which bounds() counts too. To be called before a step: contacts that the
    /// last bounds() did not count may need a shorter one.
    bool is_sharper(const Model& model, double frequency);

    /// What lives from step to step.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points, std::size_t obstacles)
    {
        for (std::size_t a = 0; a < self.interactions_.size(); ++a)
            visit.part(std::to_string(a), *self.interactions_[a], points);
        visit.part("search", self.search_, points, obstacles);
        visit("energy", self.energy_);
        visit("sharpest_possible", any_reals(empty_or(self.sharpest_possible_, self.interactions_.size())));
    }
    /// Sets what follows from the members. The ends must have the positions of the last refresh.
    /// @param slack as for find_candidates() [m]
    /// @throws std::runtime_error when the members do not fit each other
    void resume(const Model& model, double slack);

private:
    /// Sets bounds_ and sharpest_.
    /// @param counts(number) does an assignment count?
    template <class Counts>
    void find_bounds(const Model& model, double part_of_margin, const Counts& counts);
    /// Sets the energy that each point stores in contacts with a kind of loss; leaves it empty when there are none.
    void find_stored_energy(const Model& model, RefreshLoss loss, std::vector<double>& energy);

    std::vector<std::unique_ptr<ContactInteraction>> interactions_; ///< of each assignment
    bool some_rigid_surface_ = false;
    SurfaceSearch search_; ///< the last one
    ContactSums sums_;
    double energy_ = 0.0;
    std::vector<ContactBound> bounds_;
    double sharpest_ = 0.0;
    std::vector<double> sharpest_possible_; ///< of each assignment since the last bounds(), or empty [1/s]
    // around a refresh, kept for their memory
    bool pairs_close_ = false;
    double energy_of_closing_bodies_ = 0.0; ///< before the refresh [J]
    std::vector<double> stored_before_;     ///< of each point [J]
    std::vector<double> stored_after_;
};

} // namespace periporo
