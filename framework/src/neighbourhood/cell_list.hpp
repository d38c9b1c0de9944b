// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Positions sorted into cubic cells, to find what is near without looking at everything.
#pragma once

#include "periporo/pack.hpp"
#include "periporo/tensor.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

class CellList {
public:
    /// @param reach every pair at most this far apart lies in the same or in adjacent cells [m]
    CellList(std::span<const Vector3> positions, double reach);

    /// Calls visit(index) for everything within the reach of `position` and, as rounding has it, hardly beyond, in an
    /// order that depends on the positions only.
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
                const std::size_t end = start_[row + static_cast<std::size_t>(last_x) + 1];
                for (std::size_t n = start_[row + static_cast<std::size_t>(first_x)]; n < end; n += pack_width)
                    for (unsigned near = near_bits(position, n, end); near != 0; near &= near - 1)
                        visit(order_[n + static_cast<std::size_t>(std::countr_zero(near))]);
            }
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell_of(const Vector3& position) const;

    /// Which of the pack of positions that begins at place n, and ends before `end`, are near: bit l is place n + l.
    unsigned near_bits(const Vector3& position, std::size_t n, std::size_t end) const
    {
        Pack squared = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const Pack apart = Pack(coordinates_[c].data() + n, std::experimental::element_aligned) -
                               position[static_cast<Eigen::Index>(c)];
            squared += apart * apart;
        }
        const unsigned inside = end - n < pack_width ? (1u << (end - n)) - 1u : ~0u;
        return lane_bits(squared <= near_squared_) & inside;
    }

    Vector3 lower_;
    double size_;
    double near_squared_;
    Cell count_{1, 1, 1};
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> order_;               // positions cell by cell
    std::array<std::vector<double>, 3> coordinates_; // of the positions in this order, and room for a pack
};

} // namespace periporo
