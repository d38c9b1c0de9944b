// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The exact rotation matrix of a quaternion.
#include "rotation.hpp"

#include <cmath>
#include <numbers>

namespace periporo::geometry {

namespace {

struct Quaternion {
    double w;
    Vector3 v;
};

/// The quaternion of the rotation, of any length. For a whole number of quarter turns cos and sin of the half angle are
/// 0, 1 or equal, and are taken so instead of rounded: a quarter turn about z then maps x onto y and nothing else.
Quaternion quaternion(const Vector3& axis, double angle)
{
    const Vector3 direction = axis / axis.lpNorm<Eigen::Infinity>(); // exact for an axis along a coordinate axis
    const double length = direction.norm();
    const double quarters = angle / (std::numbers::pi / 2);
    const double whole = std::round(quarters);
    if (std::abs(quarters - whole) <= 8 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(whole))) {
        switch (static_cast<int>(std::fmod(whole, 4.0) + 4.0) % 4) {
        case 0:
            return {1.0, Vector3::Zero()};
        case 1:
            return {length, direction};
        case 2:
            return {0.0, direction};
        default:
            return {length, -direction};
        }
    }
    return {std::cos(angle / 2) * length, std::sin(angle / 2) * direction};
}

} // namespace

Rotation::Rotation(const Vector3& axis, double angle)
{
    const Quaternion q = quaternion(axis, angle);
    const Exact w = q.w;
    const Exact x = q.v.x();
    const Exact y = q.v.y();
    const Exact z = q.v.z();
    exact_axes_[0] = {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
    exact_axes_[1] = {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
    exact_axes_[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
    scale_ = w * w + x * x + y * y + z * z;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            matrix_(row, column) = CGAL::to_double(Exact(exact_axis(column)[row] / scale_));
}

} // namespace periporo::geometry
