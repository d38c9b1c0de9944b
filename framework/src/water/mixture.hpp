// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Grains, pores and water of a point: porosity and density.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"

#include <cstddef>

namespace periporo {

inline constexpr double water_density = 1000.0; ///< rho_w [kg/m3]

/// rho = rho_s (1 - phi0) + S_r phi0 rho_w [kg/m3].
double mixture_density(const MaterialDescription& material, double saturation);

/// phi = 1 - (1 - phi0) V0/V: the grains of a point stay [-].
double porosity_of(const Model& model, std::size_t point);

} // namespace periporo
