// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reactions and friction of rigid surfaces, and the points that are near them.
#include "contact/rigid_surface_contact.hpp"

#include "contact/corner_dashpot.hpp"
#include "contact/rigid_contact_surface.hpp"
#include "periporo/first_exception.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace periporo {
namespace {

/// A point with less overlap over reach counts as resting on a surface that first acts.
constexpr double bearing_overlap = 0.1;
/// A point with less reach over that of the law has no side from which it came.
constexpr double least_reach = 1e-3;

const Vector3 unknown_position = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());

bool is_known(const Vector3& position)
{
    return position.x() == position.x();
}

} // namespace

void RigidSurfaceContact::find_near_points(const Model& model, const SurfaceSearch& last, const SurfaceSearch& now)
{
    list_near_points(model, now);
    if (!assignment().obstacle)
        return;
    const std::uint32_t obstacle = *assignment().obstacle;
    std::vector<Vector3> positions(model.size(), unknown_position);
    const bool was_free = last.positions.size() == model.size() && model.state.obstacles[obstacle].present;
    for (const std::uint32_t i : near_points_) {
        if (free_positions_.size() == model.size() && is_known(free_positions_[i]))
            positions[i] = free_positions_[i];
        else if (was_free) // and the point may have jumped over the obstacle since
            positions[i] = last.positions[i] - last.shifts.at(obstacle);
    }
    free_positions_ = std::move(positions);
}

void RigidSurfaceContact::list_near_points(const Model& model, const SurfaceSearch& search)
{
    near_points_.clear();
    std::vector<std::uint8_t> near(model.size(), 0);
    const RigidContactSurface surface(model, assignment());
    const double reach = law().cutoff() + (surface_margin + SurfaceSearch::skin) * model.state.spacing;
    const Vector3 shift = assignment().obstacle ? search.shifts[*assignment().obstacle] : Vector3(Vector3::Zero());
    FirstException failure; // of the geometry
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t i = 0; i < model.size(); ++i)
        failure.guard(i, [&] {
            near[i] =
                names(assignment(), model.state.points.body[i]) && surface.is_near(search.positions[i] - shift, reach);
        });
    failure.rethrow();
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(model.size()); ++i)
        if (near[i] != 0)
            near_points_.push_back(i);
}

void RigidSurfaceContact::begin_stage(const Model& model)
{
    const RigidContactSurface surface(model, assignment());
    const bool first_acts = surface.present() && reach_.empty();
    if (!surface.present())
        reach_.clear();
    if (assignment().obstacle && (!surface.present() || first_acts))
        free_positions_.assign(model.size(), unknown_position);
    if (!first_acts)
        return;
    const double reach = law().cutoff();
    reach_.assign(model.size(), reach);
    for (const std::uint32_t i : near_points_) {
        Vector3 normal;
        const double distance = surface.distance(model.state.points.position[i], normal);
        if (distance >= (1.0 - bearing_overlap) * reach)
            continue;
        const ContactPair pair{distance, 0.0, model.state.points.volume[i], 0.0, model.state.points.mass[i], 0.0};
        ContactResponse response;
        law().evaluate({&pair, 1}, {&response, 1});
        if (response.force > 0.0) // and not within the reach of a pull
            reach_[i] = distance;
    }
}

void RigidSurfaceContact::resume(const Model& model, double /*slack*/, const SurfaceSearch& search)
{
    if (stored_points_.size() != stored_energies_.size() ||
        (search.exists() && assignment().obstacle && free_positions_.size() != model.size()))
        throw std::runtime_error("the contacts that were kept do not fit each other");
    if (search.exists())
        list_near_points(model, search);
}

std::size_t RigidSurfaceContact::number_of_reaction(const Model& model) const
{
    return assignment().obstacle ? *assignment().obstacle : model.state.obstacles.size();
}

void RigidSurfaceContact::add_reaction(const Model& model, const ContactStep& step, const ContactPair& pair,
                                       const ContactResponse& response, std::uint32_t point, const ShortestExit& exit,
                                       ContactSums& sums, std::vector<Vector3>& force)
{
    const Vector3 velocity = RigidContactSurface(model, assignment()).velocity();
    const Vector3 direction = exit.faces == 1 ? exit.normals[0] : Vector3(exit.move.normalized());
    Vector3 reaction = response.force * direction;
    Vector3 damping = response.damping_force * direction;
    if (exit.faces > 1 && step.approach_factor > 0.0) {
        const Vector3 braking =
            corner_dashpot(law(), pair, exit, model.state.points.velocity[point] - velocity, reaction);
        reaction += braking;
        damping += braking;
    }
    force[point] += reaction;
    sums.damping[point] += damping;
    sums.energy[point] += response.energy;
    sums.obstacle_power.reaction += reaction.dot(velocity);
    sums.obstacle_power.damping += damping.dot(velocity);
    sums.obstacle_reactions[number_of_reaction(model)] += reaction;
    touches_.push_back({point, exit.normal_force_factor() * response.force, direction});
    stored_points_.push_back(point);
    stored_energies_.push_back(response.energy);
}

ShortestExit RigidSurfaceContact::find_exit_of(const Model& model, const RigidContactSurface& surface,
                                               double whole_reach, std::uint32_t point, ContactSums& sums)
{
    const Vector3& position = model.state.points.position[point];
    Vector3 normal;
    const double distance = surface.distance(position, normal);
    double reach = whole_reach;
    if (!reach_.empty())
        reach = reach_[point] = std::clamp(distance, reach_[point], whole_reach);
    const Vector3 place = position - surface.shift();
    if (!assignment().obstacle || reach < least_reach * whole_reach)
        return distance < reach ? exit_at_nearest_face(place, distance, normal, reach).exit : ShortestExit{};
    const SolidContact contact = surface.contact(place, distance, normal, reach, free_positions_[point]);
    free_positions_[point] = contact.free_position;
    if (contact.crossed)
        release(model, point, distance, sums);
    return contact.exit;
}

void RigidSurfaceContact::release(const Model& model, std::uint32_t point, double distance, ContactSums& sums)
{
    sums.crossings.push_back({number(), point});
    ++crossed_points_;
    const auto stored = std::ranges::lower_bound(last_points_, point);
    if (stored != last_points_.end() && *stored == point)
        sums.energy_of_crossings += last_energies_[static_cast<std::size_t>(stored - last_points_.begin())];
    if (reach_.empty())
        reach_.assign(model.size(), law().cutoff());
    reach_[point] = std::min(reach_[point], distance);
}

void RigidSurfaceContact::add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                                        std::vector<Vector3>& force)
{
    touches_.clear();
    std::swap(stored_points_, last_points_);
    std::swap(stored_energies_, last_energies_);
    stored_points_.clear();
    stored_energies_.clear();
    const RigidContactSurface surface(model, assignment());
    if (!surface.present())
        return;
    const Points& points = model.state.points;
    const Vector3 velocity = surface.velocity();
    const double reach = law().cutoff();
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    std::array<std::uint32_t, block> touching;
    std::array<ShortestExit, block> exits;
    std::size_t count = 0;
    const auto evaluate_block = [&] {
        law().evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
        for (std::size_t c = 0; c < count; ++c)
            add_reaction(model, step, pairs[c], responses[c], touching[c], exits[c], sums, force);
        count = 0;
    };
    for (const std::uint32_t i : near_points_) {
        const ShortestExit exit = find_exit_of(model, surface, reach, i, sums);
        if (exit.faces == 0)
            continue;
        const double overlap = exit.faces == 1 ? exit.shares[0] : exit.move.norm();
        record_overlap(overlap / reach);
        const Vector3 direction = exit.faces == 1 ? exit.normals[0] : Vector3(exit.move / overlap);
        pairs[count] = {reach - overlap,  -step.approach_factor * (points.velocity[i] - velocity).dot(direction),
                        points.volume[i], 0.0,
                        points.mass[i],   0.0,
                        step.law_step};
        touching[count] = i;
        exits[count] = exit;
        if (++count == block)
            evaluate_block();
    }
    evaluate_block();
}

void RigidSurfaceContact::add_friction_last(const Model& model, double time_step, ContactSums& sums,
                                            std::vector<Vector3>& force)
{
    if (time_step <= 0.0)
        return;
    const Vector3 velocity = RigidContactSurface(model, assignment()).velocity();
    const double mu = law().friction();
    for (const Touch& touch : touches_) {
        const std::uint32_t i = touch.point;
        const Vector3 drive =
            force[i] + model.state.points.mass[i] / time_step * (model.state.points.velocity[i] - velocity);
        const Vector3 tangential = drive - drive.dot(touch.direction) * touch.direction;
        const double size = tangential.norm();
        if (size <= 0.0)
            continue;
        const double largest = mu * std::max(0.0, touch.normal_force);
        const Vector3 friction = -(std::min(largest, size) / size) * tangential;
        force[i] += friction;
        sums.friction[i] += friction;
        sums.obstacle_reactions[number_of_reaction(model)] += friction;
        sums.obstacle_power.reaction += friction.dot(velocity);
        sums.obstacle_power.friction += friction.dot(velocity);
    }
}

void RigidSurfaceContact::add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds)
{
    const RigidContactSurface surface(model, assignment());
    if (!surface.present())
        return;
    const double reach = law().cutoff() + part_of_margin * surface_margin * model.state.spacing;
    for (const std::uint32_t i : near_points_) {
        Vector3 normal;
        if (surface.distance(model.state.points.position[i], normal) >= reach)
            continue;
        const double mass = model.state.points.mass[i];
        const ContactPair pair{0.0, 0.0, model.state.points.volume[i], 0.0, mass, 0.0};
        if (surface.has_several_faces_near(model.state.points.position[i], reach))
            add_everywhere(bounds[i], pair, slopes(law(), pair), 1.0 / mass);
        else
            add(bounds[i], normal, pair, slopes(law(), pair), 1.0 / mass);
    }
}

} // namespace periporo
