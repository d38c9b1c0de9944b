// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The facets of a file as a soup of polygons: cleaned, and turned to face alike.
#pragma once

#include "facet_file.hpp"

#include <string>
#include <vector>

namespace periporo::geometry {

/// Polygons that know their facets but not yet their neighbours.
class Soup {
public:
    /// Merges points with the same coordinates, and leaves out what bounds nothing: points of no facet, facets with
    /// fewer than three different corners, facets listed before.
    /// @throws std::runtime_error when a facet comes twice through one of its corners.
    explicit Soup(const FacetFile& file);

    /// Turns facets until all neighbours face alike.
    /// @throws std::runtime_error when an edge has more than two facets.
    void turn_alike();
    /// @throws std::runtime_error when turn_alike() met a corner where the surface touches itself.
    void refuse_touching_corner() const;

    const std::vector<MeshPoint>& points() const { return points_; }
    const std::vector<std::vector<std::size_t>>& polygons() const { return polygons_; }
    std::size_t facet(std::size_t polygon) const { return facets_[polygon]; }
    bool reversed(std::size_t polygon) const { return reversed_[polygon]; }
    const std::vector<std::string>& remarks() const { return remarks_; }

private:
    void keep_facets();
    [[noreturn]] void refuse_edge(std::size_t a, std::size_t b) const;

    const FacetFile& file_;
    std::vector<MeshPoint> points_;
    std::vector<std::vector<std::size_t>> polygons_;
    std::vector<std::size_t> facets_; ///< of the file, for each polygon
    std::vector<bool> reversed_;
    std::vector<std::size_t> touching_; ///< polygons that have a corner in common and no edges that lead around it
    std::vector<std::string> remarks_;
};

} // namespace periporo::geometry
