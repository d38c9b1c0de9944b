// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of the kinds of contact.
#pragma once

#include "contact/assignment.hpp"
#include "contact/contact_bound.hpp"
#include "contact/contact_sums.hpp"
#include "contact/surface_search.hpp"
#include "io/archive.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace periporo {

/// Which part of the stored energy a refresh dissipates.
enum class RefreshLoss {
    none,           ///< a refresh changes no contact of this kind
    of_points,      ///< the decrease of the energy that each point stores
    of_closed_pairs ///< the decrease of the energy of all contacts, when pairs have closed
};

/// The contacts under one assignment. A class derives from it for each kind of contact.
///
/// Values of neighbours are fields over the ends of bonds; forces at images go back with Neighbourhood::add_to_point().
/// Nothing depends on the number of threads: each point sums its own contacts, or contacts are summed in their order.
class ContactInteraction {
public:
    /// @param number of the assignment among all
    ContactInteraction(ContactAssignment assignment, std::size_t number)
        : assignment_(std::move(assignment)), number_(number)
    {
    }
    virtual ~ContactInteraction() = default;

    const ContactAssignment& assignment() const { return assignment_; }
    /// The deepest overlap of the run so far, over the reach of the contact: at 1 two points lie in one place, or a
    /// point lies in the surface; beyond that it lies behind it.
    double deepest_overlap() const { return deepest_overlap_; }
    /// Number of points that have crossed an obstacle in the run so far.
    virtual std::int64_t crossed_points() const { return 0; }

    /// Finds what may touch before the next refresh. To be called after every refresh, with gathered ends.
    /// @param slack decrease of the distance of two points until then, at most [m]
    virtual void find_candidates(const Model& model, double slack) = 0;
    /// Finds the points near a rigid surface, when points or obstacles have moved far.
    /// @param last the search before, if there was one
    virtual void find_near_points(const Model& /*model*/, const SurfaceSearch& /*last*/, const SurfaceSearch& /*now*/)
    {
    }
    /// Prepares for the obstacles that are present in the stage which begins.
    virtual void begin_stage(const Model& /*model*/) {}

    /// Adds normal forces, and friction between bodies, to `force` and to the sums.
    virtual void add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                               std::vector<Vector3>& force) = 0;
    /// Adds the friction that depends on all other forces on a point: that of rigid surfaces.
    virtual void add_friction_last(const Model& /*model*/, double /*time_step*/, ContactSums& /*sums*/,
                                   std::vector<Vector3>& /*force*/)
    {
    }

    /// Adds the bounds of the contacts that exist, and of those whose gap is below a part of the margin.
    virtual void add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds) = 0;
    /// Largest angular frequency that a contact may have, of points as they are [1/s]
    virtual double sharpest_possible(const Model& model) const = 0;

    virtual RefreshLoss refresh_loss() const { return RefreshLoss::none; }
    /// Adds to each point the energy that it stores at the positions of the ends, if a refresh can dissipate it [J].
    virtual void add_stored_energy(const Model& /*model*/, std::vector<double>& /*energy*/) {}
    /// Adds pairs of one body that are apart and have come to rest against each other, in both directions.
    virtual void add_closed_pairs(const Model& /*model*/, std::vector<ClosedPair>& /*closed*/) const {}

    /// Writes or reads what lives from step to step.
    virtual void visit_members(ArchiveWriter& archive, std::size_t points) const = 0;
    virtual void visit_members(ArchiveReader& archive, std::size_t points) = 0;
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        self.visit_members(visit, points);
    }
    /// Sets what follows from the members. The ends must have the positions of the last refresh.
    /// @throws std::runtime_error when the members do not fit each other
    virtual void resume(const Model& model, double slack, const SurfaceSearch& /*search*/)
    {
        find_candidates(model, slack);
    }

protected:
    /// Number of contacts that laws evaluate in one call.
    static constexpr std::size_t block = 128;

    const Contact& law() const { return *assignment_.law; }
    std::size_t number() const { return number_; }
    void record_overlap(double overlap) { deepest_overlap_ = std::max(deepest_overlap_, overlap); }

    double deepest_overlap_ = 0.0;

private:
    ContactAssignment assignment_;
    std::size_t number_;
};

} // namespace periporo
