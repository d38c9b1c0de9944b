// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sizes of a model, and the way from a bond to its state.
#include "model/model.hpp"

namespace periporo {

void Model::allocate()
{
    state.reset_point_states();
    result.resize(size());
}

Model::Holder Model::holder_of(std::size_t point, std::size_t b) const
{
    const std::size_t first = held(point).first;
    if (b >= first)
        return {point, b - first};
    const Families& families = neighbourhood.families;
    const std::uint32_t neighbour = families[point].neighbours[b];
    const std::size_t opposite =
        families.opposite(static_cast<std::uint32_t>(point), neighbour, neighbourhood.isometries);
    return {neighbour, opposite - held(neighbour).first};
}

std::size_t Model::memory() const
{
    const std::size_t per_point =
        5 * sizeof(Vector3) + 6 * sizeof(double) + sizeof(std::uint32_t) + sizeof(std::int64_t) + // Points
        sizeof(Vector3) + state.point_states.stride * sizeof(double); // the positions of the neighbourhood, and states
    return size() * per_point + ends.memory() + neighbourhood.memory() + result.memory() +
           (workspace.accumulators.capacity() + workspace.end_fields.capacity()) * sizeof(double) + bonds.memory();
}

} // namespace periporo
