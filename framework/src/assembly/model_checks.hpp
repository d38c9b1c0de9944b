// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at a model that is built for what would surely go wrong in a run, and for what is suspicious.
#pragma once

#include "assembly/build_model.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Points that coincide, bodies in one another, bodies below a surface that they touch, planes of images within bodies,
/// gravity that nothing resists, stages in which nothing happens, values that look like a wrong unit, no output.
/// @param built with the obstacles of the first stage
/// @param geometries of the case
/// @return what is suspicious, a warning each with its place
/// @throws CaseError with all for which a run would go wrong
std::vector<std::string> check_model(const BuiltModel& built, const CaseDescription& description,
                                     Geometries& geometries);

} // namespace periporo
