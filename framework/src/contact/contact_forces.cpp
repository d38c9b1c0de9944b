// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Makes the kind of each contact, and sums over all.
#include "contact/contact_forces.hpp"

#include "contact/one_body_contact.hpp"
#include "contact/rigid_surface_contact.hpp"
#include "contact/smoothed_surface_contact.hpp"
#include "contact/two_body_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace periporo {
namespace {

/// Part of the margin of bounds() that counts before a step. With the whole margin a contact at its edge could ask for
/// a bound that does not count it.
constexpr double part_of_margin_before_step = 2.0 / 3.0;
/// Volumes change between two estimates, and the stiffness of a contact may grow with their product.
constexpr double change_of_volume = 1.1;

std::unique_ptr<ContactInteraction> make_interaction(ContactAssignment assignment, std::size_t number)
{
    if (at_rigid_surface(assignment))
        return std::make_unique<RigidSurfaceContact>(std::move(assignment), number);
    if (assignment.surface_body)
        return std::make_unique<SmoothedSurfaceContact>(std::move(assignment), number);
    if (within_one_body(assignment))
        return std::make_unique<OneBodyContact>(std::move(assignment), number);
    return std::make_unique<TwoBodyContact>(std::move(assignment), number);
}

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

} // namespace

ContactForces::ContactForces(std::vector<ContactAssignment> assignments)
    : some_rigid_surface_(std::ranges::any_of(assignments, at_rigid_surface))
{
    for (ContactAssignment& assignment : assignments)
        interactions_.push_back(make_interaction(std::move(assignment), interactions_.size()));
}

void ContactForces::find_candidates(const Model& model, double slack)
{
    for (const auto& interaction : interactions_)
        interaction->find_candidates(model, slack);
    update_near_points(model);
}

void ContactForces::update_near_points(const Model& model)
{
    if (!some_rigid_surface_ || !search_.is_outdated(model))
        return;
    const SurfaceSearch last = std::exchange(search_, SurfaceSearch::at_present(model));
    for (const auto& interaction : interactions_)
        interaction->find_near_points(model, last, search_);
}

std::vector<ClosedPair> ContactForces::begin_refresh(const Model& model)
{
    std::vector<ClosedPair> closed;
    for (const auto& interaction : interactions_)
        interaction->add_closed_pairs(model, closed);
    std::ranges::sort(closed);
    closed.erase(std::unique(closed.begin(), closed.end()), closed.end());
    pairs_close_ = !closed.empty();
    if (pairs_close_) {
        find_stored_energy(model, RefreshLoss::of_closed_pairs, stored_before_);
        energy_of_closing_bodies_ = sum(stored_before_);
    }
    find_stored_energy(model, RefreshLoss::of_points, stored_before_);
    return closed;
}

void ContactForces::end_refresh(const Model& model, double slack, double& dissipated)
{
    find_candidates(model, slack);
    find_stored_energy(model, RefreshLoss::of_points, stored_after_);
    for (std::size_t i = 0; i < stored_after_.size(); ++i)
        dissipated += std::max(0.0, stored_before_[i] - stored_after_[i]);
    if (!pairs_close_)
        return;
    // Bonds replace the contacts that close, and the energy of these is dissipated.
    find_stored_energy(model, RefreshLoss::of_closed_pairs, stored_after_);
    dissipated += energy_of_closing_bodies_ - sum(stored_after_);
}

void ContactForces::find_stored_energy(const Model& model, RefreshLoss loss, std::vector<double>& energy)
{
    energy.clear();
    for (const auto& interaction : interactions_) {
        if (interaction->refresh_loss() != loss)
            continue;
        energy.resize(model.size(), 0.0);
        interaction->add_stored_energy(model, energy);
    }
}

void ContactForces::begin_stage(const Model& model)
{
    for (const auto& interaction : interactions_)
        interaction->begin_stage(model);
}

void ContactForces::add_reactions(const Model& model, double time_step, Approach approach, std::vector<Vector3>& force)
{
    const double approach_factor = approach == Approach::real ? 1.0 : 0.0;
    const ContactStep step{time_step, approach_factor, approach_factor * time_step};
    sums_.reset(model.size(), model.state.obstacles.size());
    for (const auto& interaction : interactions_)
        interaction->add_reactions(model, step, sums_, force);
    energy_ = sum(sums_.energy);
}

void ContactForces::add_surface_friction(const Model& model, double time_step, std::vector<Vector3>& force)
{
    for (const auto& interaction : interactions_)
        interaction->add_friction_last(model, time_step, sums_, force);
}

std::vector<double> ContactForces::deepest_overlap() const
{
    std::vector<double> deepest;
    for (const auto& interaction : interactions_)
        deepest.push_back(interaction->deepest_overlap());
    return deepest;
}

std::vector<std::int64_t> ContactForces::crossed_points() const
{
    std::vector<std::int64_t> crossed;
    for (const auto& interaction : interactions_)
        crossed.push_back(interaction->crossed_points());
    return crossed;
}

template <class Counts>
void ContactForces::find_bounds(const Model& model, double part_of_margin, const Counts& counts)
{
    update_near_points(model);
    bounds_.assign(model.size(), {});
    for (std::size_t a = 0; a < interactions_.size(); ++a)
        if (counts(a))
            interactions_[a]->add_bounds(model, part_of_margin, bounds_);
    double squared = 0.0;
    for (const ContactBound& bound : bounds_)
        squared = std::max(squared, bound.sharpest);
    sharpest_ = std::sqrt(squared);
}

const std::vector<ContactBound>& ContactForces::bounds(const Model& model)
{
    sharpest_possible_.clear();
    find_bounds(model, 1.0, [](std::size_t) { return true; });
    return bounds_;
}

bool ContactForces::is_sharper(const Model& model, double frequency)
{
    if (sharpest_possible_.size() != interactions_.size()) {
        sharpest_possible_.clear();
        for (const auto& interaction : interactions_)
            sharpest_possible_.push_back(interaction->sharpest_possible(model));
    }
    const auto may_be_sharper = [&](double possible) { return change_of_volume * possible > frequency; };
    if (std::ranges::none_of(sharpest_possible_, may_be_sharper))
        return false;
    find_bounds(model, part_of_margin_before_step,
                [&](std::size_t a) { return may_be_sharper(sharpest_possible_[a]); });
    return sharpest_ > frequency;
}

void ContactForces::resume(const Model& model, double slack)
{
    if (search_.exists() && !search_.fits(model))
        throw std::runtime_error("the contacts that were kept do not fit each other");
    for (const auto& interaction : interactions_)
        interaction->resume(model, slack, search_);
}

} // namespace periporo
