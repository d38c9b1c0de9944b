// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/bond_update.hpp"

#include <algorithm>

namespace periporo {
namespace {

Tensor<Pack> load_gradient(const double* rows)
{
    const auto row = [rows](std::size_t c) { return load_pack(rows + c * pack_width); };
    return {row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7), row(8)};
}

/// Zero where the mask does not hold; whatever stood there, not-finite numbers included, is gone.
SymmetricTensor<Pack> where_active(const PackMask& mask, const SymmetricTensor<Pack>& t)
{
    const Pack zero = 0.0;
    return {select(mask, t.xx, zero), select(mask, t.yy, zero), select(mask, t.zz, zero),
            select(mask, t.xy, zero), select(mask, t.yz, zero), select(mask, t.xz, zero)};
}

} // namespace

void StressWorkspace::reserve(std::size_t packs)
{
    if (lanes.size() >= packs)
        return;
    const std::size_t row = packs * pack_width;
    for (AlignedVector<double>* six : {&strain_increment, &rotated_stress, &total_stress})
        six->resize(6 * row);
    gradient.resize(9 * row);
    for (AlignedVector<double>* one : {&suction, &saturation, &work})
        one->resize(row);
    lanes.resize(packs);
}

void gather_water(const Model& model, std::size_t point, StressWorkspace& workspace)
{
    const Points& points = model.points;
    const FamilyView family = model.families[point];
    for (std::size_t b = 0; b < family.packs * pack_width; ++b) {
        const std::uint32_t other = model.families.parent(family.neighbours[b]);
        workspace.suction[b] = 0.5 * (points.suction[point] + points.suction[other]);
        workspace.saturation[b] = 0.5 * (points.saturation[point] + points.saturation[other]);
    }
}

SymmetricTensor<Pack> total_stress(const StressWorkspace& workspace, std::size_t pack)
{
    return load_symmetric(workspace.total_stress.data() + pack * 6 * pack_width);
}

MaterialStatus update_bond_stress(Model& model, std::size_t point, const Evaluation& evaluation,
                                  StressWorkspace& workspace)
{
    const FamilyView family = model.families[point];
    const Material& material = *model.body_of(point).material;
    const std::size_t rows = model.rows(point);
    double* state = model.bonds.state.data() + model.bonds.first[point];
    const double dt = evaluation.time_step;
    const bool advance = evaluation.stress == StressUpdate::advance;

    gather_water(model, point, workspace);
    MaterialStatus status;
    if (advance) {
        for (std::size_t p = 0; p < family.packs; ++p) {
            const Tensor<Pack> gradient =
                at_mid_step(load_gradient(workspace.gradient.data() + p * 9 * pack_width), dt);
            double* bond = state + p * rows * pack_width;
            const SymmetricTensor<Pack> stress =
                where_active(lane_mask(workspace.lanes[p]), rotated(load_symmetric(bond), step_rotation(gradient, dt)));
            store_symmetric(stress, bond);
            store_symmetric(stress, workspace.rotated_stress.data() + p * 6 * pack_width);
            store_symmetric(symmetric_part(gradient) * Pack(dt),
                            workspace.strain_increment.data() + p * 6 * pack_width);
        }
        status = material.update({family.packs, state, workspace.strain_increment.data(), workspace.suction.data(),
                                  workspace.saturation.data(), workspace.lanes.data(), dt, evaluation.response});
    }
    for (std::size_t p = 0; p < family.packs; ++p) {
        const PackMask active = lane_mask(workspace.lanes[p]);
        const Pack pore = load_pack(workspace.suction.data() + p * pack_width) *
                          load_pack(workspace.saturation.data() + p * pack_width);
        const SymmetricTensor<Pack> water = SymmetricTensor<Pack>::isotropic(pore);
        SymmetricTensor<Pack> total, mean, strain;
        if (advance) {
            const SymmetricTensor<Pack> stress = load_symmetric(state + p * rows * pack_width);
            total = where_active(active, stress + water);
            mean = 0.5 * (stress + load_symmetric(workspace.rotated_stress.data() + p * 6 * pack_width)) + water;
            strain = load_symmetric(workspace.strain_increment.data() + p * 6 * pack_width);
        } else {
            strain = symmetric_part(load_gradient(workspace.gradient.data() + p * 9 * pack_width));
            if (evaluation.stress == StressUpdate::keep) {
                total = load_symmetric(state + p * rows * pack_width) + water;
            } else {
                const double bulk = material.bulk_modulus();
                const double shear = material.shear_modulus();
                total = strain * Pack(2.0 * shear) +
                        SymmetricTensor<Pack>::isotropic(trace(strain) * (bulk - 2.0 / 3.0 * shear));
            }
            total = where_active(active, total);
            mean = total;
        }
        store_symmetric(total, workspace.total_stress.data() + p * 6 * pack_width);
        store_pack(select(active, double_contraction(mean, strain), Pack(0.0)), workspace.work.data() + p * pack_width);
    }
    return status;
}

} // namespace periporo
