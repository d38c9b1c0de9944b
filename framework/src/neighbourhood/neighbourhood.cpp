// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds families, and everything that follows from them.
#include "neighbourhood/neighbourhood.hpp"

#include <algorithm>
#include <utility>

namespace periporo {

Families Neighbourhood::families_of(const State& state, const Families* before, std::span<const ClosedPair> closed)
{
    std::vector<double> joining(state.bodies.size());
    std::ranges::transform(state.bodies, joining.begin(),
                           [&](const Body& one) { return one.joining_distance * state.spacing; });
    return Families::find(state.points, isometries,
                          {state.horizon, link_length(state.spacing, state.horizon), before, closed, joining});
}

void Neighbourhood::find(const State& state)
{
    families = families_of(state, nullptr, {});
    follow_families(state);
}

Families Neighbourhood::renew(const State& state, std::span<const ClosedPair> closed)
{
    Families next = families_of(state, &families, closed);
    Families before = std::exchange(families, std::move(next));
    follow_families(state);
    return before;
}

void Neighbourhood::restore(const State& state, const Families::Kept& kept)
{
    families = Families::restore(state.points, isometries, state.horizon, kept);
    follow_families(state);
}

void Neighbourhood::follow_families(const State& state)
{
    blocks.find(families);
    if (has_sub_horizons)
        sub_horizons.find(state.points, isometries, families, state.horizon);
    positions = state.points.position;
    body = state.points.body;
    body.resize(ends());
    fill_images(body);
    initial_volume = state.points.initial_volume;
    initial_volume.resize(ends());
    fill_images(initial_volume);
}

} // namespace periporo
