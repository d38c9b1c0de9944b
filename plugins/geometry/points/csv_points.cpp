// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Material points from text with commas.
#include "periporo/csv_table.hpp"
#include "point_file.hpp"

namespace periporo::geometry {

void read_csv(PointFile& file)
{
    const CsvTable table = read_csv_table(
        file.path,
        {{"x", dimension::length}, {"y", dimension::length}, {"z", dimension::length}, {"volume", dimension::volume}});
    for (std::size_t row = 0; row < table.rows(); ++row)
        file.points.positions.emplace_back(table.columns[0][row], table.columns[1][row], table.columns[2][row]);
    file.points.volumes = table.columns[3];
    file.lines = table.lines;
    file.unused_columns = table.unused;
}

} // namespace periporo::geometry
