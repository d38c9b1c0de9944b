// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The highest mode by the Arnoldi process, and the step that it allows.
#include "time/stable_step.hpp"

#include "state/ordered_sum.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace periporo {
namespace {

constexpr double invariant = 1e-10; // what is left of a vector when the basis holds all of it

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

using Vectors = std::vector<Vector3>;

double mass_product(const Points& points, const Vectors& a, const Vectors& b)
{
    return ordered_sums<1>(
        a.size(), [&](std::size_t i, std::array<double, 1>& sum) { sum[0] += points.mass[i] * a[i].dot(b[i]); })[0];
}

void scale(Vectors& vector, double factor)
{
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < vector.size(); ++i)
        vector[i] *= factor;
}

void add(Vectors& to, double factor, const Vectors& vector)
{
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < to.size(); ++i)
        to[i] += factor * vector[i];
}

/// Length 1 in the mass product; false when it has none.
bool normalize(const Points& points, Vectors& vector)
{
    const double squared = mass_product(points, vector, vector);
    if (!(squared > 0.0))
        return false;
    scale(vector, 1.0 / std::sqrt(squared));
    return true;
}

struct Ritz {
    double value = 0.0;
    Eigen::VectorXd vector; ///< of length 1, in the basis
};

Ritz highest_ritz(const Eigen::MatrixXd& projected)
{
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(projected);
    Eigen::Index highest = 0;
    const double value = solver.eigenvalues().real().maxCoeff(&highest);
    return {value, solver.eigenvectors().col(highest).real().normalized()};
}

} // namespace

double FrequencyEstimate::update(Model& model, const ForceState& force_state, std::span<const Eigen::Matrix3d> grounded)
{
    const Points& points = model.state.points;
    result_.resize(model.size());
    result_.active.resize(model.neighbourhood.families.packs());
    Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(most_evaluations, most_evaluations);
    Ritz highest;
    begin_basis(points);
    for (evaluations_ = 0; evaluations_ < most_evaluations && normalize(points, basis(evaluations_));) {
        const Eigen::Index column = evaluations_++;
        if (basis_.size() <= static_cast<std::size_t>(evaluations_))
            basis_.emplace_back();
        Vectors& image = basis(evaluations_);
        image.resize(model.size());
        apply_tangent(model, force_state, grounded, basis(column), image);
        const double before = std::sqrt(mass_product(points, image, image));
        for (Eigen::Index row = 0; row <= column; ++row) {
            projected(row, column) = mass_product(points, basis(row), image);
            add(image, -projected(row, column), basis(row));
        }
        const double left = std::sqrt(mass_product(points, image, image));
        highest = highest_ritz(projected.topLeftCorner(evaluations_, evaluations_));
        if (left <= invariant * before || left * std::abs(highest.vector[column]) <= residual * highest.value)
            break;
        if (evaluations_ < most_evaluations)
            projected(evaluations_, column) = left;
    }
    if (evaluations_ == 0)
        return 0.0;

    mode_.assign(model.size(), Vector3::Zero());
    for (Eigen::Index b = 0; b < evaluations_; ++b)
        add(mode_, highest.vector[b], basis(b));
    normalize(points, mode_);
    basis_.resize(static_cast<std::size_t>(evaluations_) + 1); // a first search takes many more than a renewal
    return std::sqrt(std::max(highest.value, 0.0));
}

void FrequencyEstimate::apply_tangent(Model& model, const ForceState& force_state,
                                      std::span<const Eigen::Matrix3d> grounded, const Vectors& displacement,
                                      Vectors& acceleration)
{
    displaced_.gather(model.state.points, displacement, model.neighbourhood);
    force_state.evaluate({model.state, model.neighbourhood, displaced_},
                         {StressUpdate::tangent, MaterialResponse::elastic, 0.0}, model.bonds, model.workspace,
                         result_);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model.size(); ++i)
        acceleration[i] = -result_.internal_force[i] / model.state.points.mass[i];
    if (grounded.empty())
        return;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model.size(); ++i)
        acceleration[i] += grounded[i] * displacement[i];
}

void FrequencyEstimate::begin_basis(const Points& points)
{
    if (basis_.empty())
        basis_.emplace_back();
    Vectors& first = basis_.front();
    first.resize(points.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < first.size(); ++i)
        first[i] = scattered(i);
    normalize(points, first);
    if (mode_.size() == first.size())
        add(first, 1.0, mode_);
}

StableStep stable_step(Model& model, const ForceState& force_state, ContactForces& contact, FrequencyEstimate& estimate,
                       double safety, double last_step, bool damped, double resolution)
{
    StableStep result;
    result.wave_limit = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model.size(); ++i) {
        const Material& material = *model.body_of(i).material;
        const double density = model.state.points.mass[i] / model.state.points.volume[i];
        const double speed = std::sqrt((material.bulk_modulus() + 4.0 / 3.0 * material.shear_modulus()) / density);
        result.wave_limit = std::min(result.wave_limit, 1.5 * model.state.spacing / speed);
    }
    model.gather_ends();
    const std::vector<ContactBound>& bounds = contact.bounds(model);
    result.sharpest = contact.sharpest();
    const double resolved =
        result.sharpest > 0.0 ? resolution / result.sharpest : std::numeric_limits<double>::infinity();
    const double last = std::min(last_step > 0.0 ? last_step : safety * result.wave_limit, resolved);
    const double damping = damped ? 2.0 * safety / last : 0.0;
    std::vector<Eigen::Matrix3d> grounded(model.size());
    std::ranges::transform(bounds, grounded.begin(), [damping](const ContactBound& bound) -> Eigen::Matrix3d {
        return bound.stiffness + damping * bound.damping;
    });
    const double together = std::pow(estimate.update(model, force_state, grounded), 2);
    if (damped)
        result.damping_rate = ordered_sums<1>(model.size(), [&](std::size_t i, std::array<double, 1>& sum) {
            sum[0] += model.state.points.mass[i] * estimate.mode()[i].dot(bounds[i].damping * estimate.mode()[i]);
        })[0];
    const double squared = together - damping * result.damping_rate;
    result.frequency = std::sqrt(std::max(squared, 0.0));
    // Of a step longer than the last one dashpots take less than was counted, of a shorter one more.
    result.limit = together > 0.0 ? 2.0 / std::sqrt(together) : std::numeric_limits<double>::infinity();
    if (damping * result.limit < 2.0 && squared > 0.0)
        result.limit = damped_limit(squared, result.damping_rate);
    result.step = std::min({safety * result.limit, result.wave_limit, resolved});
    return result;
}

double contact_resolution(bool damped)
{
    return damped ? damped_contact_resolution : 0.8;
}

double damped_limit(double frequency_squared, double damping_rate)
{
    return (std::sqrt(damping_rate * damping_rate + 4.0 * frequency_squared) - damping_rate) / frequency_squared;
}

double local_damping_factor(double coefficient)
{
    return 1.0 / std::sqrt(1.0 + coefficient);
}

} // namespace periporo
