// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The step, its forces, and the ledger.
#include "time/dynamics.hpp"

#include "operator/refresh.hpp"
#include "state/ordered_sum.hpp"
#include "water/standing_water.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {

Dynamics::Dynamics(Model& model, const ForceState& force_state, ContactForces& contact, DynamicsSettings settings)
    : model_(model), force_state_(force_state), contact_(contact), settings_(settings)
{
}

void Dynamics::refresh()
{
    times_.time(Phase::refresh, [&] {
        model_.gather_ends();
        refresh_families(model_, force_state_, contact_.begin_refresh(model_));
        contact_.end_refresh(model_, settings_.skin, state_.ledger.collision);
    });
    ++state_.refreshes;
}

void Dynamics::start()
{
    state_.force_scale = 0.0;
    state_.undamped_force.clear();
    // Adding, removing or starting an obstacle, and bringing held points to speed, changes the energy; the ledger books
    // it here.
    const double before = kinetic_energy() + contact_.energy();
    hold_velocities();
    model_.gather_ends();
    contact_.find_candidates(model_, settings_.skin);
    contact_.begin_stage(model_);
    force_state_.evaluate(model_, {StressUpdate::keep, MaterialResponse::full, 0.0});
    sum_forces({});
    state_.ledger.boundary += kinetic_energy() + contact_.energy() - before;
    state_.force_squared_per_mass = force_squared_per_mass();
    state_.powers = ledger_powers();
}

void Dynamics::step(const StepOptions& options)
{
    bool refresh_due = settings_.refresh_always;
    times_.time(Phase::integration, [&] {
        drift(options.time_step);
        refresh_due = refresh_due || 2.0 * displacement_since_refresh(model_) > settings_.skin;
        if (!refresh_due)
            model_.gather_ends();
    });
    if (refresh_due)
        refresh();
    times_.time(Phase::contact, [&] { contact_.update_near_points(model_); });
    times_.time_operator(model_.result.times, [&] {
        force_state_.evaluate(model_, {StressUpdate::advance, options.response, options.time_step});
    });
    times_.time(Phase::contact, [&] { sum_forces(options); });
    times_.time(Phase::integration, [&] {
        kick(options.time_step);
        update_ledger(options.time_step);
    });
}

void Dynamics::drift(double time_step)
{
    Points& points = model_.state.points;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < points.size(); ++i) {
        points.velocity[i] += 0.5 * time_step / points.mass[i] * points.force[i];
        points.position[i] += time_step * points.velocity[i];
    }
    for (Obstacle& obstacle : model_.state.obstacles)
        obstacle.shift += time_step * obstacle.velocity;
}

void Dynamics::kick(double time_step)
{
    Points& points = model_.state.points;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < points.size(); ++i) {
        points.velocity[i] += 0.5 * time_step / points.mass[i] * points.force[i];
        const double dilation = model_.result.volume_rate[i];
        points.jacobian[i] *= (1.0 + 0.5 * dilation) / (1.0 - 0.5 * dilation);
        points.volume[i] = points.initial_volume[i] * volume_ratio(points.jacobian[i], model_.body_of(i).porosity);
    }
}

void Dynamics::update_ledger(double time_step)
{
    const Points& points = model_.state.points;
    const auto [kinetic, gravity, lent, stress] =
        ordered_sums<4>(points.size(), [&](std::size_t i, std::array<double, 4>& sum) {
            sum[0] += 0.5 * points.mass[i] * points.velocity[i].squaredNorm();
            sum[1] -= points.mass[i] * model_.state.gravity.dot(points.position[i]);
            sum[2] += points.force[i].squaredNorm() / points.mass[i];
            sum[3] += model_.result.stress_work[i];
        });
    EnergyLedger& ledger = state_.ledger;
    ledger.kinetic = kinetic;
    ledger.gravity = gravity - state_.gravity_datum;
    ledger.contact = contact_.energy();
    ledger.verlet -= 0.125 * time_step * time_step * (lent - state_.force_squared_per_mass);
    state_.force_squared_per_mass = lent;
    ledger.stress_work += stress;
    const LedgerPowers powers = ledger_powers();
    ledger.friction -= work_of_step(state_.powers.friction, powers.friction, time_step);
    ledger.collision -= work_of_step(state_.powers.collision, powers.collision, time_step);
    ledger.collision += contact_.energy_of_crossings();
    ledger.boundary += work_of_step(state_.powers.boundary, powers.boundary, time_step) + time_step * buoyancy_power_;
    state_.powers = powers;
    ledger.turned_over = std::max(ledger.turned_over, ledger.turnover());
}

LedgerPowers Dynamics::ledger_powers() const
{
    const Points& points = model_.state.points;
    const std::vector<Vector3>&friction = contact_.friction(), &damping = contact_.damping();
    const auto sums = ordered_sums<4>(points.size(), [&](std::size_t i, std::array<double, 4>& sum) {
        const Vector3 acceleration = points.force[i] / points.mass[i];
        sum[0] += friction[i].dot(points.velocity[i]);
        sum[1] += friction[i].dot(acceleration);
        sum[2] += damping[i].dot(points.velocity[i]);
        sum[3] += damping[i].dot(acceleration);
    });
    const ObstaclePower& obstacles = contact_.obstacle_power();
    return {{obstacles.reaction + held_power_, 0.0},
            {sums[0] - obstacles.friction, sums[1]},
            {sums[2] - obstacles.damping, sums[3]}};
}

void Dynamics::sum_forces(const StepOptions& options)
{
    Points& points = model_.state.points;
    const std::size_t n = points.size();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i)
        points.force[i] = model_.result.internal_force[i] + points.mass[i] * model_.state.gravity;
    buoyancy_power_ = add_buoyancy(model_, state_.buoyancy, points.force);
    using Approach = ContactForces::Approach;
    // Friction stops the slip of a contact within the step, also when damping has multiplied it.
    const double stopping_time = (1.0 + options.local_damping) * options.time_step;
    contact_.add_reactions(model_, stopping_time, options.local_damping > 0.0 ? Approach::none : Approach::real,
                           points.force);
    contact_.add_surface_friction(model_, stopping_time, points.force);
    held_power_ = hold_forces();
    const double squared_gravity = model_.state.gravity.squaredNorm();
    const auto [unbalanced, weight] = ordered_sums<2>(n, [&](std::size_t i, std::array<double, 2>& sum) {
        sum[0] += points.force[i].squaredNorm();
        sum[1] += points.mass[i] * points.mass[i] * squared_gravity;
    });
    state_.force_scale = weight > 0.0 ? std::sqrt(weight) : std::max(state_.force_scale, std::sqrt(unbalanced));
    state_.residual = state_.force_scale > 0.0 ? std::sqrt(unbalanced) / state_.force_scale : 0.0;
    if (options.local_damping > 0.0) {
        damp_forces(options.local_damping);
        hold_forces();
    }
}

void Dynamics::damp_forces(double coefficient)
{
    Points& points = model_.state.points;
    std::vector<Vector3>& last = state_.undamped_force;
    if (last.empty())
        last = points.force;
    const auto sign = [](double value) { return static_cast<double>((value > 0.0) - (value < 0.0)); };
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < points.size(); ++i)
        for (Eigen::Index c = 0; c < 3; ++c) {
            const double force = points.force[i][c];
            const double brake = sign(points.velocity[i][c]) - sign(force - last[i][c]);
            points.force[i][c] -= 0.5 * coefficient * std::abs(force) * brake;
            last[i][c] = force;
        }
}

double Dynamics::force_squared_per_mass() const
{
    return ordered_sums<1>(model_.size(), [&](std::size_t i, std::array<double, 1>& sum) {
        sum[0] += model_.state.points.force[i].squaredNorm() / model_.state.points.mass[i];
    })[0];
}

void Dynamics::hold_velocities()
{
    for (const HeldDirection& held : held_) {
        Vector3& velocity = model_.state.points.velocity[held.point];
        velocity += (held.speed - velocity.dot(held.direction)) * held.direction;
    }
}

double Dynamics::hold_forces()
{
    double power = 0.0;
    for (const HeldDirection& held : held_) {
        Vector3& force = model_.state.points.force[held.point];
        const double along = force.dot(held.direction);
        force -= along * held.direction;
        power -= along * held.speed;
    }
    return power;
}

void Dynamics::open_ledger()
{
    EnergyLedger& ledger = state_.ledger;
    ledger = {};
    state_.gravity_datum = gravity_energy();
    ledger.kinetic = kinetic_energy();
    ledger.contact = contact_.energy();
    ledger.opening = ledger.kinetic + ledger.contact;
    ledger.turned_over = ledger.turnover();
}

void Dynamics::book(const ArrivedEnergy& arrived)
{
    state_.ledger.boundary += arrived.kinetic;
    state_.gravity_datum += arrived.gravity;
    if (arrived.kinetic != 0.0 || arrived.gravity != 0.0)
        state_.force_squared_per_mass = force_squared_per_mass(); // the half kick that follows has the new masses
}

double Dynamics::kinetic_energy() const
{
    return ordered_sums<1>(model_.size(), [&](std::size_t i, std::array<double, 1>& sum) {
        sum[0] += 0.5 * model_.state.points.mass[i] * model_.state.points.velocity[i].squaredNorm();
    })[0];
}

double Dynamics::gravity_energy() const
{
    return ordered_sums<1>(model_.size(), [&](std::size_t i, std::array<double, 1>& sum) {
        sum[0] -= model_.state.points.mass[i] * model_.state.gravity.dot(model_.state.points.position[i]);
    })[0];
}

double Dynamics::acceleration_scale() const
{
    double squared_mass = 0.0;
    for (const double m : model_.state.points.mass)
        squared_mass += m * m;
    return squared_mass > 0.0 ? state_.force_scale / std::sqrt(squared_mass) : 0.0;
}

double Dynamics::mean_speed() const
{
    body_motion_.assign(model_.state.bodies.size(), {});
    for (std::size_t i = 0; i < model_.size(); ++i) {
        BodyMotion& body = body_motion_[model_.state.points.body[i]];
        body.mass += model_.state.points.mass[i];
        body.twice_energy += model_.state.points.mass[i] * model_.state.points.velocity[i].squaredNorm();
    }
    double fastest = 0.0;
    for (const BodyMotion& body : body_motion_)
        if (body.mass > 0.0 && !(body.twice_energy <= fastest * fastest * body.mass)) // not a number is fast
            fastest = std::sqrt(body.twice_energy / body.mass);
    return fastest;
}

} // namespace periporo
