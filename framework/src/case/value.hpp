// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From one written value to the checked value of a parameter record.
#pragma once

#include "case/diagnostics.hpp"
#include "case/node.hpp"
#include "periporo/parameters.hpp"

#include <optional>
#include <string>

namespace periporo {

/// The value in SI, or nothing and an error in `diagnostics` when type, unit or range do not fit.
std::optional<ParameterValue> read_value(const CaseNode& node, const Parameter& parameter, Diagnostics& diagnostics);

/// "Elastic bulk modulus K (Pa, > 0)": documentation, unit or type, and range.
std::string describe(const Parameter& parameter);

/// "Pa", "whole number", "text", "3 x m": what kind of value a parameter takes.
std::string type_text(const Parameter& parameter);

} // namespace periporo
