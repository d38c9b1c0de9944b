// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Coordinate planes written as "x = 100 mm".
#pragma once

#include "case/description.hpp"

#include <string>
#include <string_view>

namespace periporo {

/// @throws std::invalid_argument saying what was not understood.
PlaneDescription parse_plane(std::string_view text);

/// "x = 0.1 m"; parse_plane reads back the very same offset.
std::string plane_text(const PlaneDescription& plane);

} // namespace periporo
