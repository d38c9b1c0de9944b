// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Gradients, soundness and activity, point by point.
#include "operator/point_gradients.hpp"

#include "operator/block_loop.hpp"
#include "operator/bond_geometry.hpp"
#include "operator/bond_update.hpp"
#include "operator/force_state.hpp"

#include <algorithm>
#include <atomic>

namespace periporo {

void EndField::fill_images()
{
    using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const std::vector<Image>& images = neighbourhood_.families.images();
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < images.size(); ++m) {
        const double* parent = (*this)[images[m].parent];
        double* image = (*this)[neighbourhood_.families.points() + m];
        std::copy_n(parent, values, image);
        const Eigen::Matrix3d& rotation = neighbourhood_.isometries[images[m].isometry].rotation;
        Eigen::Map<Rows>{image} = rotation * Eigen::Map<const Rows>(parent) * rotation.transpose();
    }
}

PointGradients::PointGradients(const OperatorInput& input, const Influence& influence, double* rows,
                               OperatorResult& result)
    : input_(input), result_(result), influence_(influence),
      least_squared_(shortest_bond * shortest_bond * input.state.spacing * input.state.spacing),
      rows_(input.neighbourhood, rows)
{
}

/// L_i, K_i^-1 and 1/w0_i as if all bonds were active. Returns whether they can be: the point is sound and none of its
/// bonds too short.
bool PointGradients::find_gradient(std::size_t point)
{
    const FamilyView family = input_.family(point);
    SymmetricTensor<Pack> shape;
    Tensor<Pack> moment;
    Pack weights = 0.0;
    PackMask too_short(false);
    for (std::size_t p = 0; p < family.packs; ++p) {
        const PackMask bonds = lane_mask(family.lanes(p));
        const BondGeometry g(input_.ends, point, family.neighbours + p * pack_width, bonds, influence_);
        const Pack weight = g.omega * g.volume;
        const BondVector weighted = times(weight, g.along);
        shape += {g.zeta[0] * weighted[0], g.zeta[1] * weighted[1], g.zeta[2] * weighted[2],
                  g.zeta[0] * weighted[1], g.zeta[1] * weighted[2], g.zeta[0] * weighted[2]};
        moment += dyad(g.motion, weighted);
        weights += weight;
        too_short = too_short || (bonds && g.squared < least_squared_);
    }
    const SymmetricTensor<double> k{reduce(shape.xx), reduce(shape.yy), reduce(shape.zz),
                                    reduce(shape.xy), reduce(shape.yz), reduce(shape.xz)};
    const double mean = trace(k) / 3.0;
    const double det = determinant(k);
    double* row = rows_[point];
    std::fill_n(row, EndField::values, 0.0);
    if (!(mean > 0.0 && det >= least_shape_quality * mean * mean * mean))
        return false;
    const SymmetricTensor<double> inverse = adjugate(k) * (1.0 / det);
    store_tensor(Tensor<double>{reduce(moment.xx), reduce(moment.xy), reduce(moment.xz), reduce(moment.yx),
                                reduce(moment.yy), reduce(moment.yz), reduce(moment.zx), reduce(moment.zy),
                                reduce(moment.zz)} *
                     inverse,
                 row + gradient_at);
    double* at = row + inverse_shape_at;
    for (const double c : components(inverse))
        *at++ = c;
    row[reciprocal_weight_at] = 1.0 / reduce(weights);
    return !any(too_short);
}

/// Finds the active bonds of a point and returns 1/w0, once the soundness of all points is known.
double PointGradients::find_activity(std::size_t point)
{
    const FamilyView family = input_.family(point);
    double weight = 0.0;
    std::uint32_t active = 0;
    const BondEnd& self = input_.ends[point];
    for (std::size_t p = 0; p < family.packs; ++p) {
        std::uint8_t bits = 0;
        for (std::size_t lane = 0; lane < family.bonds_in(p); ++lane) {
            const std::uint32_t j = family.neighbours[p * pack_width + lane];
            if (!sound(point) || !sound(j))
                continue;
            const double squared = (input_.ends[j].x() - self.x()).squaredNorm();
            if (squared < least_squared_)
                continue;
            bits = static_cast<std::uint8_t>(bits | 1u << lane);
            weight += influence_(squared) * input_.ends[j].volume;
            ++active;
        }
        result_.active[family.first_pack + p] = bits;
    }
    result_.inactive_bonds[point] = static_cast<std::uint32_t>(family.count) - active;
    result_.detached[point] = active == 0 ? 1 : 0;
    return weight > 0.0 ? 1.0 / weight : 0.0;
}

void PointGradients::find()
{
    const BlockAccumulators& blocks = input_.neighbourhood.blocks;
    std::atomic<bool> all_active = true;
    for_every_block(blocks, result_.times, [&](std::size_t block, OperatorTimes& samples) {
        for (std::size_t i = blocks.first_point(block); i < blocks.end_point(block); ++i) {
            SampledTimes times(samples, i);
            if (!find_gradient(i))
                all_active.store(false, std::memory_order_relaxed);
            times.end_of(&OperatorTimes::kinematics);
        }
    });
    rows_.fill_images();
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t i = 0; i < input_.size(); ++i) {
        if (!all_active) {
            rows_[i][reciprocal_weight_at] = find_activity(i);
            continue;
        }
        const FamilyView family = input_.family(i);
        for (std::size_t p = 0; p < family.packs; ++p)
            result_.active[family.first_pack + p] = family.lanes(p);
        result_.inactive_bonds[i] = 0;
        result_.detached[i] = 0;
    }
    if (!all_active)
        rows_.fill_images();
}

} // namespace periporo
