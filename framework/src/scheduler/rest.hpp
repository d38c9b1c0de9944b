// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// When a dynamic stage may end because nothing moves.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"

namespace periporo {

/// What is at rest after this time, with nothing changing about it, stays at rest [s]: a free fall over the height that
/// the model had at the start, (2 h/|g|)^(1/2). Infinite without gravity, and in a stage in which obstacles or held
/// points move. Obstacles must be set for the stage.
double time_to_get_going(const Model& model, const CaseDescription& description, const StageDescription& stage);

} // namespace periporo
