// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What tells two cases apart.
#pragma once

#include <string>

namespace periporo {

/// The first key of two resolved cases whose values differ, with both values: "contact.0.friction is 0.5 there and 0.4
/// here". A key that only one of them has is said to be only there or only here.
std::string case_difference(const std::string& there, const std::string& here);

} // namespace periporo
