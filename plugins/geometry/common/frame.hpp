// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Turned axes with an origin of their own: where a position lies in them, to rounding or exactly.
#pragma once

#include "common/exact.hpp"
#include "common/rotation.hpp"

#include "periporo/geometry.hpp"

#include <array>

namespace periporo::geometry {

/// The parameters "origin", "rotation_axis" and "rotation_angle" of a geometry that stands in a frame.
/// @param origin what the origin is in the geometry
std::vector<Parameter> frame_parameters(const char* origin);

class Frame {
public:
    Frame(const Rotation& rotation, const Vector3& origin);
    /// Of frame_parameters().
    /// @throws std::runtime_error when the axis of the rotation is zero.
    explicit Frame(const Parameters& parameters);

    const Vector3& origin() const { return origin_; }
    /// The columns are the frame's axes.
    const Eigen::Matrix3d& axes() const { return rotation_.matrix(); }
    Vector3 global(const Vector3& local) const { return origin_ + axes() * local; }
    Vector3 local(const Vector3& global) const { return axes().transpose() * (global - origin_); }
    /// More than the rounding of each component of local().
    double doubt(const Vector3& global) const { return rounding * (global.lpNorm<1>() + origin_.lpNorm<1>()); }

    /// local() times scale(), exactly: there is no division and no root in it.
    ExactPoint scaled_local(const Vector3& global) const;
    const Exact& scale() const { return rotation_.scale(); }

    /// The smallest axis-aligned box around a box along the axes of the frame.
    Bounds bounds(const Bounds& local) const;

private:
    Rotation rotation_;
    Vector3 origin_;
    ExactPoint exact_origin_;
};

} // namespace periporo::geometry
