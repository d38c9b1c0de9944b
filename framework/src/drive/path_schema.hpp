// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shape of the file of a path as data, in the terms of the case reader.
#pragma once

#include "case/schema.hpp"
#include "periporo/material.hpp"

namespace periporo {

/// Rules of a whole path. Its [plugins] and [material.NAME] are those of a case, but for what only a body needs.
/// @param state_variables of the material, which [initial.state] may set.
TableRules path_rules(const std::vector<StateVariable>& state_variables);

} // namespace periporo
