// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What contacts, present or soon to begin, mean for the stable step.
#include "contact/assignment.hpp"
#include "contact/contact_forces.hpp"
#include "contact/contact_slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace periporo {
namespace {

/// Of the margin of bounds(). With a whole margin a contact at its edge could ask for a bound that does not count it.
constexpr double soon = 2.0 / 3.0;
/// Volumes change between two estimates, and the stiffness of a contact may grow with their product.
constexpr double change_of_volume = 1.1;

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;

    void add(double value)
    {
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
};

double frequency(const Contact& law, const ContactPair& pair)
{
    return std::sqrt(sharpness(pair, slopes(law, pair)));
}

} // namespace

template <class Takes>
void ContactForces::find_bounds(const Model& model, double part_of_margin, const Takes& takes)
{
    follow_surfaces(model);
    bounds_.assign(model.size(), {});
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        if (!takes(a))
            continue;
        const double at_surfaces = part_of_margin * surface_margin * model.state.spacing;
        if (at_rigid_surface(assignments_[a]))
            bound_surface(model, a, at_surfaces);
        else if (assignments_[a].surface_body)
            bound_supported(model, a, at_surfaces);
        else
            bound_pairs(model, a, part_of_margin * pair_margin * model.state.spacing);
    }
    sharpest_ = 0.0;
    for (const ContactBound& bound : bounds_)
        sharpest_ = std::max(sharpest_, bound.sharpest);
    sharpest_ = std::sqrt(sharpest_);
}

const std::vector<ContactBound>& ContactForces::bounds(const Model& model)
{
    possible_.clear();
    find_bounds(model, 1.0, [](std::size_t) { return true; });
    return bounds_;
}

bool ContactForces::is_sharper(const Model& model, double frequency)
{
    if (possible_.size() != assignments_.size()) {
        possible_.clear();
        for (std::size_t a = 0; a < assignments_.size(); ++a)
            possible_.push_back(sharpest_possible(model, a));
    }
    const auto may_be_sharper = [&](std::size_t a) { return change_of_volume * possible_[a] > frequency; };
    if (std::ranges::none_of(possible_, [&](double possible) { return change_of_volume * possible > frequency; }))
        return false;
    find_bounds(model, soon, may_be_sharper);
    return sharpest_ > frequency;
}

double ContactForces::sharpest_possible(const Model& model, std::size_t assignment) const
{
    const ContactAssignment& at = assignments_[assignment];
    const Contact& law = *at.law;
    const Points& points = model.state.points;
    double largest = 0.0;
    if (at_rigid_surface(at)) {
        for (std::size_t i = 0; i < model.size(); ++i)
            if (names(at, points.body[i]))
                largest = std::max(largest, frequency(law, {0.0, 0.0, points.volume[i], 0.0, points.mass[i], 0.0}));
        return largest;
    }
    std::array<Range, 2> volumes, masses;
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t side = 0; side < 2; ++side)
            if (points.body[i] == at.bodies[side]) {
                volumes[side].add(points.volume[i]);
                masses[side].add(points.mass[i]);
            }
    for (const double a : {volumes[0].least, volumes[0].largest})
        for (const double b : {volumes[1].least, volumes[1].largest})
            largest = std::max(largest, frequency(law, {0.0, 0.0, a, b, masses[0].least, masses[1].least}));
    return largest;
}

void ContactForces::bound_surface(const Model& model, std::size_t assignment, double margin)
{
    const ContactAssignment& at = assignments_[assignment];
    const RigidContactSurface surface(model, at);
    if (!surface.present())
        return;
    for (const std::uint32_t i : near_surface_[assignment]) {
        Vector3 normal;
        if (surface.distance(model.state.points.position[i], normal) >= at.law->cutoff() + margin)
            continue;
        const double mass = model.state.points.mass[i];
        const ContactPair pair{0.0, 0.0, model.state.points.volume[i], 0.0, mass, 0.0};
        if (surface.may_hold_in_corner(model.state.points.position[i], at.law->cutoff() + margin))
            add_everywhere(bounds_[i], pair, slopes(*at.law, pair), 1.0 / mass);
        else
            add(bounds_[i], normal, pair, slopes(*at.law, pair), 1.0 / mass);
    }
}

} // namespace periporo
