// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of points with points: forces, energy and bounds, whichever points may touch.
#pragma once

#include "contact/contact_interaction.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

/// Distance below which a point touches its neighbours [m].
struct TouchDistance {
    double own;                      ///< reach of the point
    const double* of_ends = nullptr; ///< reach of each end of bonds, where it is not the same for all

    double operator()(std::uint32_t end) const { return of_ends == nullptr ? own : std::min(own, of_ends[end]); }
};

/// Neighbours that a point may touch. The list is valid until the next one of the same thread is found.
struct TouchingNeighbours {
    std::span<const std::uint32_t> ends;
    TouchDistance distance{};
};

/// Each point sums its own contacts. Both directions of a pair are evaluated with the same numbers, so that forces are
/// opposite to the last bit.
class PointContact : public ContactInteraction {
public:
    using ContactInteraction::ContactInteraction;

    void add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                       std::vector<Vector3>& force) override;
    void add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds) override;
    double sharpest_possible(const Model& model) const override { return sharpest_between_points(model, assignment()); }
    void add_stored_energy(const Model& model, std::vector<double>& energy) override;

protected:
    /// Neighbours (ends of bonds) of each point in compressed rows.
    struct Candidates {
        std::vector<std::size_t> first;
        std::vector<std::uint32_t> neighbours;

        std::span<const std::uint32_t> of(std::size_t point) const
        {
            if (neighbours.empty())
                return {};
            return {neighbours.data() + first[point], first[point + 1] - first[point]};
        }
        void clear(std::size_t points)
        {
            first.assign(points + 1, 0);
            neighbours.clear();
        }
    };

    /// Sets active_points_: those that may touch another point now, ascending.
    virtual void find_active_points(const Model& model) = 0;
    /// The neighbours of an active point, in one or two lists.
    virtual std::array<TouchingNeighbours, 2> touching(const Model& model, std::uint32_t point) const = 0;

    /// Distance within which find_candidates() must find pairs [m]. Images were made within the horizon; a cut-off is
    /// shorter than that.
    double reach_of_candidates(const Model& model, double slack) const
    {
        return law().cutoff() + slack + pair_margin * model.state.spacing;
    }

    Candidates candidates_;
    std::vector<std::uint32_t> active_points_;

private:
    /// Calls visit(point, neighbours) for each active point and each list of its neighbours. In parallel.
    template <class Visit>
    void for_each_active(const Model& model, const Visit& visit) const;
    /// Calls visit(end, normal, overlap over the distance of touch, pair at rest) for each contact of a point.
    template <class Visit>
    void for_each_contact(const Model& model, std::uint32_t point, const TouchingNeighbours& neighbours,
                          const Visit& visit) const;
    void count_contacts(const Model& model);
    /// Sums the contacts of a point with its neighbours.
    void add_contacts_of(const Model& model, std::uint32_t point, const TouchingNeighbours& neighbours,
                         const ContactStep& step, ContactSums& sums, std::vector<Vector3>& force);

    /// Contacts of each end of bonds. Friction that stops the slip of a pair within a step is divided by the larger
    /// number of its two ends: together they stop a point and never throw it back.
    std::vector<std::uint32_t> contacts_of_;
    std::vector<double> overlaps_; ///< the deepest of each point, over the distance of first touch
};

} // namespace periporo
