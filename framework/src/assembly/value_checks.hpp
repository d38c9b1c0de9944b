// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values of a case that are allowed and look like a wrong unit.
#pragma once

#include "assembly/build_model.hpp"
#include "case/refusal.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Gravity, densities, elastic moduli, stiffness of contacts and residuals that hardly any material or computation has,
/// and bodies that fall far before they touch anything.
/// @param built with the obstacles of the first stage
/// @param refusals gets what no material can have
void check_values(const BuiltModel& built, const CaseDescription& description, Refusals& refusals,
                  std::vector<std::string>& suspicions);

} // namespace periporo
