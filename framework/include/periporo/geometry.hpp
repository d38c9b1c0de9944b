// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of geometry plugins: a solid region and the material points that fill it.
#pragma once

#include "periporo/plugin.hpp"
#include "periporo/tensor.hpp"

#include <vector>

namespace periporo {

/// An axis-aligned box, [m].
struct Bounds {
    Vector3 lower = Vector3::Zero();
    Vector3 upper = Vector3::Zero();
};

/// Material points that fill a body: one whole lattice cell each.
struct PointCloud {
    std::vector<Vector3> positions; ///< [m]
    std::vector<double> volumes;    ///< [m3]; their sum may differ from the geometry's volume, which is reported
};

class Geometry {
public:
    virtual ~Geometry() = default;

    /// True inside and on the surface, decided exactly for the coordinates as given.
    virtual bool contains(const Vector3& position) const = 0;
    /// The smallest axis-aligned box around the geometry.
    virtual Bounds bounds() const = 0;
    /// Exact volume [m3].
    virtual double volume() const = 0;
    /// Fills the geometry with material points about `spacing` [m] apart.
    /// @throws std::runtime_error when the spacing does not fit, saying what would.
    virtual PointCloud fill(double spacing) const = 0;
};

} // namespace periporo
