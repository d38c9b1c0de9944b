// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The memory of a result.
#include "model/operator_result.hpp"

namespace periporo {

void OperatorResult::resize(std::size_t points)
{
    internal_force.assign(points, Vector3::Zero());
    volume_rate.assign(points, 0.0);
    stress_work.assign(points, 0.0);
    inactive_bonds.assign(points, 0);
    detached.assign(points, 0);
}

std::size_t OperatorResult::memory() const
{
    return internal_force.capacity() * sizeof(Vector3) +
           (volume_rate.capacity() + stress_work.capacity()) * sizeof(double) +
           inactive_bonds.capacity() * sizeof(std::uint32_t) + detached.capacity() + active.capacity();
}

} // namespace periporo
