// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Positions in turned axes.
#include "frame.hpp"

#include "common/vector.hpp"

namespace periporo::geometry {

std::vector<Parameter> frame_parameters(const char* origin)
{
    std::vector<Parameter> records;
    records.push_back(
        Parameter::real_list("origin", dimension::length, 3, origin).by_default(std::vector<double>{0.0, 0.0, 0.0}));
    records.push_back(
        Parameter::real_list("rotation_axis", dimension::none, 3, "Axis through the origin to rotate about")
            .by_default(std::vector<double>{0.0, 0.0, 1.0}));
    records.push_back(
        Parameter::real("rotation_angle", dimension::angle, "Right-handed angle about the axis, in radian or \"deg\"")
            .by_default(0.0));
    return records;
}

Frame::Frame(const Rotation& rotation, const Vector3& origin)
    : rotation_(rotation), origin_(origin), exact_origin_(exact_point(origin))
{
}

Frame::Frame(const Parameters& parameters)
    : Frame(Rotation(direction(parameters, "rotation_axis"), parameters.real("rotation_angle")),
            vector(parameters, "origin"))
{
}

ExactPoint Frame::scaled_local(const Vector3& global) const
{
    const ExactVector offset = exact_point(global) - exact_origin_;
    return {offset * rotation_.exact_axis(0), offset * rotation_.exact_axis(1), offset * rotation_.exact_axis(2)};
}

Bounds Frame::bounds(const Bounds& local) const
{
    // Each edge reaches down or up along each coordinate.
    const Eigen::Matrix3d lower = axes() * local.lower.asDiagonal();
    const Eigen::Matrix3d upper = axes() * local.upper.asDiagonal();
    return {origin_ + lower.cwiseMin(upper).rowwise().sum(), origin_ + lower.cwiseMax(upper).rowwise().sum()};
}

} // namespace periporo::geometry
