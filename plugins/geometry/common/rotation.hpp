// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A rotation whose matrix is orthogonal to the last digit when taken exactly.
#pragma once

#include "periporo/tensor.hpp"

#include "common/exact.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>

namespace periporo::geometry {

/// The rotation of a quaternion q whose components are doubles. R(q)/|q|^2 is then a matrix of rational numbers and
/// exactly orthogonal, so that a rotated box has exactly right angles and opposite faces exactly parallel. It differs
/// from the rotation asked for by rounding only, and whole quarter turns about a coordinate axis are exact.
class Rotation {
public:
    /// @param axis direction of any length but zero
    /// @param angle right-handed about the axis [rad]
    Rotation(const Vector3& axis, double angle);
    /// The shortest turn of z into a direction of any length but zero; into -z the half turn about x.
    static Rotation of_z_to(const Vector3& direction);

    /// The columns are the rotated coordinate axes, rounded to double.
    const Eigen::Matrix3d& matrix() const { return matrix_; }
    /// The rotated coordinate axis times scale(), exactly.
    const ExactVector& exact_axis(int i) const { return exact_axes_[static_cast<std::size_t>(i)]; }
    /// |q|^2 > 0
    const Exact& scale() const { return scale_; }

private:
    explicit Rotation(const Eigen::Quaterniond& quaternion);

    std::array<ExactVector, 3> exact_axes_;
    Exact scale_;
    Eigen::Matrix3d matrix_;
};

} // namespace periporo::geometry
