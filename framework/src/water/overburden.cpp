// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Layers of a body and what they weigh.
#include "water/overburden.hpp"

#include "water/standing_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace periporo {
namespace {

constexpr double alike = 1e-9; ///< relative difference of unit weights: far above round-off, far below any water

} // namespace

Overburden::Overburden(const Model& model, std::uint32_t body)
    : model_(model), gravity_(model.state.gravity.norm()), top_(-std::numeric_limits<double>::infinity())
{
    const StandingWater water(model);
    const Points& points = model.state.points;
    double lowest = std::numeric_limits<double>::infinity();
    double lightest = std::numeric_limits<double>::infinity(), heaviest = 0.0;
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (points.body[i] != body)
            continue;
        const double height = points.position[i].dot(water.up());
        top_ = std::max(top_, height + 0.5 * model.state.spacing);
        lowest = std::min(lowest, height);
        const double density = points.mass[i] / points.initial_volume[i];
        lightest = std::min(lightest, density);
        heaviest = std::max(heaviest, density);
    }
    if (!model.state.bodies[body].has_standing_water() && heaviest - lightest <= alike * heaviest)
        return;
    const auto layer_of = [&](double height) {
        return static_cast<std::size_t>((top_ - height) / model.state.spacing);
    };
    unit_weight_.assign(layer_of(lowest) + 1, 0.0);
    std::vector<double> volume(unit_weight_.size(), 0.0);
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (points.body[i] != body)
            continue;
        const std::size_t layer = layer_of(points.position[i].dot(water.up()));
        unit_weight_[layer] += points.mass[i] * gravity_ - water.buoyancy_of(i);
        volume[layer] += points.initial_volume[i];
    }
    double above = 0.0;
    for (std::size_t layer = 0; layer < unit_weight_.size(); ++layer) {
        above_.push_back(above);
        unit_weight_[layer] = volume[layer] > 0.0 ? unit_weight_[layer] / volume[layer] : 0.0;
        above += unit_weight_[layer] * model.state.spacing;
    }
}

Overburden::Line Overburden::around(double depth, std::size_t point) const
{
    if (unit_weight_.empty())
        return {model_.state.points.mass[point] / model_.state.points.initial_volume[point] * gravity_, 0.0};
    const std::size_t layer = std::min(static_cast<std::size_t>(depth / model_.state.spacing), unit_weight_.size() - 1);
    const double top = static_cast<double>(layer) * model_.state.spacing;
    return {unit_weight_[layer], above_[layer] - unit_weight_[layer] * top};
}

} // namespace periporo
