// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The facets of a surface as a file lists them: STL, OFF, PLY or OBJ.
#pragma once

#include "common/triangle_mesh.hpp"

#include <string>
#include <vector>

namespace periporo::geometry {

/// "(x, y, z)"
std::string coordinates(const MeshPoint& point);

/// Polygons by the indices of their corners. A file numbers its facets from 1, here they count from 0.
struct FacetFile {
    std::string path;
    std::vector<MeshPoint> points;
    std::vector<std::vector<std::size_t>> polygons;

    /// "facet 12 with the corners (0, 0, 0), (1, 0, 0), (0, 1, 0)", as numbered and with the coordinates of the file.
    std::string facet(std::size_t index) const;
    /// @throws std::runtime_error "<path>: <what>", always.
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Reads a file by CGAL; the ending of its name tells the format.
/// @throws std::runtime_error that names the file, and where it can the facet, when the file is unreadable or empty, a
/// facet has fewer than three corners or one that is not listed, or a coordinate is not a finite number.
FacetFile read_facets(const std::string& path);

} // namespace periporo::geometry
