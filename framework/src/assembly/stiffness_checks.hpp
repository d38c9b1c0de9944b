// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies whose bonds carry no stress from the start.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"

#include <string>
#include <vector>

namespace periporo {

/// Suspicions about bodies of several points most of whose bonds are inactive: such a body has next to no stiffness.
/// @param model after an evaluation
std::vector<std::string> check_stiffness(const Model& model, const CaseDescription& description);

} // namespace periporo
