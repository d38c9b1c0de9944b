// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes a checked case as TOML that reproduces the run by itself.
#pragma once

#include "case/checker.hpp"

#include <string>

namespace periporo {

/// The whole case with all defaults, includes and overrides filled in, in SI units; reads back to the same values, to
/// the last bit. Only for a case without errors.
std::string resolved_text(const CheckedTable& root);

/// A value as TOML, numbers so that they read back to the last bit.
std::string toml_text(const ParameterValue& value);

} // namespace periporo
