// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of rigid surfaces: thin obstacles inside bodies, and planes that repeat or hide each other.
#pragma once

#include "assembly/build_model.hpp"
#include "case/description.hpp"
#include "case/refusal.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Refuses two contacts of one body with the same surface. Warns of an obstacle between neighbouring points of a body,
/// and of a plane behind another one.
/// @param suspicions receives the warnings
void check_rigid_surfaces(const BuiltModel& built, const CaseDescription& description, Refusals& refusals,
                          std::vector<std::string>& suspicions);

} // namespace periporo
