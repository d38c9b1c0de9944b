// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Do the planes that make images lie where bodies end?
#pragma once

#include "assembly/build_model.hpp"
#include "case/refusal.hpp"

#include <string>
#include <vector>

namespace periporo {

/// A symmetry plane or a plane roller mirrors the points, so that the first ones lie half a spacing from it; a periodic
/// pair shifts them. A plane may cut a body that is its own mirror image, and a pair a body that fills the cell: images
/// stand for what is cut away. Any other body must end at the plane.
/// @param refusals gets the planes that do not, and points so near to a plane that their images take their place
/// @param suspicions gets points that are nearer than they should be
void check_planes(const BuiltModel& built, const CaseDescription& description, Geometries& geometries,
                  Refusals& refusals, std::vector<std::string>& suspicions);

} // namespace periporo
