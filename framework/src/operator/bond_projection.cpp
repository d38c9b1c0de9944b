// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Stress and forces of the bond projection, in two passes over the bonds.
#include "operator/bond_projection.hpp"

#include "operator/block_loop.hpp"
#include "operator/bond_forces.hpp"
#include "operator/bond_geometry.hpp"
#include "operator/bond_update.hpp"
#include "operator/point_gradients.hpp"
#include "operator/thread_buffers.hpp"

#include <algorithm>
#include <array>

namespace periporo {
namespace {

/// The bonds of a point add to an accumulator: A (9), force (3), weighted work and dilation, and two zeros.
constexpr std::size_t sum_values = 16;

Tensor<Pack> in_all_lanes(const Tensor<double>& t)
{
    return {t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz};
}

/// What a pack of held bonds needs again after the material.
struct KeptBonds {
    BondGeometry geometry;
    Pack reciprocal_weight; ///< 1/w0 of the neighbour
};

class Evaluator {
public:
    Evaluator(const OperatorInput& input, const Influence& influence, const Evaluation& evaluation, BondStates& bonds,
              OperatorWorkspace& workspace, OperatorResult& result)
        : input_(input), blocks_(input.neighbourhood.blocks), influence_(influence), evaluation_(evaluation),
          bonds_(bonds), workspace_(workspace), result_(result),
          gradients_(input, influence, workspace.end_fields.data(), result),
          moments_(input.neighbourhood, workspace.end_fields.data() + EndField::room(input.neighbourhood))
    {
    }

    void run();

private:
    void update_stress(std::size_t point, std::size_t block, OperatorTimes& samples);
    void begin_bonds(std::size_t point, const HeldBonds& held, BondStress& stress, std::vector<KeptBonds>& kept);
    void add_at_ends(std::size_t point, std::size_t block, const HeldBonds& held, const BondStress& stress,
                     const std::vector<KeptBonds>& kept);
    double* sums_of(std::size_t block) { return workspace_.accumulators.data() + blocks_.first(block) * sum_values; }
    HeldBonds held(std::size_t point) { return bonds_.held(point, input_.family(point), input_.state.rows(point)); }
    void collect(std::size_t point);
    void add_moments(std::size_t point, BondForces& forces);

    const OperatorInput& input_;
    const BlockAccumulators& blocks_;
    const Influence& influence_;
    const Evaluation& evaluation_;
    BondStates& bonds_;
    OperatorWorkspace& workspace_;
    OperatorResult& result_;
    PointGradients gradients_;
    EndField moments_; ///< A_i K_i^-1, then nothing
    FirstFailure failure_;
};

/// Gradients of the bonds that the point holds, on to `stress`.
void Evaluator::begin_bonds(std::size_t point, const HeldBonds& held, BondStress& stress, std::vector<KeptBonds>& kept)
{
    const FamilyView family = input_.family(point);
    const Tensor<Pack> own_gradient = in_all_lanes(tensor_at(gradients_[point] + PointGradients::gradient_at));
    for (std::size_t p = 0; p < held.packs; ++p) {
        const std::uint32_t* neighbours = held.neighbours + p * pack_width;
        std::uint8_t lanes = 0;
        for (std::size_t lane = 0; lane < held.bonds_in(p); ++lane)
            if (result_.active.holds(family, held.first + p * pack_width + lane))
                lanes = static_cast<std::uint8_t>(lanes | 1u << lane);
        const PackMask active = lane_mask(lanes);
        const BondGeometry g(input_.ends, point, neighbours, active, influence_);
        const auto other =
            load_transposed<EndField::values>([&](std::size_t lane) { return gradients_[neighbours[lane]]; });
        Tensor<Pack> l{other[0], other[1], other[2], other[3], other[4], other[5], other[6], other[7], other[8]};
        l += own_gradient;
        l *= Pack(0.5);
        l += dyad(minus(g.motion, times(l, g.zeta)), g.along);
        const Tensor<Pack> at_middle = at_mid_step(l, 2.0 * evaluation_.gradient_lag());
        stress.begin(p, select(active, at_middle, Tensor<Pack>{}), lanes);
        kept.push_back({g, other[PointGradients::reciprocal_weight_at]});
    }
}

/// Adds the parts of the bonds that the point holds to the accumulators of both their ends.
void Evaluator::add_at_ends(std::size_t point, std::size_t block, const HeldBonds& held, const BondStress& stress,
                            const std::vector<KeptBonds>& kept)
{
    double* sums = sums_of(block);
    const std::uint16_t* accumulator = blocks_.of_neighbours(input_.family(point).first_pack) + held.first;
    const double self_volume = input_.ends[point].volume;
    const double own_reciprocal_weight = gradients_[point][PointGradients::reciprocal_weight_at];
    std::array<Pack, sum_values> own_sums;
    own_sums.fill(Pack(0.0));
    for (std::size_t p = 0; p < held.packs; ++p) {
        const BondGeometry& g = kept[p].geometry;
        const PackMask active = lane_mask(stress.active(p));
        const BondStress::Outcome bond = stress.end(p);
        const Pack mutual =
            select(active, g.omega * (kept[p].reciprocal_weight + own_reciprocal_weight), Pack(0.0)); // S_ij
        const BondVector traction = times(full(bond.stress), g.along);
        Tensor<Pack> projected = full(bond.stress);
        projected -= dyad(traction, g.zeta);
        projected *= 0.5 * mutual;
        const Pack product = mutual * g.volume * self_volume;
        const BondVector force = times(product, traction);
        const Pack own_weight = g.omega * g.volume * own_reciprocal_weight;
        const Pack other_weight = g.omega * self_volume * kept[p].reciprocal_weight;
        std::array<Pack, sum_values> at_other;
        std::size_t c9 = 0;
        for (const Pack& component : {projected.xx, projected.xy, projected.xz, projected.yx, projected.yy,
                                      projected.yz, projected.zx, projected.zy, projected.zz}) {
            own_sums[c9] += g.volume * component;
            at_other[c9++] = self_volume * component;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            own_sums[9 + c] += force[c];
            at_other[9 + c] = -force[c];
        }
        own_sums[12] += own_weight * bond.work;
        own_sums[13] += own_weight * bond.dilation;
        at_other[12] = other_weight * bond.work;
        at_other[13] = other_weight * bond.dilation;
        at_other[14] = at_other[15] = 0.0;
        alignas(64) double rows[pack_width * sum_values];
        store_transposed<sum_values>(at_other, rows);
        const std::size_t first = p * pack_width;
        for (std::size_t lane = 0; lane < held.bonds_in(p); ++lane) {
            if (held.neighbours[first + lane] >= input_.size())
                continue; // an image: its point holds the mirrored bond
            double* at = sums + accumulator[first + lane] * sum_values;
            for (std::size_t c = 0; c < sum_values; c += pack_width)
                store_pack(load_pack(at + c) + load_pack(rows + lane * sum_values + c), at + c);
        }
    }
    double* at = sums + (point - blocks_.first_point(block)) * sum_values;
    for (std::size_t c = 0; c < 14; ++c)
        at[c] += reduce(own_sums[c]);
}

/// Updates the stress of the bonds that the point holds and adds its effects at both their ends.
void Evaluator::update_stress(std::size_t point, std::size_t block, OperatorTimes& samples)
{
    SampledTimes times(samples, point);
    auto& buffers = thread_buffers<StressWorkspace>();
    auto& kept = thread_buffers<std::vector<KeptBonds>>();
    const HeldBonds held = this->held(point);
    BondStress stress(input_, point, held.neighbours, held.packs, held.state, evaluation_, buffers);
    kept.clear();
    begin_bonds(point, held, stress, kept);
    times.end_of(&OperatorTimes::kinematics);
    if (const MaterialStatus status = stress.update(); !status.converged)
        failure_.report(point, {false, held.first + status.bond, status.reason});
    times.end_of(&OperatorTimes::material);
    add_at_ends(point, block, held, stress, kept);
    times.end_of(&OperatorTimes::force);
}

/// Sums the contributions to a point: A_i K_i^-1, the first part of its force, its work and dilation.
void Evaluator::collect(std::size_t point)
{
    std::array<Pack, sum_values / pack_width> sum;
    sum.fill(Pack(0.0));
    for (const BlockAccumulators::Contribution part : blocks_.contributions(point)) {
        if (part.isometry != 0)
            continue; // nothing was added to images
        const double* at = workspace_.accumulators.data() + part.accumulator * sum_values;
        for (std::size_t c = 0; c < sum.size(); ++c)
            sum[c] += load_pack(at + c * pack_width);
    }
    alignas(64) double values[sum_values];
    for (std::size_t c = 0; c < sum.size(); ++c)
        store_pack(sum[c], values + c * pack_width);
    const double* k = gradients_[point] + PointGradients::inverse_shape_at;
    double* row = moments_[point];
    std::fill_n(row, EndField::values, 0.0);
    store_tensor(tensor_at(values) * SymmetricTensor<double>{k[0], k[1], k[2], k[3], k[4], k[5]}, row);
    result_.internal_force[point] = Vector3(values[9], values[10], values[11]);
    result_.stress_work[point] = input_.state.points.volume[point] * values[12];
    result_.volume_rate[point] = values[13];
}

/// omega V_i V_j (A_i K_i^-1 + A_j K_j^-1) zeta/|zeta|^2 of the bonds that the point holds.
void Evaluator::add_moments(std::size_t point, BondForces& forces)
{
    const HeldBonds held = this->held(point);
    const Tensor<Pack> own = in_all_lanes(tensor_at(moments_[point]));
    const double self_volume = input_.ends[point].volume;
    BondVector sum{Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::size_t p = 0; p < held.packs; ++p) {
        const std::uint32_t* neighbours = held.neighbours + p * pack_width;
        const BondGeometry g(input_.ends, point, neighbours, lane_mask(held.lanes(p)), influence_);
        const auto m = load_transposed<EndField::values>([&](std::size_t lane) { return moments_[neighbours[lane]]; });
        const Pack weight = g.omega * g.volume * self_volume;
        Tensor<Pack> both{m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
        both += own;
        const BondVector force = times(weight, times(both, g.along));
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += force[c];
        forces.subtract_from_points(input_.size(), input_.family(point), held, p, force);
    }
    forces.add_to(point, sum);
}

void Evaluator::run()
{
    gradients_.find();
    for_every_block(blocks_, result_.times, [&](std::size_t block, OperatorTimes& samples) {
        std::fill(sums_of(block), sums_of(block + 1), 0.0);
        for (std::size_t i = blocks_.first_point(block); i < blocks_.end_point(block); ++i)
            update_stress(i, block, samples);
    });
    failure_.raise(input_.state, input_.neighbourhood.families);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < input_.size(); ++i)
        collect(i);
    moments_.fill_images();
    for_every_block(blocks_, result_.times, [&](std::size_t block, OperatorTimes& samples) {
        BondForces forces(blocks_, block, workspace_);
        for (std::size_t i = blocks_.first_point(block); i < blocks_.end_point(block); ++i) {
            SampledTimes times(samples, i);
            add_moments(i, forces);
            times.end_of(&OperatorTimes::force);
        }
    });
    BondForces::distribute(input_.neighbourhood, workspace_, result_);
}

} // namespace

void BondProjectionForceState::evaluate(const OperatorInput& input, const Evaluation& evaluation, BondStates& bonds,
                                        OperatorWorkspace& workspace, OperatorResult& result) const
{
    workspace.end_fields.resize(2 * EndField::room(input.neighbourhood));
    workspace.accumulators.resize(input.neighbourhood.blocks.size() * sum_values);
    Evaluator(input, influence(), evaluation, bonds, workspace, result).run();
}

void BondProjectionForceState::bond_weights(const Model& model, std::size_t point, std::span<double> weights) const
{
    const FamilyView family = model.neighbourhood.families[point];
    const BondEnd& self = model.ends[point];
    double total = 0.0;
    for (std::size_t b = 0; b < family.packs * pack_width; ++b) {
        const BondEnd& other = model.ends[family.neighbours[b]];
        total += weights[b] = model.result.active.holds(family, b)
                                  ? influence()((other.x() - self.x()).squaredNorm()) * other.volume
                                  : 0.0;
    }
    if (total > 0.0)
        for (double& weight : weights)
            weight /= total;
}

} // namespace periporo
