// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// When points near rigid surfaces must be sought anew.
#pragma once

#include "model/model.hpp"

#include <vector>

namespace periporo {

/// Positions of points and obstacles at a search for the points near rigid surfaces.
struct SurfaceSearch {
    /// Points and obstacles move this far until the next search, in spacings.
    static constexpr double skin = 0.4;

    std::vector<Vector3> positions; ///< of the points; empty: there was no search [m]
    std::vector<Vector3> shifts;    ///< of the obstacles [m]

    static SurfaceSearch at_present(const Model& model);

    bool exists() const { return !positions.empty(); }
    bool fits(const Model& model) const
    {
        return positions.size() == model.size() && shifts.size() == model.state.obstacles.size();
    }
    /// Have points or obstacles moved so far that others may be near?
    bool is_outdated(const Model& model) const;

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points, std::size_t obstacles)
    {
        visit("positions", empty_or(self.positions, points));
        visit("shifts", empty_or(self.shifts, obstacles));
    }
};

} // namespace periporo
