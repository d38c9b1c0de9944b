// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Heights of a terrain over a rectangular grid, as a file lists them: ESRI ASCII grid or CSV.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace periporo::geometry {

/// Heights at the crossings of grid lines. The lines need not be equally far apart.
struct HeightGrid {
    std::string path;
    std::vector<double> x;       ///< of the columns, from west to east [m]
    std::vector<double> y;       ///< of the rows, from south to north [m]
    std::vector<double> height;  ///< row by row from the south; not a number where the file has no data [m]
    std::size_t columns_cut = 0; ///< columns of the file west of the first one here
    std::size_t rows_cut = 0;    ///< rows of the file north of the last one here

    std::size_t columns() const { return x.size(); }
    std::size_t rows() const { return y.size(); }
    double at(std::size_t column, std::size_t row) const { return height[row * columns() + column]; }
    /// "row 3, column 5 (x = 12.5, y = 40)", counted from 1 and rows from the north, as an ESRI file lists them.
    std::string place(std::size_t column, std::size_t row) const;
    /// @throws std::runtime_error "<path>: <what>", always.
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Reads an ESRI ASCII grid (.asc), whose heights stand for the centres of its cells, or a CSV file (.csv) with columns
/// x, y and z, a line for every crossing of the grid lines in any order. Without a height are the NODATA_value of the
/// first, -9999 unless it says otherwise, and "nan" or nothing in the second.
/// @throws std::runtime_error that names the file, and the line or the row and column, and what is wrong there.
HeightGrid read_height_grid(const std::string& path);

/// The rectangle [x0, y0, x1, y1] of a grid, all four on grid lines within a millionth of their distance.
/// @throws std::runtime_error with the nearest grid line otherwise.
HeightGrid cut(const HeightGrid& grid, const std::array<double, 4>& extent);

/// @throws std::runtime_error when the grid lines of two grids differ by more than a millionth of their distance.
void require_same_lines(const HeightGrid& a, const HeightGrid& b);

} // namespace periporo::geometry
