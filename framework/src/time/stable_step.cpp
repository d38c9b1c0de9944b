// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "time/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace periporo {
namespace {

/// A start vector without a preferred wave length: signs and sizes from a fixed integer hash of point and component.
Vector3 scattered(std::size_t point)
{
    Vector3 value;
    for (std::uint64_t c = 0; c < 3; ++c) {
        std::uint64_t h = (point * 3 + c + 1) * 0x9e3779b97f4a7c15ull;
        h = (h ^ (h >> 31)) * 0xbf58476d1ce4e5b9ull;
        value[static_cast<Eigen::Index>(c)] = static_cast<double>((h ^ (h >> 29)) >> 11) * 0x1p-52 - 1.0;
    }
    return value;
}

} // namespace

namespace {

/// Power iteration on `mode`; returns the largest Rayleigh quotient met, omega^2.
double iterate(Model& model, const ForceState& force_state, int iterations, std::vector<Vector3>& mode)
{
    const std::size_t n = model.size();
    double squared = 0.0;
    for (int iteration = 0; iteration < iterations; ++iteration) {
        double mass_norm = 0.0;
        for (std::size_t i = 0; i < n; ++i)
            mass_norm += model.points.mass[i] * mode[i].squaredNorm();
        if (mass_norm <= 0.0)
            break;
        const double scale = 1.0 / std::sqrt(mass_norm);
        for (std::size_t i = 0; i < n; ++i)
            model.points.velocity[i] = mode[i] *= scale;
        model.update_records();
        force_state.evaluate(model, {StressUpdate::tangent, MaterialResponse::elastic, 0.0});
        double rayleigh = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            rayleigh -= model.internal_force[i].dot(mode[i]);
            mode[i] = -model.internal_force[i] / model.points.mass[i];
        }
        squared = std::max(squared, rayleigh);
    }
    return squared;
}

} // namespace

double FrequencyEstimate::update(Model& model, const ForceState& force_state, int iterations)
{
    const std::vector<Vector3> velocity = model.points.velocity;
    std::vector<Vector3> fresh(model.size());
    for (std::size_t i = 0; i < model.size(); ++i)
        fresh[i] = scattered(i);
    double squared = iterate(model, force_state, iterations, fresh);
    if (mode_.size() == model.size()) {
        const double last = iterate(model, force_state, 2, mode_);
        if (last < squared)
            mode_ = std::move(fresh);
        squared = std::max(squared, last);
    } else {
        mode_ = std::move(fresh);
    }
    model.points.velocity = velocity;
    model.update_records();
    return std::sqrt(std::max(squared, 0.0));
}

StableStep stable_step(Model& model, const ForceState& force_state, const ContactForces& contact,
                       FrequencyEstimate& estimate, int iterations, double safety)
{
    StableStep result;
    result.frequency = estimate.update(model, force_state, iterations);
    const double contact_squared = contact.frequency_squared(model);
    result.contact_frequency = std::sqrt(contact_squared);
    result.wave_limit = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model.size(); ++i) {
        const Material& material = *model.body_of(i).material;
        const double density = model.points.mass[i] / model.points.volume[i];
        const double speed = std::sqrt((material.bulk_modulus() + 4.0 / 3.0 * material.shear_modulus()) / density);
        result.wave_limit = std::min(result.wave_limit, 1.5 * model.spacing / speed);
    }
    const double squared = result.frequency * result.frequency + contact_squared;
    result.step = std::min(squared > 0.0 ? safety * 2.0 / std::sqrt(squared) : result.wave_limit, result.wave_limit);
    return result;
}

} // namespace periporo
