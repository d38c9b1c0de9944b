// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Porosity and density of the mixture of grains and water.
#include "water/mixture.hpp"

#include <algorithm>

namespace periporo {

double mixture_density(const MaterialDescription& material, double saturation)
{
    return material.grain_density * (1.0 - material.porosity) + saturation * material.porosity * water_density;
}

double porosity_of(const Model& model, std::size_t point)
{
    const double ratio = model.state.points.volume[point] / model.state.points.initial_volume[point];
    return std::max(0.0, 1.0 - (1.0 - model.body_of(point).porosity) / ratio);
}

} // namespace periporo
