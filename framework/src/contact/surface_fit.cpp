// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Solves for the plane, and prepares its derivatives.
#include "contact/surface_fit.hpp"

#include <Eigen/Eigenvalues>

namespace periporo {

bool PlaneFit::solve(const Vector3& outwards)
{
    if (!(weight_ > 0.0))
        return false;
    mean_ = first_ / weight_;
    const Eigen::Matrix3d scatter = second_ - weight_ * mean_ * mean_.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    const Vector3& values = solver.eigenvalues();
    const Eigen::Matrix3d& axes = solver.eigenvectors();
    const double second = values[1] - values[0], third = values[2] - values[0];
    if (!(second > 0.0))
        return false;
    normal_ = axes.col(0);
    if (normal_.dot(outwards) < 0.0)
        normal_ = -normal_;
    height_ = -mean_.dot(normal_);
    spread_ = second * third / (second + third);
    // d(height) = -n.d(mean) - mean.dn, with dn = sum_k e_k (e_k.dC n)/(mu_1 - mu_k)
    tilt_ = axes.col(1) * (axes.col(1).dot(mean_) / second) + axes.col(2) * (axes.col(2).dot(mean_) / third);
    const double by_second = spread_ * spread_ / (second * second), by_third = spread_ * spread_ / (third * third);
    spread_slopes_ = by_second * axes.col(1) * axes.col(1).transpose() +
                     by_third * axes.col(2) * axes.col(2).transpose() -
                     (by_second + by_third) * normal_ * normal_.transpose();
    return true;
}

} // namespace periporo
