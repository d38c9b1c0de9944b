// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Are the fields that writers are told to store there?
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "plugins/registry.hpp"

namespace periporo {

/// @throws CaseError with every field that a parameter made by Parameter::fields() names and snapshots of the model do
/// not have, or that it names twice.
void check_fields(const CaseDescription& description, const PluginRegistry& registry, const Model& model,
                  const ForceState& force_state);

} // namespace periporo
