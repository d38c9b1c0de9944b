// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums over sub-horizons, gradients, moments of stress and forces of one point after the other.
#include "operator/sub_horizon.hpp"

#include "operator/block_loop.hpp"
#include "operator/bond_forces.hpp"
#include "operator/bond_update.hpp"
#include "operator/bond_vector.hpp"
#include "operator/sub_horizon_sums.hpp"
#include "operator/thread_buffers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace periporo {
namespace {

/// A row of a member: omega V zeta (x) zeta as xx yy zz xy yz xz, then omega V (v_k - v_i) (x) zeta row by row, then V.
constexpr std::size_t kinematic_values = 16;
/// A row of a member: w_b sigma_b K_b^-1 row by row, its last component in the column.
constexpr std::size_t moment_values = 8;

/// Buffers of one thread for one point.
struct Workspace {
    AlignedVector<double> zeta;          // 3 packs a pack of bonds
    AlignedVector<double> motion;        // 3: v_j - v_i
    AlignedVector<double> omega;         // 1
    AlignedVector<double> volume;        // 1: V of the neighbour, zero in lanes without a bond
    AlignedVector<double> inverse_shape; // 6
    AlignedVector<double> weight;        // 1: what the share is in proportion to, zero where inactive
    AlignedVector<double> along;         // 3: f sigma_b zeta/max(|zeta|^2, l^2), f as in stress_moments()
    BondRows<kinematic_values, false> features, sums;
    BondRows<moment_values, true> moments, moment_sums;
    StressWorkspace stress;

    void reserve(std::size_t packs)
    {
        const std::size_t lanes = packs * pack_width;
        if (!omega.empty() && omega.size() >= lanes)
            return;
        zeta.resize(3 * lanes);
        motion.resize(3 * lanes);
        along.resize(3 * lanes);
        omega.resize(lanes);
        volume.resize(lanes);
        inverse_shape.resize(6 * lanes);
        weight.resize(lanes);
        features.reserve(packs);
        sums.reserve(packs);
        moments.reserve(packs);
        moment_sums.reserve(packs);
        stress.reserve(packs);
    }
};

struct WeightBuffers {
    AlignedVector<double> volume, sums;
};

/// zeta/max(|zeta|^2, l^2): turns a motion between the ends of a bond into a gradient along it.
BondVector along_bond(const BondVector& zeta, double least_squared)
{
    return times(Pack(1.0) / maximum(dot(zeta, zeta), Pack(least_squared)), zeta);
}

struct FamilySums {
    double volume;         ///< V(H_i) [m3]
    double mean_influence; ///< volume-weighted, over the family [-]
};

/// Relative positions, influence and the features whose sums over sub-horizons are K_b, the velocity moment and V.
FamilySums gather(const BondEnds& ends, std::size_t point, const FamilyView& family, const Influence& influence,
                  Workspace& w)
{
    const BondEnd& self = ends[point];
    Pack volumes = 0.0;
    Pack weights = 0.0;
    for (std::size_t p = 0; p < family.packs; ++p) {
        const std::size_t at = p * pack_width;
        const std::uint32_t* neighbours = family.neighbours + at;
        const std::array<Pack, 8> other =
            load_transposed<8>([&](std::size_t lane) { return ends[neighbours[lane]].position; });
        const Pack x = other[0] - self.position[0];
        const Pack y = other[1] - self.position[1];
        const Pack z = other[2] - self.position[2];
        const Pack u = other[4] - self.velocity[0];
        const Pack v = other[5] - self.velocity[1];
        const Pack t = other[6] - self.velocity[2];
        const Pack volume = select(lane_mask(family.lanes(p)), other[3], Pack(0.0));
        const Pack omega = influence(x * x + y * y + z * z);
        const Pack weight = omega * volume;
        volumes += volume;
        weights += weight;
        store_vector({x, y, z}, &w.zeta[3 * at]);
        store_vector({u, v, t}, &w.motion[3 * at]);
        store_pack(omega, &w.omega[at]);
        store_pack(volume, &w.volume[at]);
        const Pack wx = weight * x;
        const Pack wy = weight * y;
        const Pack wz = weight * z;
        store_transposed<kinematic_values>({wx * x, wy * y, wz * z, wx * y, wy * z, wx * z, // xx yy zz xy yz xz
                                            wx * u, wy * u, wz * u, wx * v, wy * v, wz * v, wx * t, wy * t, wz * t,
                                            volume},
                                           w.features.row(at));
    }
    const double volume = reduce(volumes);
    return {self.volume + volume, volume > 0.0 ? reduce(weights) / volume : 0.0};
}

/// K_b^-1, weight, activity and gradient of every bond; the gradient goes on to `stress`. Returns the sum of the
/// weights over all bonds, inactive ones too.
/// @param weighed whether a bond weighs omega V(H_b), and V(H_b) otherwise
/// @param thickness least thickness squared [m2]
/// @param lag see Evaluation::gradient_lag [s]
/// @param least_squared l^2 [m2], none for gradients that are means over the sub-horizon
double kinematics(const BondEnds& ends, std::size_t point, const FamilyView& family, const FamilySums& family_sums,
                  bool weighed, double thickness, double lag, std::optional<double> least_squared, Workspace& w,
                  BondStress& stress)
{
    const double self_volume = ends[point].volume;
    const Pack zero = 0.0;
    const double least = thickness * family_sums.mean_influence;
    Pack total = 0.0;
    for (std::size_t p = 0; p < family.packs; ++p) {
        const auto s =
            load_transposed<kinematic_values>([&](std::size_t lane) { return w.sums.row(p * pack_width + lane); });
        const SymmetricTensor<Pack> shape{s[0], s[1], s[2], s[3], s[4], s[5]};
        const Pack det = determinant(shape);
        const Pack volume = s[15] + self_volume;
        SymmetricTensor<Pack> inverse_shape = adjugate(shape);
        const Pack mean = trace(shape) * (1.0 / 3.0);
        // A bond that has grown longer than the horizon since families were found has no weight.
        const Pack whole = weighed ? volume * load_pack(&w.omega[p * pack_width]) : volume;
        const PackMask active = det > singular_shape_quality * mean * mean * mean &&
                                det >= least * volume * trace(inverse_shape) && whole > zero;
        const Pack scale = select(active, Pack(1.0) / det, zero);
        for (Pack* c : {&inverse_shape.xx, &inverse_shape.yy, &inverse_shape.zz, &inverse_shape.xy, &inverse_shape.yz,
                        &inverse_shape.xz})
            *c = select(active, *c * scale, zero);
        store_symmetric(inverse_shape, w.inverse_shape.data() + p * 6 * pack_width);
        store_pack(select(active, whole, zero), w.weight.data() + p * pack_width);
        total += select(lane_mask(family.lanes(p)), whole, zero);
        // L (1 - lag L)^-1 with L = M K^-1 is M (K - lag M)^-1
        const Tensor<Pack> moment{s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14]};
        const Adjugate<Pack> behind = adjugate(full(shape) + moment * Pack(-lag));
        const Pack reciprocal = select(active, Pack(1.0) / behind.determinant, zero);
        Tensor<Pack> gradient = moment * behind.tensor * reciprocal;
        if (least_squared) {
            const BondVector motion = load_vector(&w.motion[p * 3 * pack_width]);
            const BondVector zeta = minus(load_vector(&w.zeta[p * 3 * pack_width]), times(Pack(lag), motion));
            const BondVector unseen = minus(motion, times(gradient, zeta));
            gradient += dyad(unseen, times(select(active, Pack(1.0), zero), along_bond(zeta, *least_squared)));
        }
        stress.begin(p, gradient, lane_bits(active));
    }
    return reduce(total);
}

/// f sigma_b K_b^-1 of every bond, as the moments of the workspace, where f is `moment_factor` times the weight; and
/// the result of the point. The part along the bond itself is not in the moments.
/// @param share_factor the shares over the weights
/// @param least_squared as in kinematics()
void stress_moments(const State& state, std::size_t point, const FamilyView& family, const BondStress& stress,
                    double share_factor, double moment_factor, std::optional<double> least_squared, Workspace& w,
                    OperatorResult& result)
{
    Pack work = 0.0;
    Pack dilation = 0.0;
    Pack carrying = 0.0;
    std::uint32_t active = 0;
    for (std::size_t p = 0; p < family.packs; ++p) {
        const BondStress::Outcome bond = stress.end(p);
        const Pack weight = load_pack(w.weight.data() + p * pack_width);
        work += weight * share_factor * bond.work;
        dilation += weight * bond.dilation;
        carrying += weight;
        active += static_cast<std::uint32_t>(std::popcount(stress.active(p)));
        result.active[family.first_pack + p] = stress.active(p);
        Tensor<Pack> share = full(bond.stress * (weight * moment_factor));
        if (least_squared) {
            const BondVector zeta = load_vector(&w.zeta[p * 3 * pack_width]);
            const BondVector along = times(share, along_bond(zeta, *least_squared));
            store_vector(along, &w.along[p * 3 * pack_width]);
            share -= dyad(along, zeta);
        }
        const Tensor<Pack> m = share * load_symmetric(w.inverse_shape.data() + p * 6 * pack_width);
        store_transposed<moment_values>({m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy},
                                        w.moments.row(p * pack_width));
        store_pack(m.zz, w.moments.column.data() + p * pack_width);
    }
    result.stress_work[point] = state.points.volume[point] * reduce(work);
    result.volume_rate[point] = active == 0 ? 0.0 : reduce(dilation) / reduce(carrying);
    result.inactive_bonds[point] = static_cast<std::uint32_t>(family.count) - active;
    result.detached[point] = active == 0 ? 1 : 0;
}

/// Forces of the force states V_j T = omega V_j M zeta + what goes along the bond itself.
void add_forces(const BondEnds& ends, std::size_t point, const FamilyView& family, bool along_bonds,
                const BondRows<moment_values, true>& moments, const Workspace& w, BondForces& forces)
{
    const double self_volume = ends[point].volume;
    BondVector sum{Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::size_t p = 0; p < family.packs; ++p) {
        const std::size_t at = p * pack_width;
        const auto m = load_transposed<moment_values>([&](std::size_t lane) { return moments.row(at + lane); });
        const Tensor<Pack> moment{m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], load_pack(&moments.column[at])};
        const Pack omega = load_pack(&w.omega[at]);
        const Pack weight = omega * load_pack(&w.volume[at]) * self_volume;
        BondVector force = times(weight, times(moment, load_vector(&w.zeta[3 * at])));
        if (along_bonds) {
            const BondVector along = load_vector(&w.along[3 * at]);
            for (std::size_t c = 0; c < 3; ++c)
                force[c] += self_volume * along[c];
        }
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += force[c];
        forces.subtract_from_neighbours(family.first_pack + p, family.bonds_in(p), force);
    }
    forces.add_to(point, sum);
}

} // namespace

void SubHorizonForceState::evaluate(const OperatorInput& input, const Evaluation& evaluation, BondStates& bonds,
                                    OperatorWorkspace& workspace, OperatorResult& result) const
{
    const bool conjugate = kind_ != Kind::volume_weighted;
    std::optional<double> least_squared;
    if (kind_ == Kind::energy_conjugate)
        least_squared = std::pow(shortest_bond * input.state.spacing, 2);
    const double thickness = least_relative_thickness * influence().second_moment();
    const BlockAccumulators& blocks = input.neighbourhood.blocks;
    FirstFailure failure;
    BondForces::prepare(blocks, workspace, result);
    for_every_block(blocks, result.times, [&](std::size_t block, OperatorTimes& samples) {
        auto& w = thread_buffers<Workspace>();
        BondForces forces(blocks, block, workspace);
        for (std::size_t i = blocks.first_point(block); i < blocks.end_point(block); ++i) {
            SampledTimes times(samples, i);
            const FamilyView family = input.family(i);
            w.reserve(family.packs);
            const FamilySums family_sums = gather(input.ends, i, family, influence(), w);
            sum_sub_horizons(input.neighbourhood.sub_horizons[i], w.features, w.sums);
            BondStress stress(input, i, family.neighbours, family.packs, bonds.state(i), evaluation, w.stress);
            const double total = kinematics(input.ends, i, family, family_sums, conjugate, thickness,
                                            evaluation.gradient_lag(), least_squared, w, stress);
            const double reciprocal_total = total > 0.0 ? 1.0 / total : 0.0;
            times.end_of(&OperatorTimes::kinematics);
            if (const MaterialStatus status = stress.update(); !status.converged)
                failure.report(i, status);
            times.end_of(&OperatorTimes::material);

            const double moment_factor = conjugate ? reciprocal_total : 1.0 / family_sums.volume;
            stress_moments(input.state, i, family, stress, reciprocal_total, moment_factor, least_squared, w, result);
            if (conjugate)
                sum_sub_horizons(input.neighbourhood.sub_horizons[i], w.moments, w.moment_sums);
            add_forces(input.ends, i, family, least_squared.has_value(), conjugate ? w.moment_sums : w.moments, w,
                       forces);
            times.end_of(&OperatorTimes::force);
        }
    });
    failure.raise(input.state, input.neighbourhood.families);
    BondForces::distribute(input.neighbourhood, workspace, result);
}

void SubHorizonForceState::bond_weights(const Model& model, std::size_t point, std::span<double> weights) const
{
    const FamilyView family = model.neighbourhood.families[point];
    const BondEnd& self = model.ends[point];
    const bool weighed = kind_ != Kind::volume_weighted;
    auto& [volume, sums] = thread_buffers<WeightBuffers>();
    volume.resize(family.packs * pack_width);
    for (std::size_t p = 0; p < family.packs; ++p) {
        const std::uint32_t* neighbours = family.neighbours + p * pack_width;
        const std::array<Pack, 8> other =
            load_transposed<8>([&](std::size_t lane) { return model.ends[neighbours[lane]].position; });
        store_pack(other[3], &volume[p * pack_width]);
        BondVector zeta;
        for (std::size_t c = 0; c < 3; ++c)
            zeta[c] = other[c] - self.position[c];
        const Pack omega = weighed ? influence()(dot(zeta, zeta)) : Pack(1.0);
        const Pack active = select(lane_mask(model.result.active[family.first_pack + p]), omega, Pack(0.0));
        active.copy_to(&weights[p * pack_width], std::experimental::element_aligned);
    }
    sum_sub_horizons(model.neighbourhood.sub_horizons[point], volume, sums);
    double total = 0.0;
    for (std::size_t b = 0; b < family.count; ++b)
        total += weights[b] *= sums[b] + self.volume;
    if (total > 0.0)
        for (double& weight : weights)
            weight /= total;
}

} // namespace periporo
