// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A case in plain words, before it runs.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <string>

namespace periporo {

/// The case in plain words: bodies, points, families, stages, stable step, memory and the work ahead.
/// @throws CaseError, PluginError as a run of the case would
std::string explain_case(const CaseDescription& description, const PluginRegistry& registry);

} // namespace periporo
