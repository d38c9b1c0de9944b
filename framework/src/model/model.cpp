// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "model/model.hpp"

#include <algorithm>
#include <utility>

namespace periporo {

void Model::allocate()
{
    const std::size_t n = size();
    state_stride = 0;
    for (const Body& body : bodies)
        state_stride = std::max(state_stride, body.rows());
    point_state.assign(n * state_stride, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::vector<StateVariable>& variables = body_of(i).material->state_variables();
        for (std::size_t s = 0; s < variables.size(); ++s)
            point_state[i * state_stride + 6 + s] = variables[s].initial;
    }
    internal_force.assign(n, Vector3::Zero());
    volume_rate.assign(n, 0.0);
    stress_work.assign(n, 0.0);
    inactive_bonds.assign(n, 0);
    free_grain.assign(n, 0);
}

Families Model::families_now(const Families* before, std::span<const ClosedPair> closed)
{
    std::vector<double> joining(bodies.size());
    std::ranges::transform(bodies, joining.begin(),
                           [this](const Body& body) { return body.joining_distance * spacing; });
    return Families::find(points, isometries, {horizon, link_length(spacing, horizon), before, closed, joining});
}

void Model::find_families()
{
    families = families_now(nullptr, {});
    follow_families();
}

Model::Replaced Model::renew_families(std::span<const ClosedPair> closed)
{
    Families next = families_now(&families, closed);
    Replaced replaced{std::exchange(families, std::move(next)), std::exchange(bonds.active, {})};
    follow_families();
    return replaced;
}

void Model::restore_families(const Families::Kept& kept)
{
    families = Families::restore(points, isometries, horizon, kept);
    follow_families();
}

void Model::follow_families()
{
    halos.find(families);
    if (has_sub_horizons)
        sub_horizons.find(points, isometries, families, horizon);
    bonds.active.assign(families.packs(), 0);
    refresh_position = points.position;
}

Model::Holder Model::holder_of(std::size_t point, std::size_t b) const
{
    const std::size_t first = held(point).first;
    if (b >= first)
        return {point, b - first};
    const std::uint32_t neighbour = families[point].neighbours[b];
    const std::size_t opposite = families.opposite(static_cast<std::uint32_t>(point), neighbour, isometries);
    return {neighbour, opposite - held(neighbour).first};
}

void Model::lay_out_bonds(std::size_t block)
{
    std::size_t values = 0;
    for (std::size_t i = halos.first_point(block); i < halos.end_point(block); ++i) {
        bonds.first[i] = static_cast<std::uint32_t>(values);
        values += held_bonds<double>(i, families[i], nullptr).values();
    }
    UnsetVector<double>& states = bonds.states[block];
    states.clear(); // nothing of them is to be moved
    if (values > states.capacity())
        states.reserve(values + values / 16); // families grow and shrink a little from one refresh to the next
    states.resize(values);
}

std::size_t BondData::memory() const
{
    std::size_t bytes = first.capacity() * sizeof(std::uint32_t) + active.capacity();
    for (const UnsetVector<double>& block : states)
        bytes += sizeof(block) + block.capacity() * sizeof(double);
    return bytes;
}

void Model::update_records()
{
    const std::size_t n = size();
    const std::vector<Image>& images = families.images();
    records.resize(n + images.size());
    const auto store = [this](std::size_t record, const Vector3& x, const Vector3& v, double volume) {
        records[record] = {{x.x(), x.y(), x.z()}, volume, {v.x(), v.y(), v.z()}, 0.0};
    };
    bool some_water = false;
#pragma omp parallel for schedule(static) reduction(|| : some_water)
    for (std::size_t i = 0; i < n; ++i) {
        store(i, points.position[i], points.velocity[i], points.volume[i]);
        some_water = some_water || points.pore_pressure[i] != 0.0 || points.saturation[i] != 0.0;
    }
    wet = some_water;
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < images.size(); ++m) {
        const Isometry& isometry = isometries[images[m].isometry];
        const std::uint32_t p = images[m].parent;
        store(n + m, isometry.point(points.position[p]), isometry.direction(points.velocity[p]), points.volume[p]);
    }
}

std::size_t Model::memory() const
{
    const std::size_t per_point =
        5 * sizeof(Vector3) + 6 * sizeof(double) + sizeof(std::uint32_t) + sizeof(std::int64_t) + // Points
        2 * sizeof(Vector3) + 2 * sizeof(double) + sizeof(std::uint32_t) + 1 + state_stride * sizeof(double);
    return size() * per_point + records.capacity() * sizeof(NeighbourRecord) + families.memory() +
           sub_horizons.memory() + halos.memory() + (at_places.capacity() + lent.capacity()) * sizeof(double) +
           bonds.memory();
}

} // namespace periporo
