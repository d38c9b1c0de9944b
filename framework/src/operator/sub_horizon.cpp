// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/sub_horizon.hpp"

#include "operator/bond_forces.hpp"
#include "operator/bond_update.hpp"
#include "operator/masked_sums.hpp"

#include <algorithm>

namespace periporo {
namespace {

constexpr std::size_t moment_features = 16; // omega V zeta zeta (6), omega V dv zeta (9), V

/// Buffers of one thread for one point. Rows lie row_stride(packs) apart.
struct Workspace {
    AlignedVector<double> zeta;          // 3 rows
    AlignedVector<double> omega;         // 1 row
    AlignedVector<double> features;      // moment_features rows
    AlignedVector<double> inverse_shape; // 6 per pack
    AlignedVector<double> volume;        // 1 row: V(H_b), zero where inactive
    AlignedVector<double> moments;       // 9 rows: w_b sigma_b K_b^-1
    StressWorkspace stress;

    void reserve(std::size_t packs)
    {
        const std::size_t row = row_stride(packs);
        if (omega.size() < row) {
            zeta.resize(3 * row);
            omega.resize(row);
            features.resize(moment_features * row);
            inverse_shape.resize(6 * row);
            volume.resize(row);
            moments.resize(9 * row);
        }
        stress.reserve(packs);
    }
};

struct FamilySums {
    double volume;         ///< V(H_i) [m3]
    double mean_influence; ///< volume-weighted, over the family [-]
};

/// Relative positions, influence and the features whose sums over sub-horizons are K_b, the velocity moment and V.
FamilySums gather(const Model& model, std::size_t point, const FamilyView& family, const Influence& influence,
                  Workspace& w)
{
    const std::size_t lanes = family.packs * pack_width;
    const std::size_t row = row_stride(family.packs);
    const NeighbourRecord& self = model.records[point];
    double* zeta = w.zeta.data();
    double* velocity = w.features.data() + 6 * row; // three rows lent to the velocity differences until they are used
    double* volume = w.features.data() + 15 * row;
    FamilySums sums{self.volume, 0.0};
    for (std::size_t b = 0; b < lanes; ++b) {
        const NeighbourRecord& other = model.records[family.neighbours[b]];
        for (std::size_t c = 0; c < 3; ++c) {
            zeta[c * row + b] = other.position[c] - self.position[c];
            velocity[c * row + b] = other.velocity[c] - self.velocity[c];
        }
        volume[b] = other.volume;
    }
    for (std::size_t b = 0; b < family.count; ++b)
        sums.volume += volume[b];
    for (std::size_t at = 0; at < lanes; at += pack_width) {
        const Pack x = load_pack(zeta + at);
        const Pack y = load_pack(zeta + row + at);
        const Pack z = load_pack(zeta + 2 * row + at);
        const Pack u = load_pack(velocity + at);
        const Pack v = load_pack(velocity + row + at);
        const Pack t = load_pack(velocity + 2 * row + at);
        const Pack omega = influence(x * x + y * y + z * z);
        store_pack(omega, w.omega.data() + at);
        const Pack weight = omega * load_pack(volume + at);
        const Pack wx = weight * x;
        const Pack wy = weight * y;
        const Pack wz = weight * z;
        std::size_t f = 0;
        for (const Pack& feature : {wx * x, wy * y, wz * z, wx * y, wy * z, wx * z, // xx yy zz xy yz xz
                                    wx * u, wy * u, wz * u, wx * v, wy * v, wz * v, wx * t, wy * t, wz * t})
            store_pack(feature, w.features.data() + row * f++ + at);
    }
    double weight = 0.0;
    for (std::size_t b = 0; b < family.count; ++b)
        weight += w.omega[b] * volume[b];
    sums.mean_influence = family.count > 0 ? weight / (sums.volume - self.volume) : 0.0;
    return sums;
}

/// K_b^-1, L_b, V(H_b) and activity of every bond. Returns the sum of V(H_b) over active bonds.
/// @param thickness least thickness squared [m2]
double kinematics(const Model& model, std::size_t point, const FamilyView& family, const FamilySums& family_sums,
                  double thickness, Workspace& w)
{
    const Pack self_volume = model.records[point].volume;
    const Pack zero = 0.0;
    const double least = thickness * family_sums.mean_influence;
    double total = 0.0;
    for (std::size_t p = 0; p < family.packs; ++p) {
        const auto s =
            masked_sums<moment_features>(family.membership, family.count, family.packs, p, w.features.data());
        const SymmetricTensor<Pack> shape{s[0], s[1], s[2], s[3], s[4], s[5]};
        const Pack det = determinant(shape);
        const Pack volume = s[15] + self_volume;
        SymmetricTensor<Pack> inverse_shape = adjugate(shape);
        const Pack mean = trace(shape) * (1.0 / 3.0);
        const PackMask active =
            det > singular_shape_quality * mean * mean * mean && det >= least * volume * trace(inverse_shape);
        const Pack scale = select(active, Pack(1.0) / det, zero);
        for (Pack* c : {&inverse_shape.xx, &inverse_shape.yy, &inverse_shape.zz, &inverse_shape.xy, &inverse_shape.yz,
                        &inverse_shape.xz})
            *c = select(active, *c * scale, zero);
        const Tensor<Pack> gradient =
            Tensor<Pack>{s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14]} * inverse_shape;

        store_symmetric(inverse_shape, w.inverse_shape.data() + p * 6 * pack_width);
        double* stored_gradient = w.stress.gradient.data() + p * 9 * pack_width;
        std::size_t c = 0;
        for (const Pack* component : {&gradient.xx, &gradient.xy, &gradient.xz, &gradient.yx, &gradient.yy,
                                      &gradient.yz, &gradient.zx, &gradient.zy, &gradient.zz})
            store_pack(*component, stored_gradient + pack_width * c++);
        w.stress.lanes[p] = lane_bits(active);
        store_pack(select(active, volume, zero), w.volume.data() + p * pack_width);
    }
    for (std::size_t b = 0; b < family.count; ++b)
        total += w.volume[b];
    return total;
}

SymmetricTensor<Pack> inverse_shape_of(const Workspace& w, std::size_t pack)
{
    return load_symmetric(w.inverse_shape.data() + pack * 6 * pack_width);
}

/// w_b sigma_b K_b^-1 of every bond, as nine rows.
void stress_moments(const FamilyView& family, double reciprocal_total, Workspace& w)
{
    const std::size_t row = row_stride(family.packs);
    for (std::size_t p = 0; p < family.packs; ++p) {
        const Pack share = load_pack(w.volume.data() + p * pack_width) * reciprocal_total;
        const Tensor<Pack> moment = full(total_stress(w.stress, p) * share) * inverse_shape_of(w, p);
        std::size_t f = 0;
        for (const Pack* c : {&moment.xx, &moment.xy, &moment.xz, &moment.yx, &moment.yy, &moment.yz, &moment.zx,
                              &moment.zy, &moment.zz})
            store_pack(*c, w.moments.data() + row * f++ + p * pack_width);
    }
}

void store_force_state(const std::array<Pack, 9>& moment, const Workspace& w, std::size_t row, std::size_t pack,
                       double* force_state)
{
    const std::size_t at = pack * pack_width;
    const Pack omega = load_pack(w.omega.data() + at);
    const Pack x = load_pack(w.zeta.data() + at);
    const Pack y = load_pack(w.zeta.data() + row + at);
    const Pack z = load_pack(w.zeta.data() + 2 * row + at);
    double* rows = force_state + pack * 3 * pack_width;
    for (std::size_t c = 0; c < 3; ++c)
        store_pack(omega * (moment[3 * c] * x + moment[3 * c + 1] * y + moment[3 * c + 2] * z), rows + c * pack_width);
}

} // namespace

void SubHorizonForceState::evaluate(Model& model, const Evaluation& evaluation) const
{
    FirstFailure failure;
    const std::size_t n = model.size();
    const double thickness = least_relative_thickness * influence().second_moment();
#pragma omp parallel
    {
        Workspace w;
#pragma omp for schedule(dynamic, 32)
        for (std::size_t i = 0; i < n; ++i) {
            const FamilyView family = model.families[i];
            const std::size_t row = row_stride(family.packs);
            w.reserve(family.packs);
            const FamilySums sums = gather(model, i, family, influence(), w);
            const double total = kinematics(model, i, family, sums, thickness, w);
            const double reciprocal_total = total > 0.0 ? 1.0 / total : 0.0;
            const MaterialStatus status = update_bond_stress(model, i, evaluation, w.stress);
            if (!status.converged)
                failure.report(i, status);

            const StepSums step = step_sums(w.stress, family.packs, evaluation.stress, [&](std::size_t p) {
                return load_pack(w.volume.data() + p * pack_width) * reciprocal_total;
            });
            model.stress_work[i] = model.points.volume[i] * step.work;
            model.volume_rate[i] = step.dilation;
            std::uint32_t active = 0;
            for (std::size_t p = 0; p < family.packs; ++p) {
                model.bonds.active[family.first_pack + p] = w.stress.lanes[p];
                active += static_cast<std::uint32_t>(std::popcount(w.stress.lanes[p]));
            }
            model.inactive_bonds[i] = static_cast<std::uint32_t>(family.count) - active;
            model.free_grain[i] = active == 0 ? 1 : 0;

            double* force_state = model.bonds.force_state.data() + family.first_pack * 3 * pack_width;
            if (weighting_ == Weighting::energy_conjugate) {
                stress_moments(family, reciprocal_total, w);
                for (std::size_t p = 0; p < family.packs; ++p)
                    store_force_state(
                        masked_sums<9>(family.membership, family.count, family.packs, p, w.moments.data()), w, row, p,
                        force_state);
            } else {
                for (std::size_t p = 0; p < family.packs; ++p) {
                    const Pack phi = load_pack(w.volume.data() + p * pack_width) * (1.0 / sums.volume);
                    const Tensor<Pack> m = full(total_stress(w.stress, p) * phi) * inverse_shape_of(w, p);
                    store_force_state({m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz}, w, row, p, force_state);
                }
            }
        }
    }
    failure.raise(model);
    sum_bond_forces(model);
}

void SubHorizonForceState::shares(const Model& model, std::size_t point, std::span<double> shares) const
{
    const FamilyView family = model.families[point];
    thread_local AlignedVector<double> volume;
    volume.resize(row_stride(family.packs));
    for (std::size_t b = 0; b < family.packs * pack_width; ++b)
        volume[b] = model.records[family.neighbours[b]].volume;
    double total = 0.0;
    for (std::size_t p = 0; p < family.packs; ++p) {
        const auto sum = masked_sums<1>(family.membership, family.count, family.packs, p, volume.data());
        const Pack share = select(lane_mask(model.bonds.active[family.first_pack + p]),
                                  sum[0] + model.records[point].volume, Pack(0.0));
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            total += shares[p * pack_width + lane] = share[lane];
    }
    if (total > 0.0)
        for (double& share : shares)
            share /= total;
}

} // namespace periporo
