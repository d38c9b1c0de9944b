// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values of the command line laid over a case: "body.soil.material=sand".
#pragma once

#include "case/diagnostics.hpp"
#include "case/node.hpp"
#include "case/schema.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Applies the overrides in order. The path leads through tables by key and through lists by number from 0 or by the
/// `name` of an entry; the value is a TOML value, or text as it stands. Only new keys can be made this way, no new
/// materials, bodies or entries of lists. Whether a key exists at all is checked later, with the case.
void apply_overrides(CaseNode& root, const std::vector<std::string>& overrides, const TableRules& rules,
                     Diagnostics& diagnostics);

} // namespace periporo
