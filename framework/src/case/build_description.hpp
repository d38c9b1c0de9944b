// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From checked tables to the description that the rest of the program knows.
#pragma once

#include "case/checker.hpp"
#include "case/description.hpp"

namespace periporo {

/// Only for a case without errors. Every value that the rules declare is asked for here.
CaseDescription build_description(const CheckedTable& root);

} // namespace periporo
