// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From a checked path to its description.
#pragma once

#include "case/checker.hpp"
#include "drive/path_description.hpp"

namespace periporo {

/// Reads every key that the rules of a path declare. Only for a path without errors.
PathDescription build_path(const CheckedTable& root);

} // namespace periporo
