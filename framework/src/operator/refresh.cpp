// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/refresh.hpp"

#include "operator/occupied_volume.hpp"
#include "operator/transpose.hpp"
#include "periporo/first_exception.hpp"
#include "time/ordered_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace periporo {
namespace {

/// The state of a point as an image shows it: stress rotated, state variables as they are.
void point_state_seen_as(const Isometry& isometry, const double* state, std::size_t rows, double* seen)
{
    std::copy_n(state, rows, seen);
    const Eigen::Matrix3d& q = isometry.rotation;
    const SymmetricTensor<double> stress =
        rotated(SymmetricTensor<double>{state[0], state[1], state[2], state[3], state[4], state[5]},
                Tensor<double>{q(0, 0), q(0, 1), q(0, 2), q(1, 0), q(1, 1), q(1, 2), q(2, 0), q(2, 1), q(2, 2)});
    const double components[6] = {stress.xx, stress.yy, stress.zz, stress.xy, stress.yz, stress.xz};
    std::copy_n(components, 6, seen);
}

/// For each body its rows that hold variables of the point (StateVariable::of_point).
std::vector<std::vector<std::size_t>> point_rows(const Model& model)
{
    std::vector<std::vector<std::size_t>> rows(model.bodies.size());
    for (std::size_t body = 0; body < model.bodies.size(); ++body) {
        const std::vector<StateVariable>& variables = model.bodies[body].material->state_variables();
        for (std::size_t s = 0; s < variables.size(); ++s)
            if (variables[s].of_point)
                rows[body].push_back(6 + s);
    }
    return rows;
}

/// What a variable of the point begins with on a bond: the point's own value, or where (i,j) and (j,i) are one bond,
/// the mean of its ends.
double begun_with(const Model& model, std::size_t point, std::uint32_t neighbour, std::size_t row)
{
    const double own = model.point_state[point * model.state_stride + row];
    if (!model.has_shared_bonds)
        return own;
    return 0.5 * (own + model.point_state[model.families.parent(neighbour) * model.state_stride + row]);
}

/// Calls set(neighbour, rows of the bond) for every bond that a point holds and every lane behind the last.
template <class Set>
void for_held_bonds(Model& model, std::size_t point, Set&& set)
{
    const HeldBonds held = model.held(point);
    for (std::size_t h = 0; h < held.packs * pack_width; ++h)
        set(h < held.count ? held.neighbours[h] : static_cast<std::uint32_t>(point), held.bond(h));
}

/// Every bond takes its point variables from its point.
void hand_out_point_variables(Model& model)
{
    const std::vector<std::vector<std::size_t>> of_point = point_rows(model);
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t i = 0; i < model.size(); ++i)
        for_held_bonds(model, i, [&](std::uint32_t neighbour, double* bond) {
            for (const std::size_t r : of_point[model.points.body[i]])
                bond[r * pack_width] = begun_with(model, i, neighbour, r);
        });
}

/// Bonds of families that have just been found, with the states of their points.
void begin_bonds(Model& model)
{
    model.bonds.states.resize(model.halos.blocks());
    model.bonds.first.resize(model.size());
    FirstException failure;
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t block = 0; block < model.halos.blocks(); ++block)
        failure.guard(block, [&] {
            model.lay_out_bonds(block);
            for (std::size_t i = model.halos.first_point(block); i < model.halos.end_point(block); ++i) {
                const std::size_t rows = model.rows(i);
                const double* state = model.point_state.data() + i * model.state_stride;
                for_held_bonds(model, i, [&](std::uint32_t, double* bond) {
                    for (std::size_t r = 0; r < rows; ++r)
                        bond[r * pack_width] = state[r];
                });
            }
        });
    failure.rethrow();
    model.update_records();
}

void follow_force_state(Model& model, const ForceState& force_state)
{
    model.has_sub_horizons = force_state.uses_sub_horizons();
    model.has_shared_bonds = force_state.shares_bonds();
}

} // namespace

void find_first_families(Model& model, const ForceState& force_state)
{
    follow_force_state(model, force_state);
    model.find_families();
    begin_bonds(model);
}

void resume_families(Model& model, const ForceState& force_state, const Families::Kept& kept)
{
    follow_force_state(model, force_state);
    const std::vector<Vector3> now = std::exchange(model.points.position, model.refresh_position);
    model.restore_families(kept);
    begin_bonds(model);
    model.points.position = now;
}

void collect_point_variables(Model& model, const ForceState& force_state)
{
    const std::vector<std::vector<std::size_t>> of_point = point_rows(model);
    std::vector<double> shares;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const FamilyView family = model.families[i];
        if (family.count == 0 || of_point[model.points.body[i]].empty())
            continue;
        shares.resize(family.packs * pack_width);
        force_state.shares(model, i, shares);
        if (std::accumulate(shares.begin(), shares.end(), 0.0) == 0.0)
            std::fill_n(shares.begin(), family.count, 1.0 / static_cast<double>(family.count));
        for (const std::size_t r : of_point[model.points.body[i]]) {
            double& value = model.point_state[i * model.state_stride + r];
            value = 0.0;
            for (std::size_t b = 0; b < family.count; ++b)
                value += shares[b] * model.bond_state(i, b)[r * pack_width];
        }
    }
    hand_out_point_variables(model);
}

namespace {

/// Adds shares times rows of the bonds that the other end holds to what is zero before.
void add_bonds_of_others(const Model& model, std::size_t point, std::span<const double> shares, double* state)
{
    const std::size_t rows = model.rows(point);
    std::fill_n(state, rows, 0.0);
    for (std::size_t b = 0; b < model.held(point).first; ++b) {
        const double* bond = model.bond_state(point, b);
        for (std::size_t r = 0; r < rows; ++r)
            state[r] += shares[b] * bond[r * pack_width];
    }
}

/// Adds shares times rows of the bonds that the point holds. States are read in the order in which they lie.
void add_held_bonds(const Model& model, std::size_t point, std::span<const double> shares, AlignedVector<double>& sums,
                    double* state)
{
    const ConstHeldBonds held = model.held(point);
    sums.assign(held.rows * pack_width, 0.0);
    for (std::size_t p = 0; p < held.packs; ++p) {
        alignas(64) double lanes[pack_width] = {};
        std::copy_n(shares.data() + held.first + p * pack_width, held.bonds_in(p), lanes);
        const Pack share = load_pack(lanes);
        const double* rows = held.state + p * held.rows * pack_width;
        for (std::size_t at = 0; at < sums.size(); at += pack_width)
            store_pack(load_pack(&sums[at]) + share * load_pack(rows + at), &sums[at]);
    }
    for (std::size_t r = 0; r < held.rows; ++r)
        state[r] += reduce(load_pack(&sums[r * pack_width]));
}

/// Mean of what a variable of the point began with on its bonds.
double mean_begun_with(const Model& model, std::size_t point, std::span<const double> shares, std::size_t row)
{
    if (!model.has_shared_bonds) // the same on all
        return begun_with(model, point, 0, row) * std::accumulate(shares.begin(), shares.end(), 0.0);
    const FamilyView family = model.families[point];
    double mean = 0.0;
    for (std::size_t b = 0; b < family.count; ++b)
        mean += shares[b] * begun_with(model, point, family.neighbours[b], row);
    return mean;
}

} // namespace

void mean_point_states(const Model& model, const ForceState& force_state, std::vector<double>& states)
{
    const std::vector<std::vector<std::size_t>> of_point = point_rows(model);
    FirstException failure;
#pragma omp parallel
    {
        std::vector<double> shares;
        AlignedVector<double> sums;
        const auto find_mean = [&](std::size_t i) {
            double* state = states.data() + i * model.state_stride;
            if (model.free_grain[i] != 0) {
                std::fill_n(state, 6, 0.0);
                return;
            }
            const FamilyView family = model.families[i];
            shares.resize(family.packs * pack_width);
            force_state.shares(model, i, shares);
            add_bonds_of_others(model, i, shares, state);
            add_held_bonds(model, i, shares, sums, state);
            for (const std::size_t r : of_point[model.points.body[i]])
                state[r] += model.point_state[i * model.state_stride + r] - mean_begun_with(model, i, shares, r);
        };
#pragma omp for schedule(dynamic, 64)
        for (std::size_t i = 0; i < model.size(); ++i)
            failure.guard(i, [&] { find_mean(i); });
    }
    failure.rethrow();
}

namespace {

/// The states of the bonds of one block as they were; the buffer only ever grows.
class BlockBefore {
public:
    void keep(const Model& model, std::size_t block)
    {
        const UnsetVector<double>& states = model.bonds.states[block];
        states_.resize(std::max(states_.size(), states.size()));
        std::copy(states.begin(), states.end(), states_.begin());
        const std::size_t first = model.halos.first_point(block);
        std::copy_n(model.bonds.first.begin() + first, model.halos.end_point(block) - first, first_.begin());
    }
    const double* state(std::size_t point) const { return states_.data() + first_[point % block_size]; }

private:
    UnsetVector<double> states_;
    std::array<std::uint32_t, block_size> first_;
};

/// Sets the states of the bonds that a point holds from those that it held: `state`, of the family and the active bonds
/// before. `seen` has room for the state of a point.
void hand_over(Model& model, std::size_t point, const Families& families_before, const ActiveBonds& active_before,
               const double* state, std::vector<double>& seen)
{
    const FamilyView before = families_before[point];
    const ConstHeldBonds held_before = model.held(point, before, state);
    const std::size_t rows = held_before.rows;
    const double* own = model.point_state.data() + point * model.state_stride;
    std::size_t at = held_before.first; // both families are ordered by key
    for_held_bonds(model, point, [&](std::uint32_t j, double* bond) {
        const std::uint64_t key = model.families.key(j);
        while (at < before.count && families_before.key(before.neighbours[at]) < key)
            ++at;
        if (at < before.count && families_before.key(before.neighbours[at]) == key && active_before.holds(before, at)) {
            const double* old = held_before.bond(at - held_before.first);
            for (std::size_t r = 0; r < rows; ++r)
                bond[r * pack_width] = old[r * pack_width];
            return;
        }
        const double* other = model.point_state.data() + model.families.parent(j) * model.state_stride;
        if (const std::uint32_t isometry = model.families.isometry(j); isometry != 0) {
            point_state_seen_as(model.isometries[isometry], other, rows, seen.data());
            other = seen.data();
        }
        for (std::size_t r = 0; r < rows; ++r)
            bond[r * pack_width] = 0.5 * (own[r] + other[r]);
    });
}

} // namespace

void refresh_families(Model& model, const ForceState& force_state, std::span<const ClosedPair> closed)
{
    model.update_records();
    std::vector<double> states = model.point_state;
    mean_point_states(model, force_state, states);
    const Model::Replaced replaced = model.renew_families(closed);
    model.point_state.swap(states);
    FirstException failure;
#pragma omp parallel
    {
        BlockBefore before;
        std::vector<double> seen;
        failure.guard_set_up([&] { seen.resize(model.state_stride); });
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < model.halos.blocks(); ++block)
            failure.guard(block, [&] {
                before.keep(model, block);
                model.lay_out_bonds(block);
                for (std::size_t i = model.halos.first_point(block); i < model.halos.end_point(block); ++i)
                    hand_over(model, i, replaced.families, replaced.active, before.state(i), seen);
            });
    }
    failure.rethrow();
    hand_out_point_variables(model);
    model.update_records();
    follow_occupied_volume(model, replaced.families);
}

double displacement_since_refresh(const Model& model)
{
    const std::size_t n = model.size();
    const auto moved = [&](std::size_t i) { return Vector3(model.points.position[i] - model.refresh_position[i]); };
    const std::array<double, 3> sum = ordered_sums<3>(n, [&](std::size_t i, std::array<double, 3>& sums) {
        for (std::size_t c = 0; c < 3; ++c)
            sums[c] += moved(i)[static_cast<Eigen::Index>(c)];
    });
    const Vector3 mean = Vector3(sum[0], sum[1], sum[2]) / static_cast<double>(std::max<std::size_t>(n, 1));
    double largest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (std::size_t i = 0; i < n; ++i)
        largest = std::max(largest, (moved(i) - mean).squaredNorm());
    return std::sqrt(largest);
}

} // namespace periporo
