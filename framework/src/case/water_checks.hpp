// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of the water of bodies, at the start and in the stages.
#pragma once

#include "case/checker.hpp"

namespace periporo {

void check_water(const CheckedTable& root, Diagnostics& diagnostics);

} // namespace periporo
