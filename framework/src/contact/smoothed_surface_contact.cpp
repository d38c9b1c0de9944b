// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Forces, energy and bounds of points on a smoothed surface.
#include "contact/smoothed_surface_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace periporo {

void SmoothedSurfaceContact::find_candidates(const Model& model, double slack)
{
    const std::uint32_t surface_body = *assignment().surface_body;
    const std::uint32_t other = assignment().bodies[assignment().bodies[0] == surface_body ? 1 : 0];
    surface_.find(model, surface_body, other, law().cutoff(), slack);
}

void SmoothedSurfaceContact::find_supported_points(const Model& model, double distance)
{
    supported_count_ = 0;
    total_slope_.assign(model.neighbourhood.ends(), 0.0);
    for (std::size_t n = 0; n < surface_.near().size(); ++n) {
        if (supported_.size() == supported_count_)
            supported_.emplace_back();
        SupportedPoint& supported = supported_[supported_count_];
        if (!surface_.find_support(model, n, supported.support) || supported.support.distance >= distance)
            continue;
        supported.point = surface_.near()[n];
        ++supported_count_;
        for (std::size_t m = 0; m < supported.support.ends.size(); ++m)
            model.neighbourhood.at_point(supported.support.ends[m], total_slope_) += supported.support.slopes[m].norm();
    }
    model.neighbourhood.fill_images(total_slope_);
}

ContactPair SmoothedSurfaceContact::pair_of(const Model& model, const SupportedPoint& supported, Load load) const
{
    const Support& support = supported.support;
    double volume = 0.0;
    double mobility = 0.0; // of the surface, when all points that press on it are pushed alike [1/kg]
    for (std::size_t m = 0; m < support.ends.size(); ++m) {
        const BondEnd& end = model.ends[support.ends[m]];
        volume += support.weights[m] * end.volume;
        const double slope = support.slopes[m].norm();
        mobility += slope * (load == Load::alone ? slope : total_slope_[support.ends[m]]) / end.mass;
    }
    const Points& points = model.state.points;
    return {support.distance, 0.0, points.volume[supported.point], volume, points.mass[supported.point],
            1.0 / mobility};
}

template <class PairOf, class Use>
void SmoothedSurfaceContact::evaluate(const PairOf& pair_of, const Use& use)
{
    std::array<ContactPair, block> pairs;
    std::array<ContactResponse, block> responses;
    for (std::size_t first = 0; first < supported_count_; first += block) {
        const std::size_t count = std::min(block, supported_count_ - first);
        for (std::size_t s = 0; s < count; ++s)
            pairs[s] = pair_of(supported_[first + s]);
        law().evaluate(std::span(pairs.data(), count), std::span(responses.data(), count));
        for (std::size_t s = 0; s < count; ++s)
            use(supported_[first + s], pairs[s], responses[s]);
    }
}

void SmoothedSurfaceContact::add_reactions(const Model& model, const ContactStep& step, ContactSums& sums,
                                           std::vector<Vector3>& force)
{
    const double reach = law().cutoff();
    find_supported_points(model, reach);
    const auto moving_pair = [&](const SupportedPoint& supported) {
        const Support& support = supported.support;
        double opening = support.own_slope.dot(model.ends[supported.point].v());
        for (std::size_t m = 0; m < support.ends.size(); ++m)
            opening += support.slopes[m].dot(model.ends[support.ends[m]].v());
        ContactPair pair = pair_of(model, supported, Load::all);
        pair.approach_speed = -step.approach_factor * opening;
        pair.time_step = step.law_step;
        return pair;
    };
    // In the order of the points: the sum on a point of the surface is then the same for any number of threads.
    evaluate(moving_pair,
             [&](const SupportedPoint& supported, const ContactPair& pair, const ContactResponse& response) {
                 record_overlap((reach - pair.distance) / reach);
                 sums.energy[supported.point] += supported.support.strength * response.energy;
                 add_reaction(model, supported, pair, response, step.time_step, sums, force);
             });
}

void SmoothedSurfaceContact::add_reaction(const Model& model, const SupportedPoint& supported, const ContactPair& pair,
                                          const ContactResponse& response, double time_step, ContactSums& sums,
                                          std::vector<Vector3>& force)
{
    const Neighbourhood& neighbourhood = model.neighbourhood;
    const auto& [i, support] = supported;
    Vector3 surface_velocity = Vector3::Zero();
    for (std::size_t m = 0; m < support.ends.size(); ++m)
        surface_velocity += support.weights[m] * model.ends[support.ends[m]].v();
    const Vector3 relative = model.ends[i].v() - surface_velocity;
    const Vector3 slip = relative - relative.dot(support.normal) * support.normal;
    const double speed = slip.norm();
    const double normal_force = support.strength * std::max(0.0, response.force);
    Vector3 friction = Vector3::Zero();
    if (speed > 0.0 && time_step > 0.0) {
        const double stops = reduced_mass(pair) * speed / time_step;
        friction = -(std::min(law().friction() * normal_force, stops) / speed) * slip;
    }
    // minus the gradient of strength times energy, and the dashpot and friction along the same paths
    const double push = support.strength * response.force;
    const double damping = support.strength * response.damping_force;
    force[i] += push * support.own_slope - response.energy * support.own_strength_slope + friction;
    sums.friction[i] += friction;
    sums.damping[i] += damping * support.own_slope;
    for (std::size_t m = 0; m < support.ends.size(); ++m) {
        const std::uint32_t end = support.ends[m];
        const Vector3 shared = -support.weights[m] * friction;
        const Vector3 reaction = push * support.slopes[m] - response.energy * support.strength_slopes[m] + shared;
        neighbourhood.add_to_point(end, reaction, force);
        neighbourhood.add_to_point(end, shared, sums.friction);
        neighbourhood.add_to_point(end, damping * support.slopes[m], sums.damping);
    }
}

void SmoothedSurfaceContact::add_stored_energy(const Model& model, std::vector<double>& energy)
{
    find_supported_points(model, law().cutoff());
    evaluate([&](const SupportedPoint& supported) { return pair_of(model, supported, Load::alone); },
             [&](const SupportedPoint& supported, const ContactPair&, const ContactResponse& response) {
                 energy[supported.point] += supported.support.strength * response.energy;
             });
}

void SmoothedSurfaceContact::add_bounds(const Model& model, double part_of_margin, std::vector<ContactBound>& bounds)
{
    // (u_i . g_i + sum u_p . g_p) is, squared, at most 2 (u_i . g_i)^2 + 2 sum |g| sum (u_p . g_p)^2/|g_p| with the
    // slopes g of the distance. The surface is never lighter to a point alone than to one of many, and no dashpot is
    // weaker there. The rim bears less than it does here.
    const Neighbourhood& neighbourhood = model.neighbourhood;
    find_supported_points(model, law().cutoff() + part_of_margin * surface_margin * model.state.spacing);
    for (std::size_t s = 0; s < supported_count_; ++s) {
        const auto& [i, support] = supported_[s];
        ContactPair pair = pair_of(model, supported_[s], Load::alone);
        pair.distance = 0.0;
        const ContactSlopes both = slopes(law(), pair);
        add(bounds[i], support.own_slope, pair, both, 2.0 / model.state.points.mass[i]);
        double sum = 0.0;
        for (const Vector3& slope : support.slopes)
            sum += slope.norm();
        for (std::size_t m = 0; m < support.ends.size(); ++m) {
            const double size = support.slopes[m].norm();
            if (size <= 0.0)
                continue;
            const std::uint32_t end = support.ends[m];
            const Vector3 direction = neighbourhood.rotated_to_point(end, support.slopes[m]) / size;
            add(neighbourhood.at_point(end, bounds), direction, pair, both, 2.0 * sum * size / model.ends[end].mass);
        }
    }
}

} // namespace periporo
