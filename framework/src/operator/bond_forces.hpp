// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Internal forces of points from the force states of bonds, and what every force state reports.
#pragma once

#include "model/model.hpp"
#include "periporo/material.hpp"

#include <limits>
#include <vector>

namespace periporo {

/// internal_force_i = V_i sum_j V_j (T_ij - T_ji); T_ji of an image bond is the mirrored T of its parent's bond. The
/// sum runs over the bonds in their order, one point at a time: no result depends on the number of threads.
void sum_bond_forces(Model& model);

/// Keeps the failure of the first point, whichever thread met it.
class FirstFailure {
public:
    void report(std::size_t point, const MaterialStatus& status)
    {
#pragma omp critical(periporo_material_failure)
        if (point < point_) {
            point_ = point;
            status_ = status;
        }
    }
    /// @throws MaterialFailure when one was reported.
    void raise(const Model& model) const;

private:
    std::size_t point_ = std::numeric_limits<std::size_t>::max();
    MaterialStatus status_;
};

} // namespace periporo
