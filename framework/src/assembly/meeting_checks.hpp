// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that touch from the start and that no contact keeps apart.
#pragma once

#include "assembly/build_model.hpp"
#include "case/description.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Suspicions about pairs of bodies whose points lie side by side and that no contact names together.
std::vector<std::string> check_meetings(const BuiltModel& built, const CaseDescription& description);

} // namespace periporo
