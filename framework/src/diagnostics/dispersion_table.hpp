// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dispersion of plane waves in the lattice of a case, for every force state and influence function.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <string>

namespace periporo {

/// CSV with a head line: force_state, influence, direction ("100", "110", "111"), wave ("P", "S"), |k| dx [-], phase
/// speed over that of the continuum [-]; for spacing, horizon, material and density of the first body of the case.
/// @param cells points of a curve, up to the corner of the zone
std::string dispersion_table(const CaseDescription& description, const PluginRegistry& registry, int cells);

} // namespace periporo
