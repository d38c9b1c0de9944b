// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the facets of a file to the closed surface of a body: what is repaired and what is refused.
#pragma once

#include "facet_file.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace periporo::geometry {

/// Where a triangle of a surface comes from.
struct Origin {
    static constexpr std::size_t repair = std::numeric_limits<std::size_t>::max();

    std::size_t facet = repair; ///< of the file; `repair` when a repair made the triangle
    bool reversed = false;      ///< its corners run the other way round than in the file
};

/// The facets of a file, joined. Every step says in `remarks` what it repaired, and throws std::runtime_error that
/// names the file, the facet and the reason where it cannot.
class Surface {
public:
    /// Joins the facets to a closed surface of triangles that face alike. Repaired are points listed twice or never,
    /// facets that are degenerate or listed twice or face the other way, and polygons, which become triangles. Refused
    /// are open surfaces, surfaces that touch themselves in an edge or a corner, and those with one side only.
    explicit Surface(FacetFile file);
    Surface(Surface&&) = default;
    Surface(const Surface&) = delete; // a copy's origins would be those of the original's triangles
    Surface& operator=(Surface&&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// Moves the corners from the coordinates of the file to their places.
    void place(const std::function<Vector3(const Vector3&)>& placed);
    /// Turns the surface so that it faces away from the body within. A closed part inside another is a cavity, which it
    /// must say by facing the other way.
    /// @throws also when facets cross or touch outside their common edges and corners.
    void bound_body();

    const std::vector<std::string>& remarks() const { return remarks_; }
    /// Hands the triangles over.
    Mesh release() &&;

private:
    void refuse_holes() const;
    void divide_polygons();
    void remove_degenerate_triangles();
    void refuse_intersections() const;
    std::string facet(Mesh::Face_index face) const;

    FacetFile file_;
    Mesh mesh_;
    Mesh::Property_map<Mesh::Face_index, Origin> origins_;
    std::vector<std::string> remarks_;
};

} // namespace periporo::geometry
