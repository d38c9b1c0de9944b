// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "time/dynamics.hpp"

#include "operator/refresh.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {

Dynamics::Dynamics(Model& model, const ForceState& force_state, ContactForces& contact, DynamicsSettings settings)
    : model_(model), force_state_(force_state), contact_(contact), settings_(settings)
{
}

void Dynamics::refresh()
{
    refresh_families(model_, force_state_);
    contact_.find_candidates(model_, settings_.skin);
    ++state_.refreshes;
}

void Dynamics::start()
{
    state_.force_scale = 0.0;
    apply_held(model_.points.velocity);
    model_.update_records();
    contact_.find_candidates(model_, settings_.skin);
    force_state_.evaluate(model_, {StressUpdate::keep, MaterialResponse::full, 0.0});
    sum_forces({});
    state_.force_squared_per_mass = force_squared_per_mass();
}

void Dynamics::step(const StepOptions& options)
{
    Points& points = model_.points;
    const std::size_t n = points.size();
    const double dt = options.time_step;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
        points.velocity[i] += 0.5 * dt / points.mass[i] * points.force[i];
        points.position[i] += dt * points.velocity[i];
    }
    if (settings_.refresh_always || 2.0 * displacement_since_refresh(model_) > settings_.skin)
        refresh();
    else
        model_.update_records();
    force_state_.evaluate(model_, {StressUpdate::advance, options.response, dt});
    sum_forces(options);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
        points.velocity[i] += 0.5 * dt / points.mass[i] * points.force[i];
        const double dilation = model_.volume_rate[i];
        points.jacobian[i] *= (1.0 + 0.5 * dilation) / (1.0 - 0.5 * dilation);
        points.volume[i] = points.initial_volume[i] * std::min(points.jacobian[i], largest_volume_ratio);
    }
    EnergyLedger& ledger = state_.ledger;
    ledger.kinetic = kinetic_energy();
    ledger.gravity = gravity_energy() - state_.gravity_datum;
    ledger.contact = contact_.energy();
    const double last_lent = state_.force_squared_per_mass;
    state_.force_squared_per_mass = force_squared_per_mass();
    ledger.verlet -= 0.125 * dt * dt * (state_.force_squared_per_mass - last_lent);
    for (std::size_t i = 0; i < n; ++i) {
        ledger.stress_work += model_.stress_work[i];
        ledger.friction -= dt * contact_.friction()[i].dot(points.velocity[i]);
        ledger.collision -= dt * contact_.damping()[i].dot(points.velocity[i]);
    }
}

void Dynamics::sum_forces(const StepOptions& options)
{
    Points& points = model_.points;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i)
        points.force[i] = model_.internal_force[i] + points.mass[i] * model_.gravity;
    using Approach = ContactForces::Approach;
    contact_.add_reactions(model_, options.time_step, options.local_damping > 0.0 ? Approach::none : Approach::real,
                           points.force);
    contact_.add_surface_friction(model_, options.time_step, points.force);
    apply_held(points.force);
    double unbalanced = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        unbalanced += points.force[i].squaredNorm();
        weight += points.mass[i] * points.mass[i] * model_.gravity.squaredNorm();
    }
    state_.force_scale = weight > 0.0 ? std::sqrt(weight) : std::max(state_.force_scale, std::sqrt(unbalanced));
    state_.residual = state_.force_scale > 0.0 ? std::sqrt(unbalanced) / state_.force_scale : 0.0;
    if (options.local_damping > 0.0) {
        for (std::size_t i = 0; i < n; ++i)
            for (Eigen::Index c = 0; c < 3; ++c) {
                const double v = points.velocity[i][c];
                const double f = points.force[i][c];
                points.force[i][c] -= options.local_damping * std::abs(f) * static_cast<double>((v > 0.0) - (v < 0.0));
            }
        apply_held(points.force);
    }
}

double Dynamics::force_squared_per_mass() const
{
    double sum = 0.0;
    for (std::size_t i = 0; i < model_.size(); ++i)
        sum += model_.points.force[i].squaredNorm() / model_.points.mass[i];
    return sum;
}

void Dynamics::apply_held(std::vector<Vector3>& vectors) const
{
    for (const HeldDirection& held : held_)
        vectors[held.point] -= vectors[held.point].dot(held.direction) * held.direction;
}

void Dynamics::open_ledger()
{
    EnergyLedger& ledger = state_.ledger;
    ledger = {};
    state_.gravity_datum = gravity_energy();
    ledger.kinetic = kinetic_energy();
    ledger.contact = contact_.energy();
    ledger.opening = ledger.kinetic + ledger.contact;
}

double Dynamics::kinetic_energy() const
{
    double sum = 0.0;
    for (std::size_t i = 0; i < model_.size(); ++i)
        sum += 0.5 * model_.points.mass[i] * model_.points.velocity[i].squaredNorm();
    return sum;
}

double Dynamics::gravity_energy() const
{
    double sum = 0.0;
    for (std::size_t i = 0; i < model_.size(); ++i)
        sum -= model_.points.mass[i] * model_.gravity.dot(model_.points.position[i]);
    return sum;
}

double Dynamics::acceleration_scale() const
{
    double squared_mass = 0.0;
    for (const double m : model_.points.mass)
        squared_mass += m * m;
    return squared_mass > 0.0 ? state_.force_scale / std::sqrt(squared_mass) : 0.0;
}

double Dynamics::mean_speed() const
{
    double momentum_mass = 0.0;
    for (const double m : model_.points.mass)
        momentum_mass += m;
    return momentum_mass > 0.0 ? std::sqrt(2.0 * kinetic_energy() / momentum_mass) : 0.0;
}

} // namespace periporo
