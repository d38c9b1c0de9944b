// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The body between two surfaces of triangles over one rectangular grid.
#pragma once

#include "common/triangle_mesh.hpp"

#include <vector>

namespace periporo::geometry {

/// Each cell of the grid has two triangles above and two below, parted by its diagonal from south-west to north-east.
/// The sides are upright.
class Layer {
public:
    /// @param x of the columns, ascending [m]
    /// @param y of the rows, ascending [m]
    /// @param top heights row by row, x first [m]
    /// @param bottom as top, and lower everywhere [m]
    Layer(std::vector<double> x, std::vector<double> y, std::vector<double> top, std::vector<double> bottom);

    /// True inside and on the surface, decided exactly.
    bool contains(const Vector3& position) const;
    Bounds bounds() const;
    double volume() const;
    /// The surface, facing outwards.
    Mesh surface() const;

private:
    std::size_t at(std::size_t column, std::size_t row) const { return row * x_.size() + column; }
    bool contains_in_cell(std::size_t column, std::size_t row, const Vector3& position) const;

    std::vector<double> x_;
    std::vector<double> y_;
    std::vector<double> top_;
    std::vector<double> bottom_;
};

} // namespace periporo::geometry
