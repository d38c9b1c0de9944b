// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What no single key of a path can tell: whether its targets, durations and water fit together.
#pragma once

#include "case/checker.hpp"

namespace periporo {

/// Reports stages with no target or two, rates of nothing, water that contradicts itself and the like.
void check_path(const CheckedTable& root, Diagnostics& diagnostics);

} // namespace periporo
