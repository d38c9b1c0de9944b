// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A contact law in its place.
#pragma once

#include "periporo/contact.hpp"

namespace periporo {

/// Scales a contact law to where it acts.
/// @param between_surfaces does the case name an obstacle, or a body whose surface is touched?
/// @throws std::runtime_error when the law cannot act there
void fit_contact(Contact& law, double spacing, double horizon, bool between_surfaces);

} // namespace periporo
