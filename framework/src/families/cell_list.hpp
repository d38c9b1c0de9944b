// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Positions sorted into cubic cells, to find what is near without looking at everything.
#pragma once

#include "periporo/tensor.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

class CellList {
public:
    /// @param reach every pair at most this far apart lies in the same or in adjacent cells [m]
    CellList(std::span<const Vector3> positions, double reach);

    /// Calls visit(index) for everything in the cell of `position` and the 26 around it, in an order that depends on
    /// the positions only.
    template <class Visit>
    void visit_near(const Vector3& position, Visit&& visit) const
    {
        const Cell centre = cell_of(position);
        for (std::int64_t z = centre.z - 1; z <= centre.z + 1; ++z)
            for (std::int64_t y = centre.y - 1; y <= centre.y + 1; ++y) {
                if (z < 0 || z >= count_.z || y < 0 || y >= count_.y)
                    continue;
                const std::int64_t first_x = std::max<std::int64_t>(centre.x - 1, 0);
                const std::int64_t last_x = std::min<std::int64_t>(centre.x + 1, count_.x - 1);
                if (first_x > last_x)
                    continue;
                const std::size_t row = static_cast<std::size_t>((z * count_.y + y) * count_.x);
                for (std::size_t n = start_[row + static_cast<std::size_t>(first_x)];
                     n < start_[row + static_cast<std::size_t>(last_x) + 1]; ++n)
                    visit(order_[n]);
            }
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell_of(const Vector3& position) const;

    Vector3 lower_;
    double size_;
    Cell count_{1, 1, 1};
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> order_;
};

} // namespace periporo
