// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One velocity gradient for all bonds of a point.
#include "operator/point_correspondence.hpp"

#include "operator/block_loop.hpp"
#include "operator/bond_forces.hpp"
#include "operator/bond_update.hpp"
#include "operator/thread_buffers.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace periporo {
namespace {

struct PointKinematics {
    Eigen::Matrix3d inverse_shape = Eigen::Matrix3d::Zero(); ///< K_i^-1, zero where it does not exist
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();      ///< L_i
    bool sound = false;
};

PointKinematics point_kinematics(const BondEnds& ends, std::size_t point, const FamilyView& family,
                                 const Influence& influence)
{
    const BondEnd& self = ends[point];
    Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    double weights = 0.0;
    for (std::size_t b = 0; b < family.count; ++b) {
        const BondEnd& other = ends[family.neighbours[b]];
        const Vector3 zeta = other.x() - self.x();
        const double weight = influence(zeta.squaredNorm()) * other.volume;
        shape += weight * zeta * zeta.transpose();
        moment += weight * (other.v() - self.v()) * zeta.transpose();
        weights += weight;
    }
    PointKinematics result;
    const double mean = shape.trace() / 3.0;
    if (shape.determinant() > singular_shape_quality * mean * mean * mean) {
        const Eigen::Matrix3d inverse = shape.inverse();
        // as thick as the other force states ask of a sub-horizon
        result.sound = least_relative_thickness * influence.second_moment() * inverse.trace() * weights <= 1.0;
        if (result.sound) {
            result.inverse_shape = inverse;
            result.gradient = moment * inverse;
        }
    }
    return result;
}

Tensor<Pack> on_all_lanes(const Eigen::Matrix3d& m, const PackMask& active)
{
    const auto lanes = [&](Eigen::Index row, Eigen::Index column) {
        return select(active, Pack(m(row, column)), Pack(0.0));
    };
    return {lanes(0, 0), lanes(0, 1), lanes(0, 2), lanes(1, 0), lanes(1, 1),
            lanes(1, 2), lanes(2, 0), lanes(2, 1), lanes(2, 2)};
}

Eigen::Matrix3d matrix(const SymmetricTensor<Pack>& t)
{
    Eigen::Matrix3d m;
    m << reduce(t.xx), reduce(t.xy), reduce(t.xz), reduce(t.xy), reduce(t.yy), reduce(t.yz), reduce(t.xz), reduce(t.yz),
        reduce(t.zz);
    return m;
}

/// The forces of T_ij = omega M zeta.
void add_forces(const BondEnds& ends, std::size_t point, const FamilyView& family, const Influence& influence,
                const Eigen::Matrix3d& moment, BondForces& forces)
{
    const BondEnd& self = ends[point];
    std::array<Pack, 3> own{Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::size_t p = 0; p < family.packs; ++p) {
        std::array<Pack, 3> force{Pack(0.0), Pack(0.0), Pack(0.0)};
        for (std::size_t lane = 0; lane < family.bonds_in(p); ++lane) {
            const BondEnd& other = ends[family.neighbours[p * pack_width + lane]];
            const Vector3 zeta = other.x() - self.x();
            const Vector3 f = self.volume * other.volume * influence(zeta.squaredNorm()) * (moment * zeta);
            for (std::size_t c = 0; c < 3; ++c)
                force[c][lane] = f[static_cast<Eigen::Index>(c)];
        }
        for (std::size_t c = 0; c < 3; ++c)
            own[c] += force[c];
        forces.subtract_from_neighbours(family.first_pack + p, family.bonds_in(p), force);
    }
    forces.add_to(point, own);
}

} // namespace

void PointCorrespondenceForceState::evaluate(const OperatorInput& input, const Evaluation& evaluation,
                                             BondStates& bonds, OperatorWorkspace& workspace,
                                             OperatorResult& result) const
{
    const BlockAccumulators& blocks = input.neighbourhood.blocks;
    FirstFailure failure;
    BondForces::prepare(blocks, workspace, result);
    for_every_block(blocks, result.times, [&](std::size_t block, OperatorTimes& samples) {
        auto& buffers = thread_buffers<StressWorkspace>();
        BondForces forces(blocks, block, workspace);
        for (std::size_t i = blocks.first_point(block); i < blocks.end_point(block); ++i) {
            SampledTimes times(samples, i);
            const FamilyView family = input.family(i);
            const PointKinematics point = point_kinematics(input.ends, i, family, influence());
            BondStress stress(input, i, family.neighbours, family.packs, bonds.state(i), evaluation, buffers);
            for (std::size_t p = 0; p < family.packs; ++p) {
                // all bonds of a sound point are active
                const std::uint8_t lanes = point.sound ? family.lanes(p) : std::uint8_t{0};
                const Tensor<Pack> gradient = on_all_lanes(point.gradient, lane_mask(lanes));
                stress.begin(p, at_mid_step(gradient, 2.0 * evaluation.gradient_lag()), lanes);
                result.active[family.first_pack + p] = lanes;
            }
            times.end_of(&OperatorTimes::kinematics);
            if (const MaterialStatus status = stress.update(); !status.converged)
                failure.report(i, status);
            times.end_of(&OperatorTimes::material);

            SymmetricTensor<Pack> sum;
            Pack work = 0.0;
            Pack dilation = 0.0;
            for (std::size_t p = 0; p < family.packs; ++p) {
                const BondStress::Outcome bond = stress.end(p);
                sum += bond.stress;
                work += bond.work;
                dilation += bond.dilation;
            }
            const double share = point.sound ? 1.0 / static_cast<double>(family.count) : 0.0;
            result.stress_work[i] = input.state.points.volume[i] * share * reduce(work);
            result.volume_rate[i] = share * reduce(dilation);
            result.inactive_bonds[i] = point.sound ? 0 : static_cast<std::uint32_t>(family.count);
            result.detached[i] = point.sound ? 0 : 1;
            add_forces(input.ends, i, family, influence(), share * matrix(sum) * point.inverse_shape, forces);
            times.end_of(&OperatorTimes::force);
        }
    });
    failure.raise(input.state, input.neighbourhood.families);
    BondForces::distribute(input.neighbourhood, workspace, result);
}

void PointCorrespondenceForceState::bond_weights(const Model& model, std::size_t point, std::span<double> weights) const
{
    const FamilyView family = model.neighbourhood.families[point];
    const double weight =
        model.result.detached[point] != 0 || family.count == 0 ? 0.0 : 1.0 / static_cast<double>(family.count);
    for (std::size_t b = 0; b < weights.size(); ++b)
        weights[b] = b < family.count ? weight : 0.0;
}

} // namespace periporo
