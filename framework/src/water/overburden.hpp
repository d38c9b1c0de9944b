// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the soil above a place weighs.
#pragma once

#include "model/model.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace periporo {

/// Weight less buoyancy of a body above a depth, over the area, of a body that is as wide everywhere. Where the density
/// of the points differs or water stands, the body is taken layer by layer, each one spacing high.
class Overburden {
public:
    Overburden(const Model& model, std::uint32_t body);

    /// Height of the top of the body: that of its highest point plus half a spacing [m].
    double top() const { return top_; }
    /// The stress that carries what lies above, compression positive: unit_weight * depth + offset within a layer.
    struct Line {
        double unit_weight; ///< [N/m3]
        double offset;      ///< 0 where all points are alike [Pa]
    };
    /// @param depth below the top, at least 0 [m]
    /// @param point of the body, whose unit weight counts where all are alike
    Line around(double depth, std::size_t point) const;
    /// The same at the depth itself [Pa].
    double at(double depth, std::size_t point) const
    {
        const Line line = around(depth, point);
        return line.unit_weight * depth + line.offset;
    }

private:
    const Model& model_;
    double gravity_; ///< [m/s2]
    double top_;
    std::vector<double> unit_weight_; ///< of each layer, from the top [N/m3]; empty where all points are alike
    std::vector<double> above_;       ///< stress at the top of each layer [Pa]
};

} // namespace periporo
