// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/bond_forces.hpp"

#include "operator/force_state.hpp"

#include <fmt/format.h>

namespace periporo {

void BondForces::hand_out(Model& model)
{
    const double* places = model.at_places.data();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model.size(); ++i) {
        Vector3 sum = Vector3::Zero();
        for (const Halos::Arrival arrival : model.halos.arrivals(i)) {
            const double* at = places + arrival.place * place_stride;
            Vector3 force(at[0], at[1], at[2]);
            if (arrival.isometry != 0)
                force = model.isometries[model.isometries.inverse(arrival.isometry)].direction(force);
            sum += force;
        }
        model.internal_force[i] += sum;
    }
}

void FirstFailure::raise(const Model& model) const
{
    if (status_.converged)
        return;
    const std::uint32_t neighbour = model.families[point_].neighbours[status_.bond];
    throw MaterialFailure(point_, fmt::format("the material of body '{}' failed at point {}, bond to point {}: {}",
                                              model.body_of(point_).name, model.points.id[point_],
                                              model.points.id[model.families.parent(neighbour)],
                                              status_.reason != nullptr ? status_.reason : "no reason given"));
}

} // namespace periporo
