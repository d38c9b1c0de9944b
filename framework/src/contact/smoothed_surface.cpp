// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds surface points and which points are near them, and fits the plane that supports a point.
#include "contact/smoothed_surface.hpp"

#include "neighbourhood/cell_list.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {
namespace {

constexpr double support_radius = 1.8; ///< of the fit along the surface, in spacings: three points across on a lattice
/// A point counts less for the surface the closer another point lies above it, and the nearer that one is to the
/// normal. In a lattice points at the surface have others at up to a cosine of 0.53, points below it have one at 0.82
/// or more.
constexpr double free_cosine = 0.57, covered_cosine = 0.78;
constexpr double covered_distance = 1.55, free_distance = 1.85; ///< in spacings
/// Cosine between the normals of a surface point and of the surface around: points that look the other way, as those at
/// the bottom of a thin body, do not count. Those at the side of a block count for a point above its edge, which is
/// round so; without them the edge would be sharp, but what counts would change with every small motion.
constexpr double away_cosine = -0.7, facing_cosine = -0.2;
/// Spread of a fit, in squared spacings, from which the surface bears wholly. Of a point a spacing above the last
/// points it is 0.45 inside a lattice, 0.22 above the last row, 0.13 above a corner, and 0.05 at half a spacing beyond
/// the last row; nearer points have more.
constexpr double bearing_spread = 0.1;
constexpr double least_spread = 0.02; ///< in squared spacings, below which it bears nothing

struct Step {
    double value;
    double slope;
};

/// From 0 at `from` to 1 at `to`, with a slope that begins and ends at 0.
Step smooth_step(double x, double from, double to)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return {t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / (to - from)};
}

/// Direction away from the family of a point, or zero when the family is on all sides alike.
Vector3 outward_normal(const Model& model, std::size_t point)
{
    const FamilyView family = model.neighbourhood.families[point];
    Vector3 inward = Vector3::Zero();
    for (std::size_t b = 0; b < family.count; ++b)
        inward += (model.ends[family.neighbours[b]].x() - model.ends[point].x()).normalized();
    const double size = inward.norm();
    return size > 0.0 ? Vector3(-inward / size) : Vector3(Vector3::Zero());
}

/// 1 for a point at the surface, 0 for one below it.
double share_in_surface(const Model& model, std::size_t point, const Vector3& normal)
{
    const FamilyView family = model.neighbourhood.families[point];
    double share = 1.0;
    for (std::size_t b = 0; b < family.count && share > 0.0; ++b) {
        const Vector3 apart = model.ends[family.neighbours[b]].x() - model.ends[point].x();
        const double distance = apart.norm();
        if (distance >= free_distance * model.state.spacing || apart.dot(normal) <= free_cosine * distance)
            continue;
        const double above = smooth_step(apart.dot(normal) / distance, free_cosine, covered_cosine).value;
        const double close = smooth_step(distance / model.state.spacing, free_distance, covered_distance).value;
        share = std::min(share, 1.0 - above * close);
    }
    return share;
}

} // namespace

void SmoothedSurface::find_nodes(const Model& model, std::uint32_t surface_body)
{
    nodes_.clear();
    const std::size_t n = model.size();
    std::vector<Vector3> normals(model.neighbourhood.ends(), Vector3::Zero()); // those of images not rotated
    std::vector<double> shares(model.neighbourhood.ends(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        if (model.state.points.body[i] != surface_body)
            continue;
        normals[i] = outward_normal(model, i);
        if (!normals[i].isZero(0.0))
            shares[i] = share_in_surface(model, i, normals[i]);
    }
    model.neighbourhood.fill_images(normals);
    model.neighbourhood.fill_images(shares);
    for (std::uint32_t c = 0; c < model.ends.size(); ++c)
        if (shares[c] > 0.0) {
            const Isometry& isometry = model.neighbourhood.isometries[model.neighbourhood.families.isometry(c)];
            nodes_.push_back({c, isometry.direction(normals[c]), shares[c]});
        }
}

void SmoothedSurface::find(const Model& model, std::uint32_t surface_body, std::uint32_t other_body, double reach,
                           double slack)
{
    near_.clear();
    candidates_.clear();
    first_.assign(1, 0);
    spacing_ = model.state.spacing;
    reach_ = std::hypot(support_radius * model.state.spacing, reach + 0.5 * model.state.spacing);
    find_nodes(model, surface_body);
    shares_.clear();
    outward_.clear();
    if (nodes_.empty())
        return;
    std::vector<Vector3> positions(nodes_.size());
    std::ranges::transform(nodes_, positions.begin(), [&](const Node& node) { return model.ends[node.end].x(); });
    const double search = reach_ + slack;
    const CellList cells(positions, search);
    for (std::uint32_t i = 0; i < model.size(); ++i) {
        if (model.state.points.body[i] != other_body)
            continue;
        const Vector3 x = model.ends[i].x();
        cells.visit_near(x, [&](std::uint32_t node) {
            if ((positions[node] - x).squaredNorm() <= search * search)
                candidates_.push_back(node);
        });
        if (candidates_.size() == first_.back())
            continue;
        near_.push_back(i);
        first_.push_back(candidates_.size());
        shares_.resize(candidates_.size());
        outward_.emplace_back(Vector3::Zero());
        set_shares(model, near_.size() - 1, slack);
    }
}

void SmoothedSurface::set_shares(const Model& model, std::size_t n, double slack)
{
    const Vector3 x = model.ends[near_[n]].x();
    const double search = reach_ + slack;
    Vector3& outwards = outward_[n];
    for (std::size_t c = first_[n]; c < first_[n + 1]; ++c) {
        const Node& node = nodes_[candidates_[c]];
        const double squared = (model.ends[node.end].x() - x).squaredNorm() / (search * search);
        outwards += node.share * bell(squared).value * node.normal;
    }
    outwards.normalize();
    for (std::size_t c = first_[n]; c < first_[n + 1]; ++c) {
        const Node& node = nodes_[candidates_[c]];
        shares_[c] = node.share * smooth_step(node.normal.dot(outwards), away_cosine, facing_cosine).value;
    }
}

PlaneFit SmoothedSurface::fit(const Model& model, std::size_t n) const
{
    const Vector3 x = model.ends[near_[n]].x();
    PlaneFit plane;
    for (std::size_t c = first_[n]; c < first_[n + 1]; ++c) {
        const Vector3 place = model.ends[nodes_[candidates_[c]].end].x() - x;
        const double weight = shares_[c] * bell(place.squaredNorm() / (reach_ * reach_)).value;
        if (weight > 0.0)
            plane.add(weight, place);
    }
    return plane;
}

bool SmoothedSurface::find_support(const Model& model, std::size_t n, Support& support) const
{
    const Vector3 x = model.ends[near_[n]].x();
    const double per_area = 1.0 / (spacing_ * spacing_), per_reach = 1.0 / (reach_ * reach_);
    PlaneFit plane = fit(model, n);
    if (!plane.solve(outward_[n]) || plane.spread() * per_area <= least_spread)
        return false;
    const Step strength = smooth_step(plane.spread() * per_area, least_spread, bearing_spread);
    support.normal = plane.normal();
    support.distance = plane.height() - 0.5 * spacing_;
    support.strength = strength.value;
    support.ends.clear();
    support.weights.clear();
    support.slopes.clear();
    support.strength_slopes.clear();
    support.own_slope.setZero();
    support.own_strength_slope.setZero();
    for (std::size_t c = first_[n]; c < first_[n + 1]; ++c) {
        const std::uint32_t end = nodes_[candidates_[c]].end;
        const Vector3 place = model.ends[end].x() - x;
        const Bell around = bell(place.squaredNorm() * per_reach);
        const double weight = shares_[c] * around.value;
        if (weight <= 0.0)
            continue;
        const Vector3 by_weight = 2.0 * per_reach * shares_[c] * around.slope * place;
        const auto in_all = [&](const PlaneFit::Slope& slope) {
            return Vector3(weight * slope.by_place + slope.by_weight * by_weight);
        };
        support.ends.push_back(end);
        support.weights.push_back(weight * plane.part(place));
        support.slopes.push_back(in_all(plane.slope_of_height(place)));
        support.own_slope -= support.slopes.back();
        support.strength_slopes.push_back(
            strength.slope > 0.0 ? Vector3(strength.slope * per_area * in_all(plane.slope_of_spread(place)))
                                 : Vector3(Vector3::Zero()));
        support.own_strength_slope -= support.strength_slopes.back();
    }
    return true;
}

} // namespace periporo
