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

/// @throws CaseError when a parameter made by Parameter::fields() names a field that snapshots of the model do not
/// have, or one twice.
void check_fields(const CaseDescription& description, const PluginRegistry& registry, const Model& model,
                  const ForceState& force_state);

} // namespace periporo
