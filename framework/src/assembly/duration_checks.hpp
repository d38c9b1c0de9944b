// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Do stages, snapshots and the time step fit one another?
#pragma once

#include "case/description.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Warnings of runs without an end in sight, stages shorter than a step or without an effect, and output that lies
/// outside of the run.
/// @param step about that of dynamic stages [s]
std::vector<std::string> check_durations(const CaseDescription& description, double step);

} // namespace periporo
