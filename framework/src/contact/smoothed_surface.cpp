// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "contact/smoothed_surface.hpp"

#include "families/cell_list.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace periporo {
namespace {

constexpr double support_radius = 1.8; ///< of the fit along the surface, in spacings: three points across on a lattice
constexpr double shadow_radius = 1.7;  ///< in spacings; a point with another one above it within it is no surface point
constexpr double shadow_cosine = 0.5;  ///< "above" is within 60 degrees of the normal
/// The mean of the points of the fit lies this far to the side, in spacings, at half a spacing outside the last row:
/// there the body ends.
constexpr double end_of_surface = 0.9;
constexpr double singular_fit = 1e-6; ///< ratio of the pivots below which the points of a fit lie on one line
/// Sum of |w| from which a fit leans out beyond its points: 1 inside a surface, 2 at half a spacing outside the last
/// row. Three points almost in a row at a rim once bore a reaction with weights of thousands: no step is stable then.
constexpr double largest_lever = 3.0;

/// Smooth and zero from distance 1 on.
double bell(double squared_distance)
{
    const double left = 1.0 - squared_distance;
    return left > 0.0 ? left * left : 0.0;
}

/// Direction away from the family of a point, or zero when the family is on all sides alike.
Vector3 outward_normal(const Model& model, std::size_t point)
{
    const FamilyView family = model.families[point];
    Vector3 inward = Vector3::Zero();
    for (std::size_t b = 0; b < family.count; ++b)
        inward += (model.records[family.neighbours[b]].x() - model.records[point].x()).normalized();
    const double size = inward.norm();
    return size > 0.0 ? Vector3(-inward / size) : Vector3(Vector3::Zero());
}

bool is_covered(const Model& model, std::size_t point, const Vector3& normal)
{
    const FamilyView family = model.families[point];
    const double radius = shadow_radius * model.spacing;
    return std::any_of(family.neighbours, family.neighbours + family.count, [&](std::uint32_t c) {
        const Vector3 apart = model.records[c].x() - model.records[point].x();
        const double distance = apart.norm();
        return distance < radius && apart.dot(normal) > shadow_cosine * distance;
    });
}

} // namespace

void SmoothedSurface::find(const Model& model, std::uint32_t surface_body, std::uint32_t other_body, double reach,
                           double slack)
{
    const std::size_t n = model.size();
    nodes_.clear();
    near_.clear();
    candidates_.clear();
    first_.assign(1, 0);
    reach_ = std::hypot(support_radius * model.spacing, reach + 0.5 * model.spacing);
    std::vector<Vector3> normals(n, Vector3::Zero());
    for (std::size_t i = 0; i < n; ++i) {
        if (model.points.body[i] != surface_body)
            continue;
        const Vector3 normal = outward_normal(model, i);
        if (!is_covered(model, i, normal))
            normals[i] = normal;
    }
    std::vector<Vector3> positions;
    for (std::uint32_t c = 0; c < model.records.size(); ++c) {
        const Vector3& normal = normals[model.families.parent(c)];
        if (normal.isZero(0.0))
            continue;
        nodes_.push_back({c, model.isometries[model.families.isometry(c)].direction(normal)});
        positions.push_back(model.records[c].x());
    }
    if (nodes_.empty())
        return;
    const double search = reach_ + slack;
    const CellList cells(positions, search);
    for (std::uint32_t i = 0; i < n; ++i) {
        if (model.points.body[i] != other_body)
            continue;
        const Vector3 x = model.records[i].x();
        cells.visit_near(x, [&](std::uint32_t node) {
            if ((positions[node] - x).squaredNorm() <= search * search)
                candidates_.push_back(node);
        });
        if (candidates_.size() == first_.back())
            continue;
        near_.push_back(i);
        first_.push_back(candidates_.size());
    }
}

bool SmoothedSurface::find_support(const Model& model, std::size_t n, Support& support) const
{
    const Vector3 x = model.records[near_[n]].x();
    support.records.clear();
    support.weights.clear();
    support.normal.setZero();
    const double across = 1.0 / (reach_ * reach_);
    for (std::size_t c = first_[n]; c < first_[n + 1]; ++c) {
        const Node& node = nodes_[candidates_[c]];
        support.normal += bell(across * (model.records[node.record].x() - x).squaredNorm()) * node.normal;
    }
    const double size = support.normal.norm();
    if (!(size > 0.0))
        return false;
    support.normal /= size;

    // Weights bell(xi) (a + b . xi) with xi along the surface, in spacings; a and b from the conditions on them.
    const double radius = support_radius * model.spacing;
    const Vector3 first_axis = support.normal.unitOrthogonal();
    const Vector3 second_axis = support.normal.cross(first_axis);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    const auto features = [&](std::uint32_t record) {
        const Vector3 apart = (model.records[record].x() - x) / radius;
        return Vector3(1.0, apart.dot(first_axis), apart.dot(second_axis));
    };
    for (std::size_t c = first_[n]; c < first_[n + 1]; ++c) {
        const std::uint32_t record = nodes_[candidates_[c]].record;
        const Vector3 feature = features(record);
        const double weight = bell(feature.tail<2>().squaredNorm());
        if (weight <= 0.0)
            continue;
        support.records.push_back(record);
        support.weights.push_back(weight);
        moments += weight * feature * feature.transpose();
    }
    if (support.records.empty() || moments.col(0).tail<2>().norm() * support_radius > end_of_surface * moments(0, 0))
        return false;
    const Eigen::LDLT<Eigen::Matrix3d> solver(moments);
    if (!(solver.vectorD().minCoeff() > singular_fit * solver.vectorD().maxCoeff()))
        return false;
    const Vector3 coefficients = solver.solve(Vector3::UnitX());
    Vector3 foot = Vector3::Zero();
    double weights = 0.0;
    for (std::size_t m = 0; m < support.records.size(); ++m) {
        support.weights[m] *= coefficients.dot(features(support.records[m]));
        weights += std::abs(support.weights[m]);
        foot += support.weights[m] * model.records[support.records[m]].x();
    }
    if (!(weights < largest_lever))
        return false;
    support.distance = (x - foot).dot(support.normal) - 0.5 * model.spacing;
    return true;
}

} // namespace periporo
