// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families anew, and the states that their bonds begin with.
#include "operator/refresh.hpp"

#include "operator/occupied_volume.hpp"
#include "operator/transpose.hpp"
#include "periporo/first_exception.hpp"
#include "state/ordered_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace periporo {
namespace {

/// The states of points at all ends of bonds: those of images have their stress rotated.
class EndStates {
public:
    EndStates(const State& state, const Neighbourhood& neighbourhood) : state_(state), points_(state.size())
    {
        const std::size_t stride = state.point_states.stride;
        const std::vector<Image>& images = neighbourhood.families.images();
        images_.resize(images.size() * stride);
#pragma omp parallel for schedule(static)
        for (std::size_t m = 0; m < images.size(); ++m) {
            const double* from = state.point_states[images[m].parent];
            double* to = images_.data() + m * stride;
            std::copy_n(from, stride, to);
            const Eigen::Matrix3d& q = neighbourhood.isometries[images[m].isometry].rotation;
            const SymmetricTensor<double> stress =
                rotated(symmetric_tensor(from), Tensor<double>{q(0, 0), q(0, 1), q(0, 2), q(1, 0), q(1, 1), q(1, 2),
                                                               q(2, 0), q(2, 1), q(2, 2)});
            std::ranges::copy(components(stress), to);
        }
    }
    const double* operator[](std::size_t end) const
    {
        return end < points_ ? state_.point_states[end] : images_.data() + (end - points_) * state_.point_states.stride;
    }

private:
    const State& state_;
    std::size_t points_;
    std::vector<double> images_;
};

/// For each body its rows that hold variables of the point (StateVariable::of_point).
std::vector<std::vector<std::size_t>> point_rows(const Model& model)
{
    std::vector<std::vector<std::size_t>> rows(model.state.bodies.size());
    for (std::size_t body = 0; body < model.state.bodies.size(); ++body) {
        const std::vector<StateVariable>& variables = model.state.bodies[body].material->state_variables();
        for (std::size_t s = 0; s < variables.size(); ++s)
            if (variables[s].of_point)
                rows[body].push_back(6 + s);
    }
    return rows;
}

/// The value that a variable of the point has on a bond after a refresh: that of the point, or the mean of both ends
/// where (i,j) and (j,i) have one state.
double initial_on_bond(const BondStates& bonds, const EndStates& states, std::size_t point, std::uint32_t neighbour,
                       std::size_t row)
{
    const double own = states[point][row];
    return bonds.shared ? 0.5 * (own + states[neighbour][row]) : own;
}

/// Calls set(neighbour, rows of the bond) for every bond that a point holds and every lane behind the last.
template <class Set>
void for_held_bonds(Model& model, std::size_t point, Set&& set)
{
    const HeldBonds held = model.held(point);
    for (std::size_t h = 0; h < held.packs * pack_width; ++h)
        set(h < held.count ? held.neighbours[h] : static_cast<std::uint32_t>(point), held.bond(h));
}

/// Sets the point variables of every bond from those of its point.
void distribute_point_variables(Model& model, const EndStates& states)
{
    const std::vector<std::vector<std::size_t>> of_point = point_rows(model);
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t i = 0; i < model.size(); ++i)
        for_held_bonds(model, i, [&](std::uint32_t neighbour, double* bond) {
            for (const std::size_t r : of_point[model.state.points.body[i]])
                bond[r * pack_width] = initial_on_bond(model.bonds, states, i, neighbour, r);
        });
}

/// Lays out the bonds of families that have just been found, with the states of their points; none is active.
void begin_bonds(Model& model)
{
    model.bonds.resize(model.neighbourhood.blocks.blocks(), model.size());
    model.result.active.assign(model.neighbourhood.families.packs(), 0);
    FirstException failure;
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t block = 0; block < model.neighbourhood.blocks.blocks(); ++block)
        failure.guard(block, [&] {
            model.bonds.lay_out(block, model.state, model.neighbourhood);
            for (std::size_t i = model.neighbourhood.blocks.first_point(block);
                 i < model.neighbourhood.blocks.end_point(block); ++i) {
                const std::size_t rows = model.rows(i);
                const double* state = model.state.point_states[i];
                for_held_bonds(model, i, [&](std::uint32_t, double* bond) {
                    for (std::size_t r = 0; r < rows; ++r)
                        bond[r * pack_width] = state[r];
                });
            }
        });
    failure.rethrow();
    model.gather_ends();
}

void follow_force_state(Model& model, const ForceState& force_state)
{
    model.neighbourhood.has_sub_horizons = force_state.uses_sub_horizons();
    model.bonds.shared = force_state.stress_site() == StressSite::pairs;
}

} // namespace

void find_first_families(Model& model, const ForceState& force_state)
{
    follow_force_state(model, force_state);
    model.neighbourhood.find(model.state);
    begin_bonds(model);
}

void resume_families(Model& model, const ForceState& force_state, const Families::Kept& kept)
{
    follow_force_state(model, force_state);
    const std::vector<Vector3> now = std::exchange(model.state.points.position, model.neighbourhood.positions);
    model.neighbourhood.restore(model.state, kept);
    begin_bonds(model);
    model.state.points.position = now;
}

void collect_point_variables(Model& model, const ForceState& force_state)
{
    const std::vector<std::vector<std::size_t>> of_point = point_rows(model);
    std::vector<double> weights;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const FamilyView family = model.neighbourhood.families[i];
        if (family.count == 0 || of_point[model.state.points.body[i]].empty())
            continue;
        weights.resize(family.packs * pack_width);
        force_state.bond_weights(model, i, weights);
        if (std::accumulate(weights.begin(), weights.end(), 0.0) == 0.0)
            std::fill_n(weights.begin(), family.count, 1.0 / static_cast<double>(family.count));
        for (const std::size_t r : of_point[model.state.points.body[i]]) {
            double& value = model.state.point_states[i][r];
            value = 0.0;
            for (std::size_t b = 0; b < family.count; ++b)
                value += weights[b] * model.bond_state(i, b)[r * pack_width];
        }
    }
    distribute_point_variables(model, EndStates(model.state, model.neighbourhood));
}

namespace {

/// Sets a state to the weighted sum over the bonds that the other end holds.
void add_bonds_of_others(const Model& model, std::size_t point, std::span<const double> weights, double* state)
{
    const std::size_t rows = model.rows(point);
    std::fill_n(state, rows, 0.0);
    for (std::size_t b = 0; b < model.held(point).first; ++b) {
        const double* bond = model.bond_state(point, b);
        for (std::size_t r = 0; r < rows; ++r)
            state[r] += weights[b] * bond[r * pack_width];
    }
}

/// Adds the weighted sum over the bonds that the point holds. States are read in the order in which they lie.
void add_held_bonds(const Model& model, std::size_t point, std::span<const double> weights, AlignedVector<double>& sums,
                    double* state)
{
    const ConstHeldBonds held = model.held(point);
    sums.assign(held.rows * pack_width, 0.0);
    for (std::size_t p = 0; p < held.packs; ++p) {
        alignas(64) double lanes[pack_width] = {};
        std::copy_n(weights.data() + held.first + p * pack_width, held.bonds_in(p), lanes);
        const Pack weight = load_pack(lanes);
        const double* rows = held.state + p * held.rows * pack_width;
        for (std::size_t at = 0; at < sums.size(); at += pack_width)
            store_pack(load_pack(&sums[at]) + weight * load_pack(rows + at), &sums[at]);
    }
    for (std::size_t r = 0; r < held.rows; ++r)
        state[r] += reduce(load_pack(&sums[r * pack_width]));
}

/// Mean of the values that a variable of the point had on its bonds after the last refresh.
double mean_of_initial(const Model& model, const EndStates& states, std::size_t point, std::span<const double> weights,
                       std::size_t row)
{
    if (!model.bonds.shared) // the same on all
        return states[point][row] * std::accumulate(weights.begin(), weights.end(), 0.0);
    const FamilyView family = model.neighbourhood.families[point];
    double mean = 0.0;
    for (std::size_t b = 0; b < family.count; ++b)
        mean += weights[b] * initial_on_bond(model.bonds, states, point, family.neighbours[b], row);
    return mean;
}

} // namespace

void mean_point_states(const Model& model, const ForceState& force_state, std::vector<double>& states)
{
    const std::vector<std::vector<std::size_t>> of_point = point_rows(model);
    const EndStates before(model.state, model.neighbourhood);
    FirstException failure;
#pragma omp parallel
    {
        std::vector<double> weights;
        AlignedVector<double> sums;
        const auto find_mean = [&](std::size_t i) {
            double* state = states.data() + i * model.state.point_states.stride;
            if (model.result.detached[i] != 0) {
                std::fill_n(state, 6, 0.0);
                return;
            }
            const FamilyView family = model.neighbourhood.families[i];
            weights.resize(family.packs * pack_width);
            force_state.bond_weights(model, i, weights);
            add_bonds_of_others(model, i, weights, state);
            add_held_bonds(model, i, weights, sums, state);
            for (const std::size_t r : of_point[model.state.points.body[i]])
                state[r] += before[i][r] - mean_of_initial(model, before, i, weights, r);
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
        const UnsetVector<double>& states = model.bonds.of_block(block);
        states_.resize(std::max(states_.size(), states.size()));
        std::copy(states.begin(), states.end(), states_.begin());
        const std::size_t first = model.neighbourhood.blocks.first_point(block);
        for (std::size_t i = first; i < model.neighbourhood.blocks.end_point(block); ++i)
            first_[i - first] = model.bonds.first(i);
    }
    const double* state(std::size_t point) const { return states_.data() + first_[point % block_size]; }

private:
    UnsetVector<double> states_;
    std::array<std::uint32_t, block_size> first_;
};

/// Sets the states of the bonds that a point holds from those that it held: `state`, of the family and the active bonds
/// before.
void hand_over(Model& model, std::size_t point, const Families& families_before, const ActiveBonds& active_before,
               const double* state, const EndStates& states)
{
    const Families& families = model.neighbourhood.families;
    const FamilyView before = families_before[point];
    const ConstHeldBonds held_before = std::as_const(model.bonds).held(before, model.rows(point), state);
    const std::size_t rows = held_before.rows;
    const double* own = states[point];
    std::size_t at = held_before.first; // both families are ordered by key
    for_held_bonds(model, point, [&](std::uint32_t j, double* bond) {
        const std::uint64_t key = families.key(j);
        while (at < before.count && families_before.key(before.neighbours[at]) < key)
            ++at;
        if (at < before.count && families_before.key(before.neighbours[at]) == key && active_before.holds(before, at)) {
            const double* old = held_before.bond(at - held_before.first);
            for (std::size_t r = 0; r < rows; ++r)
                bond[r * pack_width] = old[r * pack_width];
            return;
        }
        const double* other = states[j];
        for (std::size_t r = 0; r < rows; ++r)
            bond[r * pack_width] = 0.5 * (own[r] + other[r]);
    });
}

} // namespace

void refresh_families(Model& model, const ForceState& force_state, std::span<const ClosedPair> closed)
{
    model.gather_ends();
    std::vector<double> states = model.state.point_states.values;
    mean_point_states(model, force_state, states);
    const Families families_before = model.neighbourhood.renew(model.state, closed);
    const ActiveBonds active_before = std::move(model.result.active);
    model.result.active.assign(model.neighbourhood.families.packs(), 0);
    model.state.point_states.values.swap(states);
    const EndStates at_ends(model.state, model.neighbourhood);
    const BlockAccumulators& blocks = model.neighbourhood.blocks;
    FirstException failure;
#pragma omp parallel
    {
        BlockBefore before;
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < blocks.blocks(); ++block)
            failure.guard(block, [&] {
                before.keep(model, block);
                model.bonds.lay_out(block, model.state, model.neighbourhood);
                for (std::size_t i = blocks.first_point(block); i < blocks.end_point(block); ++i)
                    hand_over(model, i, families_before, active_before, before.state(i), at_ends);
            });
    }
    failure.rethrow();
    distribute_point_variables(model, at_ends);
    model.gather_ends();
    follow_occupied_volume(model, families_before);
}

double displacement_since_refresh(const Model& model)
{
    const std::size_t n = model.size();
    const auto moved = [&](std::size_t i) {
        return Vector3(model.state.points.position[i] - model.neighbourhood.positions[i]);
    };
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
