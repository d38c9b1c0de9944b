// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/bond_projection.hpp"

#include "operator/bond_forces.hpp"
#include "operator/bond_update.hpp"
#include "operator/bond_vector.hpp"
#include "operator/thread_buffers.hpp"

#include <algorithm>
#include <array>
#include <atomic>

namespace periporo {
namespace {

/// What a point lends to its bonds, as rows of 16 doubles in Model::lent: those of all points and images, twice. Images
/// hold theirs in their own frame, so that bonds need not ask.
constexpr std::size_t lent_values = 16;
/// The first row: L_i (9), 1/w0_i (0 when no bond is active), K_i^-1 (6; all zero where K_i cannot be inverted).
enum FirstRow : std::size_t { gradient_at = 0, reciprocal_weight_at = 9, inverse_shape_at = 10 };
/// The second row: A_i K_i^-1 (9), then nothing.
enum SecondRow : std::size_t { moment_at = 0 };

/// What the bonds of a point add at the places of its halo: A (9), force (3), shares of work and dilation.
constexpr std::size_t place_values = 16;

Tensor<double> tensor_at(const double* c)
{
    return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]};
}
Tensor<Pack> in_all_lanes(const Tensor<double>& t)
{
    return {t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz};
}
void store_tensor(const Tensor<double>& t, double* c)
{
    for (const double component : {t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz})
        *c++ = component;
}

void copy_in_frame_of(const Isometry& isometry, const double* from, double* to)
{
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> parent(from);
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{to} =
        isometry.rotation * parent * isometry.rotation.transpose();
}

/// The geometry of a pack of bonds.
struct BondGeometry {
    BondVector zeta;
    BondVector along;  ///< zeta/|zeta|^2; zero in lanes without a bond
    BondVector motion; ///< v_j - v_i
    Pack squared;      ///< |zeta|^2
    Pack omega;        ///< zero in lanes without a bond
    Pack volume;       ///< of the neighbour

    BondGeometry(const Model& model, std::size_t point, const std::uint32_t* neighbours, const PackMask& bonds,
                 const Influence& influence)
    {
        const NeighbourRecord& self = model.records[point];
        const std::array<Pack, 8> other =
            load_transposed<8>([&](std::size_t lane) { return model.records[neighbours[lane]].position; });
        for (std::size_t c = 0; c < 3; ++c) {
            zeta[c] = other[c] - self.position[c];
            motion[c] = other[4 + c] - self.velocity[c];
        }
        squared = dot(zeta, zeta);
        const PackMask real = bonds && squared > Pack(0.0);
        along = times(select(real, Pack(1.0) / squared, Pack(0.0)), zeta);
        omega = select(real, influence(squared), Pack(0.0));
        volume = other[3];
    }
};

/// What a pack of held bonds is asked for again after the material.
struct KeptBonds {
    BondGeometry geometry;
    Pack reciprocal_weight; ///< 1/w0 of the neighbour
};

/// Calls visit(block, samples) for every block of points, in parallel.
template <class Visit>
void for_every_block(Model& model, Visit&& visit)
{
#pragma omp parallel
    {
        OperatorSamples samples;
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < model.halos.blocks(); ++block)
            visit(block, samples);
#pragma omp critical(periporo_operator_samples)
        model.operator_samples += samples;
    }
}

class Evaluator {
public:
    Evaluator(Model& model, const Influence& influence, const Evaluation& evaluation)
        : model_(model), influence_(influence), evaluation_(evaluation),
          least_squared_(shortest_bond * shortest_bond * model.spacing * model.spacing)
    {
        const std::size_t rows = model.size() + model.families.images().size();
        model.lent.resize(2 * rows * lent_values);
        first_rows_ = model.lent.data();
        second_rows_ = first_rows_ + rows * lent_values;
        model.at_places.resize(model.halos.places() * place_values);
    }

    void run();

private:
    double* first_row(std::size_t point) { return first_rows_ + point * lent_values; }
    double* second_row(std::size_t point) { return second_rows_ + point * lent_values; }
    bool sound(std::size_t point) { return first_row(point)[inverse_shape_at] != 0.0; }

    bool find_gradient(std::size_t point);
    double find_activity(std::size_t point);
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

    template <class Copy>
    void update_images(Copy&& copy);

    Model& model_;
    const Influence& influence_;
    const Evaluation& evaluation_;
    double least_squared_;
    double* first_rows_;
    double* second_rows_;
    FirstFailure failure_;
};

/// L_i, K_i^-1 and 1/w0_i as if all bonds were active. Returns whether they can be: the point is sound and none of its
/// bonds too short.
bool Evaluator::find_gradient(std::size_t point)
{
    const FamilyView family = model_.families[point];
    SymmetricTensor<Pack> shape;
    Tensor<Pack> moment;
    Pack weights = 0.0;
    PackMask too_short(false);
    for (std::size_t p = 0; p < family.packs; ++p) {
        const PackMask bonds = lane_mask(family.lanes(p));
        const BondGeometry g(model_, point, family.neighbours + p * pack_width, bonds, influence_);
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
    double* row = first_row(point);
    std::fill_n(row, lent_values, 0.0);
    if (!(mean > 0.0 && det >= least_shape_quality * mean * mean * mean))
        return false;
    const SymmetricTensor<double> inverse = adjugate(k) * (1.0 / det);
    store_tensor(Tensor<double>{reduce(moment.xx), reduce(moment.xy), reduce(moment.xz), reduce(moment.yx),
                                reduce(moment.yy), reduce(moment.yz), reduce(moment.zx), reduce(moment.zy),
                                reduce(moment.zz)} *
                     inverse,
                 row + gradient_at);
    double* at = row + inverse_shape_at;
    for (const double c : {inverse.xx, inverse.yy, inverse.zz, inverse.xy, inverse.yz, inverse.xz})
        *at++ = c;
    row[reciprocal_weight_at] = 1.0 / reduce(weights);
    return !any(too_short);
}

/// Finds the active bonds of a point and returns 1/w0, once the soundness of all points is known.
double Evaluator::find_activity(std::size_t point)
{
    const FamilyView family = model_.families[point];
    double weight = 0.0;
    std::uint32_t active = 0;
    const NeighbourRecord& self = model_.records[point];
    for (std::size_t p = 0; p < family.packs; ++p) {
        std::uint8_t bits = 0;
        for (std::size_t lane = 0; lane < family.bonds_in(p); ++lane) {
            const std::uint32_t j = family.neighbours[p * pack_width + lane];
            if (!sound(point) || !sound(j))
                continue;
            const double squared = (model_.records[j].x() - self.x()).squaredNorm();
            if (squared < least_squared_)
                continue;
            bits = static_cast<std::uint8_t>(bits | 1u << lane);
            weight += influence_(squared) * model_.records[j].volume;
            ++active;
        }
        model_.bonds.active[family.first_pack + p] = bits;
    }
    model_.inactive_bonds[point] = static_cast<std::uint32_t>(family.count) - active;
    model_.free_grain[point] = active == 0 ? 1 : 0;
    return weight > 0.0 ? 1.0 / weight : 0.0;
}

/// Gradients of the bonds that the point holds, on to `stress`.
void Evaluator::begin_bonds(std::size_t point, const HeldBonds& held, BondStress& stress, std::vector<KeptBonds>& kept)
{
    const FamilyView family = model_.families[point];
    const Tensor<Pack> own_gradient = in_all_lanes(tensor_at(first_row(point) + gradient_at));
    for (std::size_t p = 0; p < held.packs; ++p) {
        const std::uint32_t* neighbours = held.neighbours + p * pack_width;
        std::uint8_t lanes = 0;
        for (std::size_t lane = 0; lane < held.bonds_in(p); ++lane)
            if (model_.bonds.active.holds(family, held.first + p * pack_width + lane))
                lanes = static_cast<std::uint8_t>(lanes | 1u << lane);
        const PackMask active = lane_mask(lanes);
        const BondGeometry g(model_, point, neighbours, active, influence_);
        const auto other = load_transposed<lent_values>([&](std::size_t lane) { return first_row(neighbours[lane]); });
        Tensor<Pack> l{other[0], other[1], other[2], other[3], other[4], other[5], other[6], other[7], other[8]};
        l += own_gradient;
        l *= Pack(0.5);
        l += dyad(minus(g.motion, times(l, g.zeta)), g.along);
        const Tensor<Pack> at_middle = at_mid_step(l, 2.0 * evaluation_.gradient_lag());
        stress.begin(p, select(active, at_middle, Tensor<Pack>{}), lanes);
        kept.push_back({g, other[reciprocal_weight_at]});
    }
}

/// What the bonds that the point holds add at both their ends, to the places of the block.
void Evaluator::add_at_ends(std::size_t point, std::size_t block, const HeldBonds& held, const BondStress& stress,
                            const std::vector<KeptBonds>& kept)
{
    double* places = places_of(block);
    const std::uint16_t* place = model_.halos.place_of_neighbours(model_.families[point].first_pack) + held.first;
    const double self_volume = model_.records[point].volume;
    const double own_reciprocal_weight = first_row(point)[reciprocal_weight_at];
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
    const double* k = first_row(point) + inverse_shape_at;
    double* row = second_row(point);
    std::fill_n(row, lent_values, 0.0);
    store_tensor(tensor_at(values) * SymmetricTensor<double>{k[0], k[1], k[2], k[3], k[4], k[5]}, row + moment_at);
    model_.internal_force[point] = Vector3(values[9], values[10], values[11]);
    model_.stress_work[point] = model_.points.volume[point] * values[12];
    model_.volume_rate[point] = values[13];
}

/// omega V_i V_j (A_i K_i^-1 + A_j K_j^-1) zeta/|zeta|^2 of the bonds that the point holds.
void Evaluator::add_moments(std::size_t point, BondForces& forces)
{
    const HeldBonds held = model_.held(point);
    const Tensor<Pack> own = in_all_lanes(tensor_at(second_row(point) + moment_at));
    const double self_volume = model_.records[point].volume;
    BondVector sum{Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::size_t p = 0; p < held.packs; ++p) {
        const std::uint32_t* neighbours = held.neighbours + p * pack_width;
        const BondGeometry g(model_, point, neighbours, lane_mask(held.lanes(p)), influence_);
        const auto m = load_transposed<lent_values>([&](std::size_t lane) { return second_row(neighbours[lane]); });
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

/// Calls copy(isometry, parent, image) for every image.
template <class Copy>
void Evaluator::update_images(Copy&& copy)
{
    const std::vector<Image>& images = model_.families.images();
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < images.size(); ++m)
        copy(model_.isometries[images[m].isometry], images[m].parent, model_.size() + m);
}

void Evaluator::run()
{
    const Halos& halos = model_.halos;
    std::atomic<bool> all_active = true;
    for_every_block(model_, [&](std::size_t block, OperatorSamples& samples) {
        for (std::size_t i = halos.first_point(block); i < halos.end_point(block); ++i) {
            SampledTimes times(samples, i);
            if (!find_gradient(i))
                all_active.store(false, std::memory_order_relaxed);
            times.end_of(&OperatorSamples::kinematics);
        }
    });
    const auto lend_gradient = [&](const Isometry& isometry, std::size_t parent, std::size_t image) {
        std::copy_n(first_row(parent), lent_values, first_row(image));
        copy_in_frame_of(isometry, first_row(parent) + gradient_at, first_row(image) + gradient_at);
    };
    update_images(lend_gradient);
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t i = 0; i < model_.size(); ++i) {
        if (!all_active) {
            first_row(i)[reciprocal_weight_at] = find_activity(i);
            continue;
        }
        const FamilyView family = model_.families[i];
        for (std::size_t p = 0; p < family.packs; ++p)
            model_.bonds.active[family.first_pack + p] = family.lanes(p);
        model_.inactive_bonds[i] = 0;
        model_.free_grain[i] = 0;
    }
    if (!all_active)
        update_images(lend_gradient);
    for_every_block(model_, [&](std::size_t block, OperatorSamples& samples) {
        std::fill(places_of(block), places_of(block + 1), 0.0);
        for (std::size_t i = halos.first_point(block); i < halos.end_point(block); ++i)
            update_stress(i, block, samples);
    });
    failure_.raise(model_);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < model_.size(); ++i)
        collect(i);
    update_images([&](const Isometry& isometry, std::size_t parent, std::size_t image) {
        std::fill_n(second_row(image), lent_values, 0.0);
        copy_in_frame_of(isometry, second_row(parent) + moment_at, second_row(image) + moment_at);
    });
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
