// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Names of the components that come with the framework and not from plugins. The folders that make them define these
// functions, so that whoever reads a case knows the names and needs nothing else of the components.
#pragma once

#include <string>
#include <vector>

namespace periporo {

/// "energy_conjugate", "energy_conjugate_mean", "volume_weighted", "bond_projection", "unstabilized": see
/// make_force_state().
const std::vector<std::string>& force_state_names();

/// "constant", "linear", "quadratic", "gaussian", "cubic_b_spline", "inverse_distance": see Influence.
const std::vector<std::string>& influence_names();

} // namespace periporo
