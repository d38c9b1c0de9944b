// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What rest means in a dynamic stage.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "time/rest.hpp"

namespace periporo {

/// The rule of a stage with `rest_speed`. The scale of time is a free fall over the height that the model had at the
/// start, (2 h/|g|)^(1/2): windows are an eighth of it, and rest is believed after one when nothing drives the model. A
/// model without gravity has windows in which the rest speed makes a tenth of a spacing. In a stage in which obstacles
/// or held points move, or without gravity, rest needs a motion before it.
/// @param from when the last change of the stage is over [s]
RestRule rest_rule(const Model& model, const CaseDescription& description, const StageDescription& stage, double from);

} // namespace periporo
