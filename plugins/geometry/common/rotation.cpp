// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The exact rotation matrix of a quaternion.
#include "rotation.hpp"

#include <cmath>
#include <numbers>

namespace periporo::geometry {

namespace {

/// A quaternion, of any length, of its scalar and its vector.
Eigen::Quaterniond quaternion(double scalar, const Vector3& vector)
{
    return {scalar, vector.x(), vector.y(), vector.z()};
}

/// The quaternion of the rotation. For a whole number of quarter turns cos and sin of the half angle are 0, 1 or equal,
/// and are taken so instead of rounded: a quarter turn about z then maps x onto y and nothing else.
Eigen::Quaterniond turn(const Vector3& axis, double angle)
{
    const Vector3 direction = axis / axis.lpNorm<Eigen::Infinity>(); // exact for an axis along a coordinate axis
    const double length = direction.norm();
    const double quarters = angle / (std::numbers::pi / 2);
    const double whole = std::round(quarters);
    if (std::abs(quarters - whole) <= 8 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(whole))) {
        switch (static_cast<int>(std::fmod(whole, 4.0) + 4.0) % 4) {
        case 0:
            return quaternion(1.0, Vector3::Zero());
        case 1:
            return quaternion(length, direction);
        case 2:
            return quaternion(0.0, direction);
        default:
            return quaternion(length, -direction);
        }
    }
    return quaternion(std::cos(angle / 2) * length, std::sin(angle / 2) * direction);
}

/// The quaternion (|n| + n_z, z x n) of the shortest turn of z into n, without the difference of nearly equal numbers
/// that |n| + n_z is for an n near -z. Of -z itself, a half turn about x.
Eigen::Quaterniond shortest_turn_of_z(const Vector3& direction)
{
    const int exponent = std::ilogb(direction.lpNorm<Eigen::Infinity>());
    const Vector3 n = direction.unaryExpr([&](double component) { return std::scalbn(component, -exponent); });
    const double across = n.head<2>().squaredNorm();
    if (across == 0.0)
        return n.z() > 0.0 ? quaternion(1.0, Vector3::Zero()) : quaternion(0.0, Vector3::UnitX());
    const double length = n.norm();
    return quaternion(n.z() > 0.0 ? length + n.z() : across / (length - n.z()), {-n.y(), n.x(), 0.0});
}

} // namespace

Rotation::Rotation(const Eigen::Quaterniond& quaternion)
{
    const Exact w = quaternion.w();
    const Exact x = quaternion.x();
    const Exact y = quaternion.y();
    const Exact z = quaternion.z();
    exact_axes_[0] = {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
    exact_axes_[1] = {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
    exact_axes_[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
    scale_ = w * w + x * x + y * y + z * z;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            matrix_(row, column) = CGAL::to_double(Exact(exact_axis(column)[row] / scale_));
}

Rotation::Rotation(const Vector3& axis, double angle) : Rotation(turn(axis, angle)) {}

Rotation Rotation::of_z_to(const Vector3& direction)
{
    return Rotation(shortest_turn_of_z(direction));
}

} // namespace periporo::geometry
