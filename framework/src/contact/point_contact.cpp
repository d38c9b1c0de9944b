// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums the contacts of each point with its neighbours.
#include "contact/point_contact.hpp"

#include "periporo/first_exception.hpp"

#include <array>
#include <cmath>

namespace periporo {

template <class Visit>
void PointContact::for_each_active(const Model& model, const Visit& visit) const
{
    FirstException failure; // of the law
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t a = 0; a < active_points_.size(); ++a)
        failure.guard(a, [&] {
            for (const TouchingNeighbours& neighbours : touching(model, active_points_[a]))
                visit(active_points_[a], neighbours);
        });
    failure.rethrow();
}

template <class Visit>
void PointContact::for_each_contact(const Model& model, std::uint32_t point, const TouchingNeighbours& neighbours,
                                    const Visit& visit) const
{
    const Points& points = model.state.points;
    const Vector3 x = model.ends[point].x();
    const double cutoff = law().cutoff();
    for (const std::uint32_t c : neighbours.ends) {
        const BondEnd& other = model.ends[c];
        const Vector3 apart = x - other.x();
        const double distance = apart.norm();
        const double touching = neighbours.distance(c);
        if (distance >= touching || distance <= 0.0)
            continue;
        const ContactPair at_rest{
            distance + (cutoff - touching), 0.0, points.volume[point], other.volume, points.mass[point], other.mass};
        visit(c, Vector3(apart / distance), (touching - distance) / touching, at_rest);
    }
}

void PointContact::count_contacts(const Model& model)
{
    contacts_of_.assign(model.neighbourhood.ends(), 0);
    for_each_active(model, [&](std::uint32_t i, const TouchingNeighbours& neighbours) {
        for_each_contact(model, i, neighbours,
                         [&](std::uint32_t, const Vector3&, double, const ContactPair&) { ++contacts_of_[i]; });
    });
    model.neighbourhood.fill_images(contacts_of_);
}

void PointContact::add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                                 std::vector<Vector3>& force)
{
    find_active_points(model);
    if (active_points_.empty())
        return;
    count_contacts(model);
    overlaps_.assign(model.size(), 0.0);
    for_each_active(model, [&](std::uint32_t i, const TouchingNeighbours& neighbours) {
        if (contacts_of_[i] > 0)
            add_contacts_of(model, i, neighbours, step, sums, force);
    });
    for (const std::uint32_t i : active_points_)
        record_overlap(overlaps_[i]);
}

void PointContact::add_contacts_of(const Model& model, std::uint32_t point, const TouchingNeighbours& neighbours,
                                   const ContactStep& step, ContactSums& sums, std::vector<Vector3>& force)
{
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    std::array<Vector3, block> normals;
    std::array<Vector3, block> slips;
    std::array<double, block> shares; // contacts of the end that has more of them: each stops its share of the slip
    const Vector3 v = model.ends[point].v();
    const double mu = law().friction();
    std::size_t count = 0;
    const auto evaluate_block = [&] {
        law().evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
        for (std::size_t c = 0; c < count; ++c) {
            force[point] += responses[c].force * normals[c];
            sums.energy[point] += 0.5 * responses[c].energy; // the other end counts the other half
            sums.damping[point] += responses[c].damping_force * normals[c];
            const double speed = slips[c].norm();
            if (speed <= 0.0 || step.time_step <= 0.0)
                continue;
            const double stops = reduced_mass(pairs[c]) * speed / (step.time_step * shares[c]);
            const double size = std::min(mu * std::max(0.0, responses[c].force), stops);
            const Vector3 friction = -(size / speed) * slips[c];
            force[point] += friction;
            sums.friction[point] += friction;
        }
        count = 0;
    };
    for_each_contact(model, point, neighbours,
                     [&](std::uint32_t c, const Vector3& normal, double overlap, const ContactPair& at_rest) {
                         overlaps_[point] = std::max(overlaps_[point], overlap);
                         const Vector3 relative = v - model.ends[c].v();
                         const double opening = relative.dot(normal);
                         pairs[count] = at_rest;
                         pairs[count].approach_speed = -step.approach_factor * opening;
                         pairs[count].time_step = step.law_step;
                         normals[count] = normal;
                         slips[count] = relative - opening * normal;
                         shares[count] = std::max(contacts_of_[point], contacts_of_[c]);
                         if (++count == block)
                             evaluate_block();
                     });
    evaluate_block();
}

void PointContact::add_stored_energy(const Model& model, std::vector<double>& energy)
{
    find_active_points(model);
    for_each_active(model, [&](std::uint32_t i, const TouchingNeighbours& neighbours) {
        std::array<ContactPair, block> pairs;
        std::array<ContactResponse, block> responses;
        std::size_t count = 0;
        const auto evaluate_block = [&] {
            law().evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
            for (std::size_t c = 0; c < count; ++c)
                energy[i] += 0.5 * responses[c].energy; // the other end counts the other half
            count = 0;
        };
        for_each_contact(model, i, neighbours, [&](std::uint32_t, const Vector3&, double, const ContactPair& at_rest) {
            pairs[count] = at_rest;
            if (++count == block)
                evaluate_block();
        });
        evaluate_block();
    });
}

void PointContact::add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds)
{
    // (u_i - u_j) . n is, squared, at most 2 (u_i . n)^2 + 2 (u_j . n)^2. On a cubic and a face-centred lattice the
    // largest eigenvalue of the blocks, 4 and 8 k/m, is that of the contacts themselves.
    find_active_points(model);
    const Points& points = model.state.points;
    const double margin = part_of_margin * pair_margin * model.state.spacing;
    for_each_active(model, [&](std::uint32_t i, const TouchingNeighbours& neighbours) {
        const double mass = points.mass[i];
        for (const std::uint32_t c : neighbours.ends) {
            const BondEnd& other = model.ends[c];
            const Vector3 apart = model.ends[i].x() - other.x();
            const double distance = apart.norm();
            if (!(distance > 0.0 && distance < neighbours.distance(c) + margin))
                continue;
            const ContactPair pair{0.0, 0.0, points.volume[i], other.volume, mass, other.mass};
            add(bounds[i], apart / distance, pair, slopes(law(), pair), 2.0 / mass);
        }
    });
}

} // namespace periporo
