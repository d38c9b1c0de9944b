// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of the points of one body with the smoothed surface of another.
#include "contact/assignment.hpp"
#include "contact/contact_forces.hpp"
#include "contact/contact_slopes.hpp"

#include <cmath>

namespace periporo {
namespace {

/// A force on a point or on an image, as a force on the point that it stands for.
void give(const Model& model, std::uint32_t record, const Vector3& force, std::vector<Vector3>& forces)
{
    const Isometry& isometry = model.isometries[model.families.isometry(record)];
    forces[model.families.parent(record)] += isometry.rotation.transpose() * force;
}

} // namespace

void ContactForces::find_supported_points(const Model& model, std::size_t assignment, double reach)
{
    const SmoothedSurface& surface = smoothed_[assignment];
    supported_count_ = 0;
    shared_weight_.assign(model.size(), 0.0);
    for (std::size_t n = 0; n < surface.near().size(); ++n) {
        if (supported_.size() == supported_count_)
            supported_.emplace_back();
        SupportedPoint& supported = supported_[supported_count_];
        if (!surface.find_support(model, n, supported.support) || supported.support.distance >= reach)
            continue;
        supported.point = surface.near()[n];
        ++supported_count_;
        for (std::size_t m = 0; m < supported.support.records.size(); ++m)
            shared_weight_[model.families.parent(supported.support.records[m])] +=
                std::abs(supported.support.weights[m]);
    }
}

ContactForces::Carrier ContactForces::carrier(const Model& model, const Support& support, std::span<const double> crowd)
{
    Carrier carrier;
    for (std::size_t m = 0; m < support.records.size(); ++m) {
        const std::uint32_t p = model.families.parent(support.records[m]);
        carrier.volume += support.weights[m] * model.points.volume[p];
        const double own = std::abs(support.weights[m]);
        carrier.mobility += own * (crowd.empty() ? own : crowd[p]) / model.points.mass[p];
    }
    return carrier;
}

void ContactForces::press(const Model& model, std::size_t assignment, const SupportedPoint& supported, double time_step,
                          std::vector<Vector3>& force)
{
    const Contact& law = *assignments_[assignment].law;
    const Support& support = supported.support;
    const Points& points = model.points;
    const std::uint32_t i = supported.point;
    Vector3 surface_velocity = Vector3::Zero();
    for (std::size_t m = 0; m < support.records.size(); ++m)
        surface_velocity += support.weights[m] * model.records[support.records[m]].v();
    const Carrier below = carrier(model, support, shared_weight_);
    const Vector3 relative = model.records[i].v() - surface_velocity;
    const double opening = relative.dot(support.normal);
    const ContactPair pair{support.distance, -approach_factor_ * opening, points.volume[i], below.volume,
                           points.mass[i],   1.0 / below.mobility,        law_step_};
    ContactResponse response;
    law.evaluate({&pair, 1}, {&response, 1});
    note_overlap(assignment, (law.cutoff() - support.distance) / law.cutoff());
    point_energy_[i] += response.energy;

    const Vector3 slip = relative - opening * support.normal;
    const double speed = slip.norm();
    Vector3 friction = Vector3::Zero();
    if (speed > 0.0 && time_step > 0.0) {
        const double stops = reduced_mass(pair) * speed / time_step;
        friction = -(std::min(law.friction() * std::max(0.0, response.force), stops) / speed) * slip;
    }
    const Vector3 damping = response.damping_force * support.normal;
    const Vector3 reaction = response.force * support.normal + friction;
    const auto give_all = [&](const Vector3& vector, std::vector<Vector3>& to) {
        to[i] += vector;
        for (std::size_t m = 0; m < support.records.size(); ++m)
            give(model, support.records[m], -support.weights[m] * vector, to);
    };
    give_all(reaction, force);
    give_all(friction, friction_);
    give_all(damping, damping_);
}

void ContactForces::add_smoothed(const Model& model, std::size_t assignment, double time_step,
                                 std::vector<Vector3>& force)
{
    // In the order of the points: what a point of the surface gets is then the same for any number of threads.
    find_supported_points(model, assignment, assignments_[assignment].law->cutoff());
    for (std::size_t s = 0; s < supported_count_; ++s)
        press(model, assignment, supported_[s], time_step, force);
}

void ContactForces::bound_supported(const Model& model, std::size_t assignment, double margin)
{
    // (u_i - sum w_p u_p) . n is, squared, at most 2 (u_i . n)^2 + 2 sum |w| sum |w_p| (u_p . n)^2. What the surface is
    // to a point that stands on it alone is never lighter than what it is in a crowd, and no dashpot is weaker there.
    const Contact& law = *assignments_[assignment].law;
    find_supported_points(model, assignment, law.cutoff() + margin);
    for (std::size_t s = 0; s < supported_count_; ++s) {
        const auto& [i, support] = supported_[s];
        const double mass = model.points.mass[i];
        const Carrier alone = carrier(model, support, {});
        const ContactPair pair{0.0, 0.0, model.points.volume[i], alone.volume, mass, 1.0 / alone.mobility};
        const ContactSlopes both = slopes(law, pair);
        add(bounds_[i], support.normal, pair, both, 2.0 / mass);
        double weights = 0.0;
        for (const double weight : support.weights)
            weights += std::abs(weight);
        for (std::size_t m = 0; m < support.records.size(); ++m) {
            const std::uint32_t p = model.families.parent(support.records[m]);
            const Isometry& isometry = model.isometries[model.families.isometry(support.records[m])];
            add(bounds_[p], isometry.rotation.transpose() * support.normal, pair, both,
                2.0 * weights * std::abs(support.weights[m]) / model.points.mass[p]);
        }
    }
}

} // namespace periporo
