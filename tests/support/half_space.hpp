// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The simplest geometry that can be an obstacle.
#pragma once

#include "state/obstacle.hpp"

#include <limits>

namespace periporo::test {

/// Everything below the plane through the origin with the given normal.
class HalfSpace : public Geometry {
public:
    explicit HalfSpace(const Vector3& normal) : normal_(normal.normalized()) {}
    bool contains(const Vector3& position) const override { return normal_.dot(position) <= 0.0; }
    Bounds bounds() const override
    {
        const double far = std::numeric_limits<double>::infinity();
        return {Vector3::Constant(-far), Vector3::Constant(far)};
    }
    double volume() const override { return std::numeric_limits<double>::infinity(); }
    bool has_distance() const override { return true; }
    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        normal = normal_;
        return normal_.dot(position);
    }

private:
    Vector3 normal_;
};

} // namespace periporo::test
