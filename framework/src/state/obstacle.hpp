// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rigid things that bodies touch: floors, walls, tubes, footings.
#pragma once

#include "periporo/geometry.hpp"

#include <memory>
#include <string>

namespace periporo {

/// A geometry that keeps its shape and moves with a given velocity.
struct Obstacle {
    std::string name;
    std::shared_ptr<const Geometry> geometry;
    Vector3 shift = Vector3::Zero();    ///< from where the geometry describes it [m]
    Vector3 velocity = Vector3::Zero(); ///< in this stage [m/s]
    bool present = true;                ///< in this stage

    /// Signed distance of a position from its surface [m]; `normal` becomes the direction away from it.
    double distance(const Vector3& position, Vector3& normal) const
    {
        return geometry->signed_distance(position - shift, normal);
    }
};

} // namespace periporo
