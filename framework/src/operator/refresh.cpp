// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/refresh.hpp"

#include <algorithm>
#include <cmath>
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

bool active(const BondData& bonds, std::size_t slot)
{
    return (bonds.active[slot / pack_width] >> slot % pack_width & 1u) != 0;
}

/// First of the rows of bond b of a point; rows are pack_width apart.
template <class Bonds>
auto* bond_rows(Bonds& bonds, std::size_t point, std::size_t rows, std::size_t b)
{
    return bonds.state.data() + bonds.first[point] + b / pack_width * rows * pack_width + b % pack_width;
}

} // namespace

void allocate_bonds(Model& model)
{
    const std::size_t n = model.size();
    BondData& bonds = model.bonds;
    bonds.first.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        bonds.first[i + 1] = bonds.first[i] + model.families[i].packs * model.rows(i) * pack_width;
    bonds.state.resize(bonds.first[n]);
    bonds.force_state.resize(model.families.packs() * 3 * pack_width);
    bonds.active.resize(model.families.packs());
    model.refresh_position = model.points.position;
}

void find_first_families(Model& model)
{
    model.families = Families::find(model.points, model.isometries, model.horizon);
    allocate_bonds(model);
    std::fill(model.bonds.active.begin(), model.bonds.active.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.families[i].packs * pack_width; ++b)
            for (std::size_t r = 0; r < model.rows(i); ++r)
                bond_rows(model.bonds, i, model.rows(i), b)[r * pack_width] =
                    model.point_state[i * model.state_stride + r];
    model.update_records();
}

void mean_point_states(const Model& model, const ForceState& force_state, std::vector<double>& states)
{
#pragma omp parallel
    {
        std::vector<double> shares;
#pragma omp for schedule(dynamic, 64)
        for (std::size_t i = 0; i < model.size(); ++i) {
            double* state = states.data() + i * model.state_stride;
            if (model.free_grain[i] != 0) {
                std::fill_n(state, 6, 0.0);
                continue;
            }
            const FamilyView family = model.families[i];
            const std::size_t rows = model.rows(i);
            shares.resize(family.packs * pack_width);
            force_state.shares(model, i, shares);
            std::fill_n(state, rows, 0.0);
            for (std::size_t b = 0; b < family.count; ++b) {
                const double* bond = bond_rows(model.bonds, i, rows, b);
                for (std::size_t r = 0; r < rows; ++r)
                    state[r] += shares[b] * bond[r * pack_width];
            }
        }
    }
}

void refresh_families(Model& model, const ForceState& force_state)
{
    model.update_records();
    mean_point_states(model, force_state, model.point_state);
    const Families old_families =
        std::exchange(model.families, Families::find(model.points, model.isometries, model.horizon));
    BondData old_bonds = std::exchange(model.bonds, BondData{});
    allocate_bonds(model);
#pragma omp parallel
    {
        std::vector<double> seen(model.state_stride);
#pragma omp for schedule(dynamic, 64)
        for (std::size_t i = 0; i < model.size(); ++i) {
            const FamilyView before = old_families[i];
            const FamilyView now = model.families[i];
            const std::size_t rows = model.rows(i);
            const double* own = model.point_state.data() + i * model.state_stride;
            std::size_t at = 0; // both families are ordered by key
            for (std::size_t b = 0; b < now.packs * pack_width; ++b) {
                double* bond = bond_rows(model.bonds, i, rows, b);
                const std::uint32_t j = now.neighbours[b];
                if (b < now.count) {
                    while (at < before.count && old_families.key(before.neighbours[at]) < model.families.key(j))
                        ++at;
                    if (at < before.count && old_families.key(before.neighbours[at]) == model.families.key(j) &&
                        active(old_bonds, before.first_pack * pack_width + at)) {
                        const double* old = bond_rows(old_bonds, i, rows, at);
                        for (std::size_t r = 0; r < rows; ++r)
                            bond[r * pack_width] = old[r * pack_width];
                        continue;
                    }
                }
                const double* other = model.point_state.data() + model.families.parent(j) * model.state_stride;
                if (const std::uint32_t isometry = model.families.isometry(j); isometry != 0) {
                    point_state_seen_as(model.isometries[isometry], other, rows, seen.data());
                    other = seen.data();
                }
                for (std::size_t r = 0; r < rows; ++r)
                    bond[r * pack_width] = 0.5 * (own[r] + other[r]);
            }
        }
    }
    model.update_records();
}

double displacement_since_refresh(const Model& model)
{
    const std::size_t n = model.size();
    Vector3 mean = Vector3::Zero();
    for (std::size_t i = 0; i < n; ++i)
        mean += model.points.position[i] - model.refresh_position[i];
    mean /= static_cast<double>(std::max<std::size_t>(n, 1));
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        largest = std::max(largest, (model.points.position[i] - model.refresh_position[i] - mean).squaredNorm());
    return std::sqrt(largest);
}

} // namespace periporo
