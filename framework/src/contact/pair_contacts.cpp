// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of points with points: of two bodies, of pieces of one body, and of free grains with all others of theirs.
#include "contact/assignment.hpp"
#include "contact/contact_forces.hpp"
#include "contact/contact_slopes.hpp"
#include "neighbourhood/cell_list.hpp"
#include "periporo/first_exception.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace periporo {
namespace {

constexpr std::size_t block = 128;

/// Around the points and images of a body, `reach` wider on all sides.
Bounds box_of(const Model& model, std::uint32_t body, double reach)
{
    Bounds box{Vector3::Constant(std::numeric_limits<double>::infinity()),
               Vector3::Constant(-std::numeric_limits<double>::infinity())};
    for (std::uint32_t c = 0; c < model.ends.size(); ++c)
        if (model.state.points.body[model.neighbourhood.families.parent(c)] == body) {
            box.lower = box.lower.cwiseMin(model.ends[c].x());
            box.upper = box.upper.cwiseMax(model.ends[c].x());
        }
    box.lower.array() -= reach;
    box.upper.array() += reach;
    return box;
}

bool lies_in(const Bounds& box, const Vector3& x)
{
    return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

} // namespace

void ContactForces::find_pairs(const Model& model, std::size_t assignment, double slack)
{
    const ContactAssignment& at = assignments_[assignment];
    const std::size_t n = model.size();
    // Images were made within the horizon; a cut-off is shorter than that. The margin is that of bounds().
    const double reach = at.law->cutoff() + slack + pair_margin * model.state.spacing;
    // Only what lies in the box of the other body, widened by the reach, can touch it.
    std::array<Bounds, 2> boxes;
    for (std::size_t b = 0; b < 2; ++b)
        boxes[b] = box_of(model, at.bodies[b], reach);
    std::vector<std::uint32_t> near;
    std::vector<Vector3> positions;
    for (std::uint32_t c = 0; c < model.ends.size(); ++c) {
        const std::uint32_t body = model.state.points.body[model.neighbourhood.families.parent(c)];
        if (!names(at, body) || !lies_in(boxes[body == at.bodies[0] ? 1 : 0], model.ends[c].x()))
            continue;
        near.push_back(c);
        positions.push_back(model.ends[c].x());
    }
    Candidates& candidates = candidates_[assignment];
    candidates.first.assign(n + 1, 0);
    if (near.empty())
        return;
    const CellList cells(positions, reach);
    std::size_t next = 0; // of near, which begins with points, in their order
    for (std::uint32_t i = 0; i < n; ++i) {
        if (next < near.size() && near[next] == i) {
            const std::uint32_t body = model.state.points.body[i];
            cells.visit_near(positions[next], [&](std::uint32_t c) {
                if (model.state.points.body[model.neighbourhood.families.parent(near[c])] != body &&
                    (positions[c] - positions[next]).squaredNorm() <= reach * reach)
                    candidates.neighbours.push_back(near[c]);
            });
            ++next;
        }
        candidates.first[i + 1] = candidates.neighbours.size();
    }
}

void ContactForces::find_pairs_apart(const Model& model, std::size_t assignment, double slack)
{
    const ContactAssignment& at = assignments_[assignment];
    const double reach = at.law->cutoff() + slack + pair_margin * model.state.spacing;
    Candidates& candidates = candidates_[assignment];
    candidates.first.assign(model.size() + 1, 0);
    for (std::uint32_t i = 0; i < model.size(); ++i) {
        if (model.state.points.body[i] == at.bodies[0])
            for (const std::uint32_t c : model.neighbourhood.families.apart(i))
                if ((model.ends[c].x() - model.ends[i].x()).squaredNorm() <= reach * reach)
                    candidates.neighbours.push_back(c);
        candidates.first[i + 1] = candidates.neighbours.size();
    }
}

template <class Reach>
void ContactForces::gather_pairs(const Model& model, const Contact& law, std::uint32_t point,
                                 std::span<const std::uint32_t> neighbours, const Reach& reach, double time_step,
                                 std::vector<Vector3>& force)
{
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    std::array<Vector3, block> normals;
    std::array<Vector3, block> slips;
    std::array<double, block> crowds; // contacts of the end that has more of them: each stops its share of the slip
    const Points& points = model.state.points;
    const Vector3 x = model.ends[point].x();
    const Vector3 v = model.ends[point].v();
    std::size_t count = 0;
    const auto flush = [&] {
        law.evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
        for (std::size_t c = 0; c < count; ++c) {
            force[point] += responses[c].force * normals[c];
            // The partner, or its parent, counts the other half.
            point_energy_[point] += 0.5 * responses[c].energy;
            damping_[point] += responses[c].damping_force * normals[c];
            const double speed = slips[c].norm();
            if (speed <= 0.0 || time_step <= 0.0)
                continue;
            const double stops = reduced_mass(pairs[c]) * speed / (time_step * crowds[c]);
            const double size = std::min(law.friction() * std::max(0.0, responses[c].force), stops);
            const Vector3 friction = -(size / speed) * slips[c];
            force[point] += friction;
            friction_[point] += friction;
        }
        count = 0;
    };
    for (const std::uint32_t c : neighbours) {
        const Vector3 apart = x - model.ends[c].x();
        const double distance = apart.norm();
        const std::uint32_t p = model.neighbourhood.families.parent(c);
        const double touching = reach(p);
        if (distance >= touching || distance <= 0.0)
            continue;
        overlap_[point] = std::max(overlap_[point], (touching - distance) / touching);
        const Vector3 normal = apart / distance;
        const Vector3 relative = v - model.ends[c].v();
        const double opening = relative.dot(normal);
        pairs[count] = {distance + (law.cutoff() - touching),
                        -approach_factor_ * opening,
                        points.volume[point],
                        points.volume[p],
                        points.mass[point],
                        points.mass[p],
                        law_step_};
        normals[count] = normal;
        slips[count] = relative - opening * normal;
        crowds[count] = std::max(contacts_of_[point], contacts_of_[p]);
        if (++count == block)
            flush();
    }
    flush();
}

void ContactForces::update_grain_reach(const Model& model, const ContactAssignment& assignment)
{
    const double cutoff = assignment.law->cutoff();
    grain_reach_.resize(model.size(), -std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model.size(); ++i) {
        double& reach = grain_reach_[i];
        const bool loose = model.result.detached[i] != 0;
        if (model.state.points.body[i] != assignment.bodies[0] || (!loose && reach <= -cutoff))
            continue;
        double nearest = cutoff;
        const FamilyView family = model.neighbourhood.families[i];
        for (const std::uint32_t c : std::span(family.neighbours, family.count))
            if (loose || model.result.detached[model.neighbourhood.families.parent(c)] != 0)
                nearest = std::min(nearest, (model.ends[c].x() - model.state.points.position[i]).norm());
        const bool just_came_loose = loose && reach < 0.0;
        const double size = just_came_loose ? nearest : std::max(std::abs(reach), nearest);
        reach = loose ? size : -size;
    }
}

bool ContactForces::find_concerned(const Model& model, std::size_t assignment)
{
    const std::uint32_t body = assignments_[assignment].bodies[0];
    const Candidates& apart = candidates_[assignment];
    update_grain_reach(model, assignments_[assignment]);
    concerned_.assign(model.size(), 0);
    bool some = !apart.neighbours.empty();
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (!apart.of(i).empty())
            concerned_[i] = 1;
        if (model.result.detached[i] == 0 || model.state.points.body[i] != body)
            continue;
        some = true;
        concerned_[i] = 1;
        const FamilyView family = model.neighbourhood.families[i];
        for (std::size_t b = 0; b < family.count; ++b)
            concerned_[model.neighbourhood.families.parent(family.neighbours[b])] = 1;
    }
    return some;
}

bool ContactForces::may_touch(const Model& model, std::size_t assignment)
{
    return within_one_body(assignments_[assignment]) ? find_concerned(model, assignment)
                                                     : !candidates_[assignment].neighbours.empty();
}

template <class Visit>
void ContactForces::for_each_touching(const Model& model, std::size_t assignment, const Visit& visit) const
{
    const auto n = static_cast<std::uint32_t>(model.size());
    const Candidates& candidates = candidates_[assignment];
    const double cutoff = assignments_[assignment].law->cutoff();
    const auto whole_reach = [cutoff](std::uint32_t) { return cutoff; };
    FirstException failure; // of the law
    if (!within_one_body(assignments_[assignment])) {
#pragma omp parallel for schedule(dynamic, 64)
        for (std::uint32_t i = 0; i < n; ++i)
            failure.guard(i, [&] { visit(i, candidates.of(i), whole_reach); });
        failure.rethrow();
        return;
    }
#pragma omp parallel
    {
        thread_local std::vector<std::uint32_t> partners; // only ever grows
        const auto visit_concerned = [&](std::uint32_t i) {
            if (concerned_[i] == 0)
                return;
            partners.clear();
            const FamilyView family = model.neighbourhood.families[i];
            for (std::size_t b = 0; b < family.count; ++b)
                if (model.result.detached[i] != 0 ||
                    model.result.detached[model.neighbourhood.families.parent(family.neighbours[b])] != 0)
                    partners.push_back(family.neighbours[b]);
            visit(i, std::span<const std::uint32_t>(partners), [this, i](std::uint32_t other) {
                return std::min(std::abs(grain_reach_[i]), std::abs(grain_reach_[other]));
            });
            visit(i, candidates.of(i), whole_reach); // pieces apart met from outside
        };
#pragma omp for schedule(dynamic, 64)
        for (std::uint32_t i = 0; i < n; ++i)
            failure.guard(i, [&] { visit_concerned(i); });
    }
    failure.rethrow();
}

void ContactForces::add_pairs(const Model& model, std::size_t assignment, double time_step, std::vector<Vector3>& force)
{
    if (!may_touch(model, assignment))
        return;
    contacts_of_.assign(model.size(), 0);
    overlap_.assign(model.size(), 0.0);
    for_each_touching(model, assignment, [&](std::uint32_t i, std::span<const std::uint32_t> others, auto reach) {
        contacts_of_[i] += static_cast<std::uint32_t>(std::ranges::count_if(others, [&](std::uint32_t c) {
            const double distance = (model.ends[i].x() - model.ends[c].x()).norm();
            return distance < reach(model.neighbourhood.families.parent(c)) && distance > 0.0;
        }));
    });
    const Contact& law = *assignments_[assignment].law;
    for_each_touching(model, assignment, [&](std::uint32_t i, std::span<const std::uint32_t> others, auto reach) {
        if (contacts_of_[i] > 0)
            gather_pairs(model, law, i, others, reach, time_step, force);
    });
    for (const double overlap : overlap_)
        note_overlap(assignment, overlap);
}

std::vector<ClosedPair> ContactForces::closed_pairs(const Model& model) const
{
    constexpr double calm = 0.1; // energy of the motion over that of the contact
    std::vector<ClosedPair> closed;
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        const ContactAssignment& at = assignments_[a];
        if (!within_one_body(at) || !model.state.bodies[at.bodies[0]].material->closes())
            continue;
        for (std::uint32_t i = 0; i < model.size(); ++i)
            for (const std::uint32_t c : candidates_[a].of(i)) {
                const std::uint32_t p = model.neighbourhood.families.parent(c);
                const std::uint32_t opposite =
                    model.neighbourhood.isometries.inverse(model.neighbourhood.families.isometry(c));
                if (i > p || (i == p && model.neighbourhood.families.isometry(c) > opposite))
                    continue; // seen from the other end
                const Vector3 relative = model.ends[i].v() - model.ends[c].v();
                const ContactPair pair{(model.ends[i].x() - model.ends[c].x()).norm(),
                                       0.0,
                                       model.state.points.volume[i],
                                       model.state.points.volume[p],
                                       model.state.points.mass[i],
                                       model.state.points.mass[p]};
                ContactResponse response;
                at.law->evaluate({&pair, 1}, {&response, 1});
                if (!(response.force > 0.0 &&
                      0.5 * reduced_mass(pair) * relative.squaredNorm() <= calm * response.energy))
                    continue;
                closed.push_back({i, model.neighbourhood.families.key(c)});
                closed.push_back({p, model.neighbourhood.families.opposite_key(i, c, model.neighbourhood.isometries)});
            }
    }
    std::ranges::sort(closed);
    closed.erase(std::unique(closed.begin(), closed.end()), closed.end());
    return closed;
}

double ContactForces::energy_within_bodies(const Model& model)
{
    approach_factor_ = 0.0;
    point_energy_.assign(model.size(), 0.0);
    // add_reactions() sets these anew
    damping_.assign(model.size(), Vector3::Zero());
    friction_.assign(model.size(), Vector3::Zero());
    std::vector<Vector3> force(model.size(), Vector3::Zero());
    for (std::size_t a = 0; a < assignments_.size(); ++a)
        if (within_one_body(assignments_[a]))
            add_pairs(model, a, 0.0, force);
    double energy = 0.0;
    for (const double one : point_energy_)
        energy += one;
    return energy;
}

void ContactForces::bound_pairs(const Model& model, std::size_t assignment, double margin)
{
    // (u_i - u_j) . n is, squared, at most 2 (u_i . n)^2 + 2 (u_j . n)^2. On a cubic and a face-centred lattice the
    // largest eigenvalue of the blocks, 4 and 8 k/m, is that of the contacts themselves.
    if (!may_touch(model, assignment))
        return;
    const Contact& law = *assignments_[assignment].law;
    for_each_touching(model, assignment, [&](std::uint32_t i, std::span<const std::uint32_t> others, auto reach) {
        const double mass = model.state.points.mass[i];
        for (const std::uint32_t c : others) {
            const std::uint32_t p = model.neighbourhood.families.parent(c);
            const Vector3 apart = model.ends[i].x() - model.ends[c].x();
            const double distance = apart.norm();
            if (!(distance > 0.0 && distance < reach(p) + margin))
                continue;
            const ContactPair pair{
                0.0, 0.0, model.state.points.volume[i], model.state.points.volume[p], mass, model.state.points.mass[p]};
            add(bounds_[i], apart / distance, pair, slopes(law, pair), 2.0 / mass);
        }
    });
}

} // namespace periporo
