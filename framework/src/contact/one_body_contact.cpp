// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds pieces of a body that may touch, pairs that have closed, and the neighbours and the reach of detached points.
#include "contact/one_body_contact.hpp"

#include <cmath>
#include <limits>

namespace periporo {

void OneBodyContact::find_candidates(const Model& model, double slack)
{
    const double reach = reach_of_candidates(model, slack);
    candidates_.clear(model.size());
    for (std::uint32_t i = 0; i < model.size(); ++i) {
        if (model.state.points.body[i] == assignment().bodies[0])
            for (const std::uint32_t c : model.neighbourhood.families.apart(i))
                if ((model.ends[c].x() - model.ends[i].x()).squaredNorm() <= reach * reach)
                    candidates_.neighbours.push_back(c);
        candidates_.first[i + 1] = candidates_.neighbours.size();
    }
}

void OneBodyContact::update_reach(const Model& model)
{
    const double cutoff = law().cutoff();
    reach_.resize(model.size(), -std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model.size(); ++i) {
        double& reach = reach_[i];
        const bool detached = detached_[i] != 0;
        if (model.state.points.body[i] != assignment().bodies[0] || (!detached && reach <= -cutoff))
            continue;
        double nearest = cutoff;
        const FamilyView family = model.neighbourhood.families[i];
        for (const std::uint32_t c : std::span(family.neighbours, family.count))
            if (detached || detached_[c] != 0)
                nearest = std::min(nearest, (model.ends[c].x() - model.state.points.position[i]).norm());
        const bool detaches_now = detached && reach < 0.0;
        const double size = detaches_now ? nearest : std::max(std::abs(reach), nearest);
        reach = detached ? size : -size;
    }
    reach_of_end_.resize(model.neighbourhood.ends());
    std::ranges::transform(reach_, reach_of_end_.begin(), [](double reach) { return std::abs(reach); });
    model.neighbourhood.fill_images(reach_of_end_);
}

void OneBodyContact::find_active_points(const Model& model)
{
    detached_.assign(model.result.detached.begin(), model.result.detached.end());
    detached_.resize(model.neighbourhood.ends());
    model.neighbourhood.fill_images(detached_);
    update_reach(model);
    active_.assign(model.size(), 0);
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (!candidates_.of(i).empty())
            active_[i] = 1;
        if (detached_[i] == 0 || model.state.points.body[i] != assignment().bodies[0])
            continue;
        active_[i] = 1;
        const FamilyView family = model.neighbourhood.families[i];
        for (const std::uint32_t c : std::span(family.neighbours, family.count))
            model.neighbourhood.at_point(c, active_) = 1;
    }
    active_points_.clear();
    for (std::uint32_t i = 0; i < model.size(); ++i)
        if (active_[i] != 0)
            active_points_.push_back(i);
}

std::array<TouchingNeighbours, 2> OneBodyContact::touching(const Model& model, std::uint32_t point) const
{
    thread_local std::vector<std::uint32_t> members; // of the family, of which one end is detached; only ever grows
    members.clear();
    const FamilyView family = model.neighbourhood.families[point];
    for (const std::uint32_t c : std::span(family.neighbours, family.count))
        if (detached_[point] != 0 || detached_[c] != 0)
            members.push_back(c);
    return {{{members, {reach_of_end_[point], reach_of_end_.data()}}, {candidates_.of(point), {law().cutoff()}}}};
}

void OneBodyContact::add_closed_pairs(const Model& model, std::vector<ClosedPair>& closed) const
{
    constexpr double rest = 0.1; // energy of the motion over that of the contact
    if (!model.state.bodies[assignment().bodies[0]].material->closes())
        return;
    const Families& families = model.neighbourhood.families;
    const IsometryTable& isometries = model.neighbourhood.isometries;
    for (std::uint32_t i = 0; i < model.size(); ++i)
        for (const std::uint32_t c : candidates_.of(i)) {
            const std::uint32_t p = families.parent(c); // for the keys
            if (i > p || (i == p && families.isometry(c) > isometries.inverse(families.isometry(c))))
                continue; // the other end evaluates this pair
            const BondEnd& other = model.ends[c];
            const ContactPair pair{(model.ends[i].x() - other.x()).norm(),
                                   0.0,
                                   model.state.points.volume[i],
                                   other.volume,
                                   model.state.points.mass[i],
                                   other.mass};
            ContactResponse response;
            law().evaluate({&pair, 1}, {&response, 1});
            const Vector3 relative = model.ends[i].v() - other.v();
            if (!(response.force > 0.0 && 0.5 * reduced_mass(pair) * relative.squaredNorm() <= rest * response.energy))
                continue;
            closed.push_back({i, families.key(c)});
            closed.push_back({p, families.opposite_key(i, c, isometries)});
        }
}

} // namespace periporo
