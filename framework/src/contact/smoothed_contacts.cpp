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
    const Isometry& isometry = model.neighbourhood.isometries[model.neighbourhood.families.isometry(record)];
    forces[model.neighbourhood.families.parent(record)] += isometry.rotation.transpose() * force;
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
            shared_weight_[model.neighbourhood.families.parent(supported.support.records[m])] +=
                supported.support.slopes[m].norm();
    }
}

ContactForces::Carrier ContactForces::carrier(const Model& model, const Support& support, std::span<const double> crowd)
{
    Carrier carrier;
    for (std::size_t m = 0; m < support.records.size(); ++m) {
        const std::uint32_t p = model.neighbourhood.families.parent(support.records[m]);
        carrier.volume += support.weights[m] * model.state.points.volume[p];
        const double own = support.slopes[m].norm();
        carrier.mobility += own * (crowd.empty() ? own : crowd[p]) / model.state.points.mass[p];
    }
    return carrier;
}

void ContactForces::press(const Model& model, std::size_t assignment, const SupportedPoint& supported, double time_step,
                          std::vector<Vector3>& force)
{
    const Contact& law = *assignments_[assignment].law;
    const Support& support = supported.support;
    const Points& points = model.state.points;
    const std::uint32_t i = supported.point;
    Vector3 surface_velocity = Vector3::Zero();
    double opening = support.own_slope.dot(model.ends[i].v());
    for (std::size_t m = 0; m < support.records.size(); ++m) {
        const Vector3 velocity = model.ends[support.records[m]].v();
        surface_velocity += support.weights[m] * velocity;
        opening += support.slopes[m].dot(velocity);
    }
    const Carrier below = carrier(model, support, shared_weight_);
    const ContactPair pair{support.distance, -approach_factor_ * opening, points.volume[i], below.volume,
                           points.mass[i],   1.0 / below.mobility,        law_step_};
    ContactResponse response;
    law.evaluate({&pair, 1}, {&response, 1});
    note_overlap(assignment, (law.cutoff() - support.distance) / law.cutoff());
    point_energy_[i] += support.strength * response.energy;

    const Vector3 relative = model.ends[i].v() - surface_velocity;
    const Vector3 slip = relative - relative.dot(support.normal) * support.normal;
    const double speed = slip.norm();
    const double pressing = support.strength * std::max(0.0, response.force);
    Vector3 friction = Vector3::Zero();
    if (speed > 0.0 && time_step > 0.0) {
        const double stops = reduced_mass(pair) * speed / time_step;
        friction = -(std::min(law.friction() * pressing, stops) / speed) * slip;
    }
    // minus the gradient of strength times energy, and the dashpot and friction along the same paths
    const double push = support.strength * response.force;
    const double damping = support.strength * response.damping_force;
    force[i] += push * support.own_slope - response.energy * support.own_fade + friction;
    friction_[i] += friction;
    damping_[i] += damping * support.own_slope;
    for (std::size_t m = 0; m < support.records.size(); ++m) {
        const std::uint32_t record = support.records[m];
        const Vector3 shared = -support.weights[m] * friction;
        give(model, record, push * support.slopes[m] - response.energy * support.fades[m] + shared, force);
        give(model, record, shared, friction_);
        give(model, record, damping * support.slopes[m], damping_);
    }
}

void ContactForces::add_smoothed(const Model& model, std::size_t assignment, double time_step,
                                 std::vector<Vector3>& force)
{
    // In the order of the points: what a point of the surface gets is then the same for any number of threads.
    find_supported_points(model, assignment, assignments_[assignment].law->cutoff());
    for (std::size_t s = 0; s < supported_count_; ++s)
        press(model, assignment, supported_[s], time_step, force);
}

void ContactForces::energy_on_smoothed(const Model& model, std::vector<double>& energy)
{
    energy.assign(model.size(), 0.0);
    for (std::size_t a = 0; a < assignments_.size() && a < smoothed_.size(); ++a) {
        if (!assignments_[a].surface_body)
            continue;
        const Contact& law = *assignments_[a].law;
        find_supported_points(model, a, law.cutoff());
        for (std::size_t s = 0; s < supported_count_; ++s) {
            const auto& [i, support] = supported_[s];
            const Carrier alone = carrier(model, support, {});
            const ContactPair pair{
                support.distance,     0.0, model.state.points.volume[i], alone.volume, model.state.points.mass[i],
                1.0 / alone.mobility, 0.0};
            ContactResponse response;
            law.evaluate({&pair, 1}, {&response, 1});
            energy[i] += support.strength * response.energy;
        }
    }
}

void ContactForces::bound_supported(const Model& model, std::size_t assignment, double margin)
{
    // (u_i . g_i + sum u_p . g_p) is, squared, at most 2 (u_i . g_i)^2 + 2 sum |g| sum (u_p . g_p)^2/|g_p| with the
    // slopes g of the distance. What the surface is to a point that stands on it alone is never lighter than what it is
    // in a crowd, and no dashpot is weaker there. The rim bears less than it does here.
    const Contact& law = *assignments_[assignment].law;
    find_supported_points(model, assignment, law.cutoff() + margin);
    for (std::size_t s = 0; s < supported_count_; ++s) {
        const auto& [i, support] = supported_[s];
        const double mass = model.state.points.mass[i];
        const Carrier alone = carrier(model, support, {});
        const ContactPair pair{0.0, 0.0, model.state.points.volume[i], alone.volume, mass, 1.0 / alone.mobility};
        const ContactSlopes both = slopes(law, pair);
        add(bounds_[i], support.own_slope, pair, both, 2.0 / mass);
        double sum = 0.0;
        for (const Vector3& slope : support.slopes)
            sum += slope.norm();
        for (std::size_t m = 0; m < support.records.size(); ++m) {
            const double size = support.slopes[m].norm();
            if (size <= 0.0)
                continue;
            const std::uint32_t p = model.neighbourhood.families.parent(support.records[m]);
            const Isometry& isometry =
                model.neighbourhood.isometries[model.neighbourhood.families.isometry(support.records[m])];
            add(bounds_[p], isometry.rotation.transpose() * support.slopes[m] / size, pair, both,
                2.0 * sum * size / model.state.points.mass[p]);
        }
    }
}

} // namespace periporo
