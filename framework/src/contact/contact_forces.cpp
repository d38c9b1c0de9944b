// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "contact/contact_forces.hpp"

#include "families/cell_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace periporo {
namespace {

constexpr std::size_t block = 128;

bool names(const ContactAssignment& assignment, std::uint32_t body)
{
    return std::find(assignment.bodies.begin(), assignment.bodies.end(), body) != assignment.bodies.end();
}

bool within_one_body(const ContactAssignment& assignment)
{
    return assignment.bodies.size() == 2 && assignment.bodies[0] == assignment.bodies[1];
}

bool between_two_bodies(const ContactAssignment& assignment)
{
    return assignment.law->surface() == nullptr && assignment.bodies.size() == 2 && !within_one_body(assignment);
}

} // namespace

void ContactForces::find_candidates(const Model& model, double slack)
{
    candidates_.assign(assignments_.size(), {});
    const std::size_t n = model.size();
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        if (!between_two_bodies(assignments_[a]))
            continue;
        // Images were made within the horizon; a cut-off is shorter than that.
        std::vector<Vector3> positions(model.records.size());
        std::transform(model.records.begin(), model.records.end(), positions.begin(),
                       [](const NeighbourRecord& record) { return record.x(); });
        const double reach = assignments_[a].law->cutoff() + slack;
        const CellList cells(positions, reach);
        Candidates& candidates = candidates_[a];
        candidates.first.assign(n + 1, 0);
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t body = model.points.body[i];
            if (names(assignments_[a], body))
                cells.visit_near(positions[i], [&](std::uint32_t c) {
                    const std::uint32_t other = model.points.body[model.families.parent(c)];
                    if (other != body && names(assignments_[a], other) &&
                        (positions[c] - positions[i]).squaredNorm() <= reach * reach)
                        candidates.neighbours.push_back(c);
                });
            candidates.first[i + 1] = candidates.neighbours.size();
        }
    }
}

template <class Neighbours, class Reach>
void ContactForces::count_contacts(const Model& model, std::uint32_t point, const Neighbours& neighbours,
                                   const Reach& reach)
{
    const Vector3 x = model.records[point].x();
    contacts_of_[point] =
        static_cast<std::uint32_t>(std::count_if(neighbours.begin(), neighbours.end(), [&](std::uint32_t c) {
            const double distance = (x - model.records[c].x()).norm();
            return distance < reach(model.families.parent(c)) && distance > 0.0;
        }));
}

template <class Neighbours, class Reach>
void ContactForces::gather_pairs(const Model& model, const Contact& law, std::uint32_t point,
                                 const Neighbours& neighbours, const Reach& reach, double time_step,
                                 std::vector<Vector3>& force)
{
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    std::array<Vector3, block> normals;
    std::array<Vector3, block> slips;
    std::array<double, block> crowds; // contacts of the end that has more of them: each stops its share of the slip
    const Points& points = model.points;
    const Vector3 x = model.records[point].x();
    const Vector3 v = model.records[point].v();
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
            const double reduced = pairs[c].mass_a * pairs[c].mass_b / (pairs[c].mass_a + pairs[c].mass_b);
            const double stops = reduced * speed / (time_step * crowds[c]);
            const double size = std::min(law.friction() * responses[c].force, stops);
            const Vector3 friction = -(size / speed) * slips[c];
            force[point] += friction;
            friction_[point] += friction;
        }
        count = 0;
    };
    for (const std::uint32_t c : neighbours) {
        const Vector3 apart = x - model.records[c].x();
        const double distance = apart.norm();
        const std::uint32_t p = model.families.parent(c);
        const double touching = reach(p);
        if (distance >= touching || distance <= 0.0)
            continue;
        const Vector3 normal = apart / distance;
        const Vector3 relative = v - model.records[c].v();
        const double opening = relative.dot(normal);
        pairs[count] = {distance + (law.cutoff() - touching),
                        -approach_factor_ * opening,
                        points.volume[point],
                        points.volume[p],
                        points.mass[point],
                        points.mass[p]};
        normals[count] = normal;
        slips[count] = relative - opening * normal;
        crowds[count] = std::max(contacts_of_[point], contacts_of_[p]);
        if (++count == block)
            flush();
    }
    flush();
}

void ContactForces::add_pairs(const Model& model, std::size_t assignment, double time_step, std::vector<Vector3>& force)
{
    const Candidates& candidates = candidates_[assignment];
    if (candidates.neighbours.empty())
        return;
    const Contact& law = *assignments_[assignment].law;
    const auto n = static_cast<std::uint32_t>(model.size());
    const auto row = [&candidates](std::uint32_t i) {
        return std::span(candidates.neighbours.data() + candidates.first[i],
                         candidates.first[i + 1] - candidates.first[i]);
    };
    const auto reach = [&law](std::uint32_t) { return law.cutoff(); };
    contacts_of_.assign(n, 0);
#pragma omp parallel for schedule(dynamic, 64)
    for (std::uint32_t i = 0; i < n; ++i)
        count_contacts(model, i, row(i), reach);
#pragma omp parallel for schedule(dynamic, 64)
    for (std::uint32_t i = 0; i < n; ++i)
        if (contacts_of_[i] > 0)
            gather_pairs(model, law, i, row(i), reach, time_step, force);
}

void ContactForces::update_grain_reach(const Model& model, const ContactAssignment& assignment)
{
    const double cutoff = assignment.law->cutoff();
    grain_reach_.resize(model.size(), -std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model.size(); ++i) {
        double& reach = grain_reach_[i];
        const bool loose = model.free_grain[i] != 0;
        if (model.points.body[i] != assignment.bodies[0] || (!loose && reach <= -cutoff))
            continue;
        double nearest = cutoff;
        const FamilyView family = model.families[i];
        for (const std::uint32_t c : std::span(family.neighbours, family.count))
            if (loose || model.free_grain[model.families.parent(c)] != 0)
                nearest = std::min(nearest, (model.records[c].x() - model.points.position[i]).norm());
        const bool just_came_loose = loose && reach < 0.0;
        const double size = just_came_loose ? nearest : std::max(std::abs(reach), nearest);
        reach = loose ? size : -size;
    }
}

void ContactForces::add_free_grains(const Model& model, const ContactAssignment& assignment, double time_step,
                                    std::vector<Vector3>& force)
{
    update_grain_reach(model, assignment);
    // Points that touch a free grain, or are one.
    concerned_.assign(model.size(), 0);
    bool some = false;
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (model.free_grain[i] == 0 || model.points.body[i] != assignment.bodies[0])
            continue;
        some = true;
        concerned_[i] = 1;
        const FamilyView family = model.families[i];
        for (std::size_t b = 0; b < family.count; ++b)
            concerned_[model.families.parent(family.neighbours[b])] = 1;
    }
    if (!some)
        return;
    contacts_of_.assign(model.size(), 0);
    // Calls visit(point, partners, reach) for every point that may touch a free grain.
    const auto for_each_concerned = [&](auto&& visit) {
#pragma omp parallel
        {
            thread_local std::vector<std::uint32_t> partners; // only ever grows
#pragma omp for schedule(dynamic, 64)
            for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(model.size()); ++i) {
                if (concerned_[i] == 0)
                    continue;
                partners.clear();
                const FamilyView family = model.families[i];
                for (std::size_t b = 0; b < family.count; ++b)
                    if (model.free_grain[i] != 0 || model.free_grain[model.families.parent(family.neighbours[b])] != 0)
                        partners.push_back(family.neighbours[b]);
                visit(i, partners, [&, i](std::uint32_t other) {
                    return std::min(std::abs(grain_reach_[i]), std::abs(grain_reach_[other]));
                });
            }
        }
    };
    for_each_concerned(
        [&](std::uint32_t i, const auto& partners, const auto& reach) { count_contacts(model, i, partners, reach); });
    for_each_concerned([&](std::uint32_t i, const auto& partners, const auto& reach) {
        if (contacts_of_[i] > 0)
            gather_pairs(model, *assignment.law, i, partners, reach, time_step, force);
    });
}

void ContactForces::add_surface(const Model& model, const ContactAssignment& assignment, std::vector<Vector3>& force)
{
    const RigidSurface& surface = *assignment.law->surface();
    const double reach = assignment.law->cutoff();
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    std::array<std::uint32_t, block> touching;
    std::array<Vector3, block> normals;
    std::size_t count = 0;
    const auto flush = [&] {
        assignment.law->evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
        for (std::size_t c = 0; c < count; ++c) {
            force[touching[c]] += responses[c].force * normals[c];
            point_energy_[touching[c]] += responses[c].energy;
            damping_[touching[c]] += responses[c].damping_force * normals[c];
            surface_contacts_.push_back({touching[c], assignment.law->friction(), responses[c].force, normals[c]});
        }
        count = 0;
    };
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(model.size()); ++i) {
        if (!names(assignment, model.points.body[i]))
            continue;
        Vector3 normal;
        const double distance = surface.distance(model.points.position[i], normal);
        if (distance >= reach)
            continue;
        pairs[count] = {distance,
                        -approach_factor_ * model.points.velocity[i].dot(normal),
                        model.points.volume[i],
                        0.0,
                        model.points.mass[i],
                        0.0};
        touching[count] = i;
        normals[count] = normal;
        if (++count == block)
            flush();
    }
    flush();
}

void ContactForces::add_reactions(const Model& model, double time_step, Approach approach, std::vector<Vector3>& force)
{
    approach_factor_ = approach == Approach::real ? 1.0 : 0.0;
    friction_.assign(model.size(), Vector3::Zero());
    point_energy_.assign(model.size(), 0.0);
    damping_.assign(model.size(), Vector3::Zero());
    surface_contacts_.clear();
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        if (assignments_[a].law->surface() != nullptr)
            add_surface(model, assignments_[a], force);
        else if (within_one_body(assignments_[a]))
            add_free_grains(model, assignments_[a], time_step, force);
        else
            add_pairs(model, a, time_step, force);
    }
    energy_ = 0.0;
    for (const double energy : point_energy_)
        energy_ += energy;
}

void ContactForces::add_surface_friction(const Model& model, double time_step, std::vector<Vector3>& force)
{
    if (time_step <= 0.0)
        return;
    for (const SurfaceContact& contact : surface_contacts_) {
        const std::uint32_t i = contact.point;
        const Vector3 drive = force[i] + model.points.mass[i] / time_step * model.points.velocity[i];
        const Vector3 tangential = drive - drive.dot(contact.normal) * contact.normal;
        const double size = tangential.norm();
        if (size <= 0.0)
            continue;
        const Vector3 friction = -(std::min(contact.friction * contact.force, size) / size) * tangential;
        force[i] += friction;
        friction_[i] += friction;
    }
}

ContactBound ContactForces::bound(const Model& model) const
{
    constexpr double slow = 1e-6; // [m/s]: the slope of the dashpot, however the law writes it
    ContactBound largest;
    for (const ContactAssignment& assignment : assignments_) {
        const bool surface = assignment.law->surface() != nullptr;
        const double partners = surface ? 1.0 : 12.0; // six, each moving against the point
        for (std::size_t i = 0; i < model.size(); ++i) {
            if (!names(assignment, model.points.body[i]))
                continue;
            const double v = model.points.volume[i];
            const double m = model.points.mass[i];
            const ContactPair pairs[2] = {{0.0, 0.0, v, surface ? 0.0 : v, m, surface ? 0.0 : m},
                                          {0.0, slow, v, surface ? 0.0 : v, m, surface ? 0.0 : m}};
            ContactResponse responses[2];
            assignment.law->evaluate(pairs, responses);
            largest.frequency_squared = std::max(largest.frequency_squared, partners * responses[0].stiffness / m);
            largest.damping_rate =
                std::max(largest.damping_rate, partners * (responses[1].force - responses[0].force) / (slow * m));
        }
    }
    return largest;
}

} // namespace periporo
