// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/point_correspondence.hpp"

#include "operator/bond_forces.hpp"
#include "operator/bond_update.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace periporo {
namespace {

struct PointKinematics {
    Eigen::Matrix3d inverse_shape = Eigen::Matrix3d::Zero(); ///< K_i^-1, zero where it does not exist
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();      ///< L_i
    bool sound = false;
};

PointKinematics point_kinematics(const Model& model, std::size_t point, const FamilyView& family,
                                 const Influence& influence)
{
    const NeighbourRecord& self = model.records[point];
    Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    double weights = 0.0;
    for (std::size_t b = 0; b < family.count; ++b) {
        const NeighbourRecord& other = model.records[family.neighbours[b]];
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

/// Gives every bond the gradient of its point; all bonds of a sound point are active.
void spread(const PointKinematics& point, const FamilyView& family, StressWorkspace& stress)
{
    for (std::size_t p = 0; p < family.packs; ++p) {
        const std::size_t bonds = std::min(pack_width, family.count - p * pack_width);
        const auto lanes = static_cast<std::uint8_t>((1u << bonds) - 1u);
        stress.lanes[p] = point.sound ? lanes : std::uint8_t{0};
        for (Eigen::Index c = 0; c < 9; ++c)
            store_pack(select(lane_mask(stress.lanes[p]), Pack(point.gradient(c / 3, c % 3)), Pack(0.0)),
                       stress.gradient.data() + (9 * p + static_cast<std::size_t>(c)) * pack_width);
    }
}

Eigen::Matrix3d mean_stress(const FamilyView& family, const StressWorkspace& stress)
{
    SymmetricTensor<Pack> sum;
    for (std::size_t p = 0; p < family.packs; ++p)
        sum += total_stress(stress, p);
    Eigen::Matrix3d mean;
    mean << reduce(sum.xx), reduce(sum.xy), reduce(sum.xz), reduce(sum.xy), reduce(sum.yy), reduce(sum.yz),
        reduce(sum.xz), reduce(sum.yz), reduce(sum.zz);
    return mean / static_cast<double>(std::max<std::size_t>(family.count, 1));
}

} // namespace

void PointCorrespondenceForceState::evaluate(Model& model, const Evaluation& evaluation) const
{
    FirstFailure failure;
#pragma omp parallel
    {
        StressWorkspace stress;
#pragma omp for schedule(dynamic, 32)
        for (std::size_t i = 0; i < model.size(); ++i) {
            const FamilyView family = model.families[i];
            stress.reserve(family.packs);
            const PointKinematics point = point_kinematics(model, i, family, influence());
            spread(point, family, stress);
            if (const MaterialStatus status = update_bond_stress(model, i, evaluation, stress); !status.converged)
                failure.report(i, status);

            const double share = point.sound ? 1.0 / static_cast<double>(family.count) : 0.0;
            const StepSums step =
                step_sums(stress, family.packs, evaluation.stress, [&](std::size_t) { return Pack(share); });
            model.stress_work[i] = model.points.volume[i] * step.work;
            model.volume_rate[i] = step.dilation;
            for (std::size_t p = 0; p < family.packs; ++p)
                model.bonds.active[family.first_pack + p] = stress.lanes[p];
            model.inactive_bonds[i] = point.sound ? 0 : static_cast<std::uint32_t>(family.count);
            model.free_grain[i] = point.sound ? 0 : 1;

            const Eigen::Matrix3d moment = mean_stress(family, stress) * point.inverse_shape;
            double* force_state = model.bonds.force_state.data() + family.first_pack * 3 * pack_width;
            for (std::size_t b = 0; b < family.count; ++b) {
                const Vector3 zeta = model.records[family.neighbours[b]].x() - model.records[i].x();
                const Vector3 t = influence()(zeta.squaredNorm()) * (moment * zeta);
                for (std::size_t c = 0; c < 3; ++c)
                    force_state[(b / pack_width * 3 + c) * pack_width + b % pack_width] =
                        t[static_cast<Eigen::Index>(c)];
            }
        }
    }
    failure.raise(model);
    sum_bond_forces(model);
}

void PointCorrespondenceForceState::shares(const Model& model, std::size_t point, std::span<double> shares) const
{
    const FamilyView family = model.families[point];
    const double share =
        model.free_grain[point] != 0 || family.count == 0 ? 0.0 : 1.0 / static_cast<double>(family.count);
    for (std::size_t b = 0; b < shares.size(); ++b)
        shares[b] = b < family.count ? share : 0.0;
}

} // namespace periporo
