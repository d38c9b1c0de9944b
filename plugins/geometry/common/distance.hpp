// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Signed distances from simple bodies, and from bodies put together of them.
#pragma once

#include "periporo/tensor.hpp"

#include <cmath>

namespace periporo::geometry {

/// Of a position from the surface of a body.
struct SignedDistance {
    double value = 0.0; ///< [m] positive outside
    Vector3 outward;    ///< the unit direction in which it grows fastest
};

/// The unit vector along v, however short it is, or `otherwise` along none.
inline Vector3 unit_vector(const Vector3& v, const Vector3& otherwise)
{
    const double largest = v.lpNorm<Eigen::Infinity>();
    return largest > 0.0 ? Vector3((v / largest).normalized()) : otherwise;
}

/// From lower <= coordinate <= upper, a layer between two planes at right angles to `direction`.
inline SignedDistance distance_from_layer(double coordinate, double lower, double upper, const Vector3& direction)
{
    if (coordinate - lower < upper - coordinate)
        return {lower - coordinate, -direction};
    return {coordinate - upper, direction};
}

/// From what two bodies have in common, each of them endless in the directions in which the other one ends, as a prism
/// is of an endless column and a layer.
inline SignedDistance distance_from_common(const SignedDistance& a, const SignedDistance& b)
{
    if (a.value > 0.0 && b.value > 0.0) // then an edge is nearest, as far away along either direction as said
        return {std::hypot(a.value, b.value), unit_vector(a.value * a.outward + b.value * b.outward, a.outward)};
    return a.value > b.value ? a : b;
}

} // namespace periporo::geometry
