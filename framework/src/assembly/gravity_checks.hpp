// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Is there something that a body can come to rest on?
#pragma once

#include "assembly/build_model.hpp"

#include <string>
#include <vector>

namespace periporo {

/// A body that nothing holds against gravity never settles: an error in a quasi-static stage, and in a dynamic one when
/// gravity leads the body away from every surface that it is given. A body in free flight is a warning.
/// @throws CaseError with the place of the stage or of gravity
void check_gravity(const BuiltModel& built, const CaseDescription& description, std::vector<std::string>& suspicions);

} // namespace periporo
