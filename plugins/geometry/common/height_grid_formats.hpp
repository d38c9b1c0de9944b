// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Readers of the formats of height grids, for read_height_grid().
#pragma once

#include "height_grid.hpp"

#include <limits>
#include <string>

namespace periporo::geometry {

/// Stands for the height where a file has none.
inline constexpr double no_data = std::numeric_limits<double>::quiet_NaN();

/// Fill in the grid of `grid.path` from the content of that file.
void read_esri_grid(HeightGrid& grid, const std::string& content);
void read_csv_grid(HeightGrid& grid, const std::string& content);

} // namespace periporo::geometry
