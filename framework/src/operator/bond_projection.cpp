// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
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

/// What the bonds of a point add at the places of its halo: A (9), force (3), shares of work and dilation.
constexpr std::size_t place_values = 16;

Tensor<Pack> in_all_lanes(const Tensor<double>& t)
{
    return {t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz};
}

/// What a pack of held bonds is asked for again after the material.
struct KeptBonds {
    BondGeometry geometry;
    Pack reciprocal_weight; ///< 1/w0 of the neighbour
};

class Evaluator {
public:
    Evaluator(Model& model, const Influence& influence, const Evaluation& evaluation)
        : model_(model), influence_(influence), evaluation_(evaluation),
          gradients_(model, influence, model.lent.data()), moments_(model, model.lent.data() + LentRows::room(model))
    {
    }

    void run();

private:
    void update_stress(std::size_t point, std::size_t block, OperatorSamples& samples);
    void begin_bonds(std::size_t point, const HeldBonds& held, BondStress& stress, std::vector<KeptBonds>& kept);
    void add_at_ends(std::size_t point, std::size_t block, const HeldBonds& held, const BondStress& stress,
                     const std::vector<KeptBonds>& kept);
    double* places_of(std::size_t block)
    {
        return model_.at_places.data() + model_.halos.first_place(block) * place_values;
    }
    void collect(std::size_t point);
    void add_moments(std::size_t point, BondForces& forces);

    Model& model_;
    const Influence& influence_;
    const Evaluation& evaluation_;
    PointGradients gradients_;
    LentRows moments_; ///< A_i K_i^-1, then nothing
    FirstFailure failure_;
};

/// Gradients of the bonds that the point holds, on to `stress`.
void Evaluator::begin_bonds(std::size_t point, const HeldBonds& held, BondStress& stress, std::vector<KeptBonds>& kept)
{
    const FamilyView family = model_.families[point];
    const Tensor<Pack> own_gradient = in_all_lanes(tensor_at(gradients_[point] + PointGradients::gradient_at));
    for (std::size_t p = 0; p < held.packs; ++p) {
        const std::uint32_t* neighbours = held.neighbours + p * pack_width;
        std::uint8_t lanes = 0;
        for (std::size_t lane = 0; lane < held.bonds_in(p); ++lane)
            if (model_.bonds.active.holds(family, held.first + p * pack_width + lane))
                lanes = static_cast<std::uint8_t>(lanes | 1u << lane);
        const PackMask active = lane_mask(lanes);
        const BondGeometry g(model_, point, neighbours, active, influence_);
        const auto other =
            load_transposed<LentRows::values>([&](std::size_t lane) { return gradients_[neighbours[lane]]; });
        Tensor<Pack> l{other[0], other[1], other[2], other[3], other[4], other[5], other[6], other[7], other[8]};
        l += own_gradient;
        l *= Pack(0.5);
        l += dyad(minus(g.motion, times(l, g.zeta)), g.along);
        const Tensor<Pack> at_middle = at_mid_step(l, 2.0 * evaluation_.gradient_lag());
        stress.begin(p, select(active, at_middle, Tensor<Pack>{}), lanes);
        kept.push_back({g, other[PointGradients::reciprocal_weight_at]});
    }
}

/// What the bonds that the point holds add at both their ends, to the places of the block.
void Evaluator::add_at_ends(std::size_t point, std::size_t block, const HeldBonds& held, const BondStress& stress,
                            const std::vector<KeptBonds>& kept)
{
    double* places = places_of(block);
    const std::uint16_t* place = model_.halos.place_of_neighbours(model_.families[point].first_pack) + held.first;
    const double self_volume = model_.records[point].volume;
    const double own_reciprocal_weight = gradients_[point][PointGradients::reciprocal_weight_at];
    std::array<Pack, place_values> own_sums;
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
        const Pack own_share = g.omega * g.volume * own_reciprocal_weight;
        const Pack other_share = g.omega * self_volume * kept[p].reciprocal_weight;
        std::array<Pack, place_values> at_other;
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
        own_sums[12] += own_share * bond.work;
        own_sums[13] += own_share * bond.dilation;
        at_other[12] = other_share * bond.work;
        at_other[13] = other_share * bond.dilation;
        at_other[14] = at_other[15] = 0.0;
        alignas(64) double rows[pack_width * place_values];
        store_transposed<place_values>(at_other, rows);
        const std::size_t first = p * pack_width;
        for (std::size_t lane = 0; lane < held.bonds_in(p); ++lane) {
            if (held.neighbours[first + lane] >= model_.size())
                continue; // an image: its parent holds the mirrored bond
            double* at = places + place[first + lane] * place_values;
            for (std::size_t c = 0; c < place_values; c += pack_width)
                store_pack(load_pack(at + c) + load_pack(rows + lane * place_values + c), at + c);
        }
    }
    double* at = places + (point - model_.halos.first_point(block)) * place_values;
    for (std::size_t c = 0; c < 14; ++c)
        at[c] += reduce(own_sums[c]);
}

/// Stress of the bonds that the point holds, and what follows from it at both their ends.
void Evaluator::update_stress(std::size_t point, std::size_t block, OperatorSamples& samples)
{
    SampledTimes times(samples, point);
    auto& workspace = thread_buffers<StressWorkspace>();
    auto& kept = thread_buffers<std::vector<KeptBonds>>();
    const HeldBonds held = model_.held(point);
    BondStress stress(model_, point, held.neighbours, held.packs, held.state, evaluation_, workspace);
    kept.clear();
    begin_bonds(point, held, stress, kept);
    times.end_of(&OperatorSamples::kinematics);
    if (const MaterialStatus status = stress.update(); !status.converged)
        failure_.report(point, {false, held.first + status.bond, status.reason});
    times.end_of(&OperatorSamples::material);
    add_at_ends(point, block, held, stress, kept);
    times.end_of(&OperatorSamples::force);
}

/// Sums what arrived at a point: A_i K_i^-1, the first part of its force, its work and dilation.
void Evaluator::collect(std::size_t point)
{
    std::array<Pack, place_values / pack_width> sum;
    sum.fill(Pack(0.0));
    for (const Halos::Arrival arrival : model_.halos.arrivals(point)) {
        if (arrival.isometry != 0)
            continue; // nothing was added to images
        const double* at = model_.at_places.data() + arrival.place * place_values;
        for (std::size_t c = 0; c < sum.size(); ++c)
            sum[c] += load_pack(at + c * pack_width);
    }
    alignas(64) double values[place_values];
    for (std::size_t c = 0; c < sum.size(); ++c)
        store_pack(sum[c], values + c * pack_width);
    const double* k = gradients_[point] + PointGradients::inverse_shape_at;
    double* row = moments_[point];
    std::fill_n(row, LentRows::values, 0.0);
    store_tensor(tensor_at(values) * SymmetricTensor<double>{k[0], k[1], k[2], k[3], k[4], k[5]}, row);
    model_.internal_force[point] = Vector3(values[9], values[10], values[11]);
    model_.stress_work[point] = model_.points.volume[point] * values[12];
    model_.volume_rate[point] = values[13];
}

/// omega V_i V_j (A_i K_i^-1 + A_j K_j^-1) zeta/|zeta|^2 of the bonds that the point holds.
void Evaluator::add_moments(std::size_t point, BondForces& forces)
{
    const HeldBonds held = model_.held(point);
    const Tensor<Pack> own = in_all_lanes(tensor_at(moments_[point]));
    const double self_volume = model_.records[point].volume;
    BondVector sum{Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::size_t p = 0; p < held.packs; ++p) {
        const std::uint32_t* neighbours = held.neighbours + p * pack_width;
        const BondGeometry g(model_, point, neighbours, lane_mask(held.lanes(p)), influence_);
        const auto m = load_transposed<LentRows::values>([&](std::size_t lane) { return moments_[neighbours[lane]]; });
        const Pack weight = g.omega * g.volume * self_volume;
        Tensor<Pack> both{m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
        both += own;
        const BondVector force = times(weight, times(both, g.along));
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += force[c];
        forces.take_from_points(model_, model_.families[point], held, p, force);
    }
    forces.give_to(point, sum);
}

void Evaluator::run()
{
    const Halos& halos = model_.halos;
    gradients_.find();
    for_every_block(model_, [&](std::size_t block, OperatorSamples& samples) {
        std::fill(places_of(block), places_of(block + 1), 0.0);
        for (std::size_t i = halos.first_point(block); i < halos.end_point(block); ++i)
            update_stress(i, block, samples);
    });
    failure_.raise(model_);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model_.size(); ++i)
        collect(i);
    moments_.show_images();
    for_every_block(model_, [&](std::size_t block, OperatorSamples& samples) {
        BondForces forces(model_, block);
        for (std::size_t i = halos.first_point(block); i < halos.end_point(block); ++i) {
            SampledTimes times(samples, i);
            add_moments(i, forces);
            times.end_of(&OperatorSamples::force);
        }
    });
    BondForces::hand_out(model_);
}

} // namespace

void BondProjectionForceState::evaluate(Model& model, const Evaluation& evaluation) const
{
    model.lent.resize(2 * LentRows::room(model));
    model.at_places.resize(model.halos.places() * place_values);
    Evaluator(model, influence(), evaluation).run();
}

void BondProjectionForceState::shares(const Model& model, std::size_t point, std::span<double> shares) const
{
    const FamilyView family = model.families[point];
    const NeighbourRecord& self = model.records[point];
    double total = 0.0;
    for (std::size_t b = 0; b < family.packs * pack_width; ++b) {
        const NeighbourRecord& other = model.records[family.neighbours[b]];
        total += shares[b] = model.bonds.active.holds(family, b)
                                 ? influence()((other.x() - self.x()).squaredNorm()) * other.volume
                                 : 0.0;
    }
    if (total > 0.0)
        for (double& share : shares)
            share /= total;
}

} // namespace periporo
