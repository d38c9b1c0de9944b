// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the accumulators of blocks to the forces of points, and the message of a material that failed.
#include "operator/bond_forces.hpp"

#include <fmt/format.h>

namespace periporo {

void BondForces::distribute(const Neighbourhood& neighbourhood, const OperatorWorkspace& workspace,
                            OperatorResult& result)
{
    const double* sums = workspace.accumulators.data();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < result.internal_force.size(); ++i) {
        Vector3 sum = Vector3::Zero();
        for (const BlockAccumulators::Contribution part : neighbourhood.blocks.contributions(i)) {
            const double* at = sums + part.accumulator * stride;
            Vector3 force(at[0], at[1], at[2]);
            if (part.isometry != 0)
                force = neighbourhood.isometries[neighbourhood.isometries.inverse(part.isometry)].direction(force);
            sum += force;
        }
        result.internal_force[i] += sum;
    }
}

void FirstFailure::raise(const State& state, const Families& families) const
{
    if (status_.converged)
        return;
    const std::uint32_t neighbour = families[point_].neighbours[status_.bond];
    throw MaterialFailure(point_, fmt::format("the material of body '{}' failed at point {}, bond to point {}: {}",
                                              state.body_of(point_).name, state.points.id[point_],
                                              state.points.id[families.parent(neighbour)],
                                              status_.reason != nullptr ? status_.reason : "no reason given"));
}

} // namespace periporo
