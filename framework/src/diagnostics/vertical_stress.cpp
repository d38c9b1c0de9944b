// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "diagnostics/vertical_stress.hpp"

#include "operator/refresh.hpp"
#include "water/overburden.hpp"
#include "water/pore_stress.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

namespace periporo {
namespace {

constexpr double same_section = 0.05; ///< counts of points of two layers that differ by less are of one cross-section

} // namespace

std::optional<VerticalStress> vertical_stress(const Model& model, const ForceState& force_state, std::uint32_t body)
{
    const double g = model.state.gravity.norm();
    if (g <= 0.0)
        return std::nullopt;
    const Vector3 up = -model.state.gravity / g;
    std::vector<double> states = model.state.point_states.values;
    mean_point_states(model, force_state, states);
    const Overburden overburden(model, body);
    struct Sums {
        double stress = 0.0, expected = 0.0, depth = 0.0, count = 0.0;
    };
    std::map<long, Sums> layers;
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (model.state.points.body[i] != body)
            continue;
        const double* s = states.data() + i * model.state.point_states.stride;
        Eigen::Matrix3d stress;
        stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        const double depth = overburden.top() - model.state.points.position[i].dot(up);
        Sums& layer = layers[std::lround(std::floor(depth / model.state.spacing))];
        layer.stress +=
            up.dot(stress * up) + pore_stress(model.state.points.suction(i), model.state.points.saturation[i]);
        layer.expected -= overburden.at(depth, i);
        layer.depth += depth;
        layer.count += 1.0;
    }
    // the topmost may be a part of a cell
    const auto [narrowest, widest] =
        std::minmax_element(layers.size() > 1 ? std::next(layers.begin()) : layers.begin(), layers.end(),
                            [](const auto& a, const auto& b) { return a.second.count < b.second.count; });
    if (narrowest->second.count < (1.0 - same_section) * widest->second.count)
        return std::nullopt;
    VerticalStress profile;
    for (const auto& [index, layer] : layers)
        profile.layers.push_back({layer.depth / layer.count, layer.stress / layer.count, layer.expected / layer.count});
    double deepest = 0.0;
    for (const VerticalStress::Layer& layer : profile.layers)
        deepest = std::max(deepest, std::abs(layer.expected));
    const double bottom = profile.layers.back().depth;
    for (const VerticalStress::Layer& layer : profile.layers) {
        const double deviation = std::abs(layer.stress - layer.expected) / deepest;
        profile.largest_deviation = std::max(profile.largest_deviation, deviation);
        if (layer.depth > model.state.horizon && layer.depth < bottom - model.state.horizon)
            profile.inner_deviation = std::max(profile.inner_deviation, deviation);
    }
    return profile;
}

nlohmann::json to_json(const VerticalStress& profile)
{
    nlohmann::json layers = nlohmann::json::array();
    for (const VerticalStress::Layer& layer : profile.layers)
        layers.push_back({layer.depth, layer.stress, layer.expected});
    return {{"columns", {"depth [m]", "vertical stress, effective + S_r s [Pa]", "-(weight - buoyancy above) [Pa]"}},
            {"layers", layers},
            {"largest_deviation", profile.largest_deviation},
            {"inner_deviation", profile.inner_deviation}};
}

} // namespace periporo
