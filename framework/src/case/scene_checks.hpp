// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of what names what in a case: geometries, bodies, obstacles, stages.
#pragma once

#include "case/checker.hpp"
#include "case/diagnostics.hpp"

namespace periporo {

/// Contacts between bodies and obstacles, regions of points, obstacles' stages, bodies whose water changes, and
/// geometries made of others.
void check_scene(const CheckedTable& root, Diagnostics& diagnostics);

} // namespace periporo
