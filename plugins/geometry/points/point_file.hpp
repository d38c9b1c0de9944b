// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Material points as a file lists them.
#pragma once

#include "periporo/geometry.hpp"

#include <string>
#include <vector>

namespace periporo::geometry {

struct PointFile {
    std::string path;
    PointCloud points;
    std::vector<std::string> unused_columns;
    std::vector<std::size_t> lines; ///< on which the points stand in a text file, counted from 1; else empty

    /// "line 12" of a text file, or "point 10", counted from 0 as in the datasets.
    std::string place(std::size_t point) const;
    /// @throws std::runtime_error "<path>: <what>", always.
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Reads a CSV file (.csv), whose header names the columns x, y, z [m] and volume [m3] in any order, or an HDF5 file
/// (.h5, .hdf5) with the datasets "position", n x 3 [m], and "volume", n [m3].
/// @throws std::runtime_error that names the file, the line or dataset and what is wrong there. There is at least one
/// point; all numbers are finite, all volumes positive and no two points at one place.
PointFile read_points(const std::string& path);

/// The two formats, with no check of the numbers themselves.
void read_csv(PointFile& file);
void read_hdf5(PointFile& file);

} // namespace periporo::geometry
