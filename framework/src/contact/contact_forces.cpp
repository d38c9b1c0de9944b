// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "contact/contact_forces.hpp"

#include "contact/assignment.hpp"
#include "contact/contact_slopes.hpp"
#include "contact/corner_dashpot.hpp"
#include "periporo/first_exception.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

namespace periporo {
namespace {

constexpr std::size_t block = 128;
constexpr double bearing_overlap = 0.1; ///< overlap over reach up to which a point counts as resting on a surface
/// How far points and obstacles move until points near rigid surfaces are sought anew, in spacings.
constexpr double surface_skin = 0.4;
/// Reach over that of the law below which a point that takes the room it finds has no side from which it came.
constexpr double least_reach = 1e-3;

const Vector3 nowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());

bool is_nowhere(const Vector3& place)
{
    return place.x() != place.x();
}

} // namespace

void ContactForces::find_candidates(const Model& model, double slack)
{
    find_candidates_among_points(model, slack);
    follow_surfaces(model);
}

void ContactForces::find_candidates_among_points(const Model& model, double slack)
{
    candidates_.assign(assignments_.size(), {});
    smoothed_.resize(assignments_.size());
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        const ContactAssignment& assignment = assignments_[a];
        if (assignment.surface_body) {
            const std::uint32_t other = assignment.bodies[assignment.bodies[0] == *assignment.surface_body ? 1 : 0];
            smoothed_[a].find(model, *assignment.surface_body, other, assignment.law->cutoff(), slack);
        } else if (between_points_of_two_bodies(assignment)) {
            find_pairs(model, a, slack);
        } else if (within_one_body(assignment)) {
            find_pairs_apart(model, a, slack);
        }
    }
}

void ContactForces::follow_surfaces(const Model& model)
{
    const std::vector<Vector3>& positions = model.state.points.position;
    if (std::ranges::none_of(assignments_, at_rigid_surface))
        return;
    if (searched_.size() != positions.size() || searched_shifts_.size() != model.state.obstacles.size())
        return find_near_surfaces(model);
    double points = 0.0;
#pragma omp parallel for schedule(static) reduction(max : points)
    for (std::size_t i = 0; i < positions.size(); ++i)
        points = std::max(points, (positions[i] - searched_[i]).squaredNorm());
    double obstacles = 0.0;
    for (std::size_t o = 0; o < model.state.obstacles.size(); ++o)
        obstacles = std::max(obstacles, (model.state.obstacles[o].shift - searched_shifts_[o]).norm());
    if (std::sqrt(points) + obstacles > surface_skin * model.state.spacing)
        find_near_surfaces(model);
}

void ContactForces::find_near_surfaces(const Model& model)
{
    const std::vector<Vector3> searched = std::move(searched_);
    const std::vector<Vector3> searched_shifts = std::move(searched_shifts_);
    searched_ = model.state.points.position;
    searched_shifts_.resize(model.state.obstacles.size());
    std::ranges::transform(model.state.obstacles, searched_shifts_.begin(), &Obstacle::shift);
    list_near_surfaces(model);
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        const ContactAssignment& assignment = assignments_[a];
        if (!assignment.obstacle)
            continue;
        std::vector<Vector3> places(model.size(), nowhere);
        const bool was_free = searched.size() == model.size() && model.state.obstacles[*assignment.obstacle].present;
        for (const std::uint32_t i : near_surface_[a]) {
            if (free_place_[a].size() == model.size() && !is_nowhere(free_place_[a][i]))
                places[i] = free_place_[a][i];
            else if (was_free) // and the point may have leapt over the obstacle since
                places[i] = searched[i] - searched_shifts.at(*assignment.obstacle);
        }
        free_place_[a] = std::move(places);
    }
}

void ContactForces::list_near_surfaces(const Model& model)
{
    std::vector<std::uint8_t> near(model.size(), 0);
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        const ContactAssignment& assignment = assignments_[a];
        near_surface_[a].clear();
        if (!at_rigid_surface(assignment))
            continue;
        const RigidContactSurface surface(model, assignment);
        const double reach = assignment.law->cutoff() + (surface_margin + surface_skin) * model.state.spacing;
        const Vector3 shift = assignment.obstacle ? searched_shifts_[*assignment.obstacle] : Vector3(Vector3::Zero());
        FirstException failure; // of the geometry
#pragma omp parallel for schedule(dynamic, 256)
        for (std::size_t i = 0; i < model.size(); ++i)
            failure.guard(i, [&] {
                near[i] = names(assignment, model.state.points.body[i]) && surface.is_near(searched_[i] - shift, reach);
            });
        failure.rethrow();
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(model.size()); ++i)
            if (near[i] != 0)
                near_surface_[a].push_back(i);
    }
}

void ContactForces::make_room(const Model& model)
{
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        const ContactAssignment& assignment = assignments_[a];
        if (!at_rigid_surface(assignment))
            continue;
        const RigidContactSurface surface(model, assignment);
        if (!surface.present()) {
            room_[a].clear();
            if (assignment.obstacle)
                free_place_[a].assign(model.size(), nowhere);
            continue;
        }
        if (!room_[a].empty())
            continue;
        const double reach = assignment.law->cutoff();
        room_[a].assign(model.size(), reach);
        if (assignment.obstacle)
            free_place_[a].assign(model.size(), nowhere);
        for (const std::uint32_t i : near_surface_[a]) {
            Vector3 normal;
            const double distance = surface.distance(model.state.points.position[i], normal);
            if (distance >= (1.0 - bearing_overlap) * reach)
                continue;
            const ContactPair pair{distance, 0.0, model.state.points.volume[i], 0.0, model.state.points.mass[i], 0.0};
            ContactResponse response;
            assignment.law->evaluate({&pair, 1}, {&response, 1});
            if (response.force > 0.0) // and not within the reach of a pull
                room_[a][i] = distance;
        }
    }
}

void ContactForces::resume(const Model& model, double slack)
{
    const bool tracked = !searched_.empty();
    bool fits = stored_.point.size() == stored_.obstacle.size() && stored_.point.size() == stored_.energy.size() &&
                (!tracked || searched_shifts_.size() == model.state.obstacles.size());
    for (std::size_t a = 0; a < assignments_.size(); ++a)
        fits = fits && (!tracked || !assignments_[a].obstacle || free_place_[a].size() == model.size());
    if (!fits)
        throw std::runtime_error("the contacts that were kept do not fit each other");
    find_candidates_among_points(model, slack);
    if (tracked)
        list_near_surfaces(model);
}

void ContactForces::note_overlap(std::size_t assignment, double overlap)
{
    deepest_[assignment] = std::max(deepest_[assignment], overlap);
}

void ContactForces::push(const Model& model, std::size_t assignment, const ContactPair& pair,
                         const ContactResponse& response, std::uint32_t point, const WayOut& way,
                         std::vector<Vector3>& force)
{
    const ContactAssignment& at = assignments_[assignment];
    const Vector3 velocity = RigidContactSurface(model, at).velocity();
    const auto obstacle = at.obstacle.value_or(static_cast<std::uint32_t>(model.state.obstacles.size()));
    const Vector3 direction = way.faces == 1 ? way.normals[0] : Vector3(way.move.normalized());
    Vector3 reaction = response.force * direction;
    Vector3 damping = response.damping_force * direction;
    if (way.faces > 1 && approach_factor_ > 0.0) {
        const Vector3 braking =
            brake_across(*at.law, pair, way, model.state.points.velocity[point] - velocity, reaction);
        reaction += braking;
        damping += braking;
    }
    force[point] += reaction;
    damping_[point] += damping;
    point_energy_[point] += response.energy;
    obstacle_power_.reaction += reaction.dot(velocity);
    obstacle_power_.damping += damping.dot(velocity);
    obstacle_reactions_[obstacle] += reaction;
    surface_contacts_.push_back(
        {point, at.law->friction(), way.pressing() * response.force, direction, velocity, obstacle, response.energy});
}

void ContactForces::let_go(const Model& model, std::size_t assignment, std::uint32_t point, double distance)
{
    crossings_.push_back({assignment, point});
    ++crossed_points_[assignment];
    for (std::size_t s = 0; s < stored_.point.size(); ++s)
        if (stored_.point[s] == point && stored_.obstacle[s] == assignments_[assignment].obstacle)
            energy_let_go_ += stored_.energy[s];
    std::vector<double>& room = room_[assignment];
    if (room.empty())
        room.assign(model.size(), assignments_[assignment].law->cutoff());
    room[point] = std::min(room[point], distance);
}

void ContactForces::add_surface(const Model& model, std::size_t assignment, std::vector<Vector3>& force)
{
    const ContactAssignment& at = assignments_[assignment];
    const RigidContactSurface surface(model, at);
    if (!surface.present())
        return;
    const Vector3 velocity = surface.velocity();
    const Vector3 shift = surface.shift();
    const double reach = at.law->cutoff();
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    std::array<std::uint32_t, block> touching;
    std::array<WayOut, block> ways;
    std::size_t count = 0;
    const auto flush = [&] {
        at.law->evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
        for (std::size_t c = 0; c < count; ++c)
            push(model, assignment, pairs[c], responses[c], touching[c], ways[c], force);
        count = 0;
    };
    std::vector<double>& room = room_[assignment];
    Vector3* const free_places = at.obstacle ? free_place_[assignment].data() : nullptr;
    for (const std::uint32_t i : near_surface_[assignment]) {
        Vector3 normal;
        const Vector3 position = model.state.points.position[i] - shift;
        const double distance = surface.distance(model.state.points.position[i], normal);
        double own_reach = reach;
        if (!room.empty())
            own_reach = room[i] = std::clamp(distance, room[i], reach);
        SolidMeeting met;
        if (free_places == nullptr || own_reach < least_reach * reach) {
            if (distance < own_reach)
                met = meet_nearest(position, distance, normal, own_reach);
        } else {
            met = surface.meeting(position, distance, normal, own_reach, free_places[i]);
            free_places[i] = met.free_place;
        }
        if (met.crossed)
            let_go(model, assignment, i, distance);
        if (met.way.faces == 0)
            continue;
        const double overlap = met.way.faces == 1 ? met.way.shares[0] : met.way.move.norm();
        note_overlap(assignment, overlap / reach);
        const Vector3 direction = met.way.faces == 1 ? met.way.normals[0] : Vector3(met.way.move / overlap);
        pairs[count] = {reach - overlap,
                        -approach_factor_ * (model.state.points.velocity[i] - velocity).dot(direction),
                        model.state.points.volume[i],
                        0.0,
                        model.state.points.mass[i],
                        0.0,
                        law_step_};
        touching[count] = i;
        ways[count] = met.way;
        if (++count == block)
            flush();
    }
    flush();
}

void ContactForces::add_reactions(const Model& model, double time_step, Approach approach, std::vector<Vector3>& force)
{
    approach_factor_ = approach == Approach::real ? 1.0 : 0.0;
    law_step_ = approach_factor_ * time_step;
    friction_.assign(model.size(), Vector3::Zero());
    point_energy_.assign(model.size(), 0.0);
    damping_.assign(model.size(), Vector3::Zero());
    obstacle_power_ = {};
    crossings_.clear();
    obstacle_reactions_.assign(model.state.obstacles.size() + 1, Vector3::Zero());
    energy_let_go_ = 0.0;
    surface_contacts_.clear();
    for (std::size_t a = 0; a < assignments_.size(); ++a) {
        if (at_rigid_surface(assignments_[a]))
            add_surface(model, a, force);
        else if (assignments_[a].surface_body)
            add_smoothed(model, a, time_step, force);
        else
            add_pairs(model, a, time_step, force);
    }
    energy_ = 0.0;
    for (const double energy : point_energy_)
        energy_ += energy;
    stored_.point.clear();
    stored_.obstacle.clear();
    stored_.energy.clear();
    for (const SurfaceContact& contact : surface_contacts_) {
        stored_.point.push_back(contact.point);
        stored_.obstacle.push_back(contact.obstacle);
        stored_.energy.push_back(contact.energy);
    }
}

void ContactForces::add_surface_friction(const Model& model, double time_step, std::vector<Vector3>& force)
{
    if (time_step <= 0.0)
        return;
    for (const SurfaceContact& contact : surface_contacts_) {
        const std::uint32_t i = contact.point;
        const Vector3 drive =
            force[i] + model.state.points.mass[i] / time_step * (model.state.points.velocity[i] - contact.velocity);
        const Vector3 tangential = drive - drive.dot(contact.normal) * contact.normal;
        const double size = tangential.norm();
        if (size <= 0.0)
            continue;
        const double largest = contact.friction * std::max(0.0, contact.force);
        const Vector3 friction = -(std::min(largest, size) / size) * tangential;
        force[i] += friction;
        friction_[i] += friction;
        obstacle_reactions_[contact.obstacle] += friction;
        obstacle_power_.reaction += friction.dot(contact.velocity);
        obstacle_power_.friction += friction.dot(contact.velocity);
    }
}

} // namespace periporo
