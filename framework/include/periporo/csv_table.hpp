// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tables of numbers in text files, as plugins and cases read them.
#pragma once

#include "periporo/units.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace periporo {

/// A column that a table must have.
struct CsvColumn {
    std::string name;
    Dimension dimension;
};

/// Numbers between commas below a header that names them, in any order: "suction [kPa], saturation". A column without a
/// unit is in SI. What follows a # is a comment.
struct CsvTable {
    std::filesystem::path file;
    std::vector<std::vector<double>> columns; ///< in the order that was asked for, in SI
    std::vector<std::size_t> lines;           ///< of the file, for each row
    std::vector<std::string> unused;          ///< headings of the columns that were passed over

    std::size_t rows() const { return lines.size(); }
    /// "curve.csv: line 3", for messages.
    std::string place(std::size_t row) const;
};

/// @throws std::runtime_error that names file, line and column, when it cannot be read, a column is missing or twice
/// there, a unit is not one of its dimension, or a cell is no finite number
CsvTable read_csv_table(const std::filesystem::path& file, const std::vector<CsvColumn>& columns);

} // namespace periporo
