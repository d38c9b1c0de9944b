// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/bond_forces.hpp"

#include "operator/force_state.hpp"

#include <fmt/format.h>

namespace periporo {

void sum_bond_forces(Model& model)
{
    const std::size_t n = model.size();
    const double* force_state = model.bonds.force_state.data();
    const auto bond = [force_state](std::size_t slot) {
        const double* t = force_state + slot / pack_width * 3 * pack_width + slot % pack_width;
        return Vector3(t[0], t[pack_width], t[2 * pack_width]);
    };
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t i = 0; i < n; ++i) {
        const FamilyView family = model.families[i];
        const std::size_t first = family.first_pack * pack_width;
        Vector3 sum = Vector3::Zero();
        for (std::size_t b = 0; b < family.count; ++b) {
            const std::uint32_t j = family.neighbours[b];
            Vector3 opposite = bond(family.reverse[b]);
            if (j >= n)
                opposite = model.isometries[model.families.isometry(j)].direction(opposite);
            sum += model.records[j].volume * (bond(first + b) - opposite);
        }
        model.internal_force[i] = model.points.volume[i] * sum;
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
