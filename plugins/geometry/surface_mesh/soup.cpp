// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cleans and turns the facets of a file, by CGAL where it can name them.
#include "soup.hpp"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace periporo::geometry {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;

using Polygon = std::vector<std::size_t>;

/// Takes out corners that follow themselves.
void remove_repeated_corners(Polygon& polygon)
{
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    while (polygon.size() > 1 && polygon.front() == polygon.back())
        polygon.pop_back();
}

bool comes_twice_through_a_corner(Polygon polygon)
{
    std::sort(polygon.begin(), polygon.end());
    return std::adjacent_find(polygon.begin(), polygon.end()) != polygon.end();
}

/// The corners from the least on, in the direction of its lesser neighbour: the same for polygons that cover each
/// other.
Polygon canonical(Polygon polygon)
{
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    if (polygon.back() < polygon[1])
        std::reverse(polygon.begin() + 1, polygon.end());
    return polygon;
}

/// What CGAL tells while it turns polygons.
struct Turning {
    std::optional<std::pair<std::size_t, std::size_t>> edge_of_many; ///< the first edge with more than two polygons
    std::optional<std::size_t> touching_corner;                      ///< the first
    std::vector<std::size_t> touching;                               ///< a polygon of each part that meets there
    std::vector<bool> reversed;
};

struct TurningVisitor : processing::Default_orientation_visitor {
    explicit TurningVisitor(Turning& turning) : turning(&turning) {}

    void non_manifold_edge(std::size_t a, std::size_t b, std::size_t)
    {
        if (!turning->edge_of_many)
            turning->edge_of_many = {a, b};
    }
    void polygon_orientation_reversed(std::size_t polygon) { turning->reversed[polygon].flip(); }
    void link_connected_polygons(std::size_t corner, const std::vector<std::size_t>& polygons)
    {
        if (!turning->touching_corner)
            turning->touching_corner = corner;
        if (corner == *turning->touching_corner)
            turning->touching.push_back(polygons.front());
    }

    Turning* turning; // CGAL copies its visitors
};

} // namespace

Soup::Soup(const FacetFile& file) : file_(file), points_(file.points), polygons_(file.polygons)
{
    if (const std::size_t count = processing::merge_duplicate_points_in_polygon_soup(points_, polygons_))
        remarks_.push_back(fmt::format("duplicate points merged: {}", count));
    keep_facets();
    if (const std::size_t count = processing::remove_isolated_points_in_polygon_soup(points_, polygons_))
        remarks_.push_back(fmt::format("points of no facet left out: {}", count));
}

void Soup::keep_facets()
{
    std::set<Polygon> seen;
    std::size_t degenerate = 0;
    std::size_t duplicate = 0;
    std::vector<Polygon> kept;
    for (std::size_t index = 0; index < polygons_.size(); ++index) {
        Polygon& polygon = polygons_[index];
        remove_repeated_corners(polygon);
        if (polygon.size() < 3) {
            ++degenerate;
            continue;
        }
        if (comes_twice_through_a_corner(polygon))
            file_.refuse(file_.facet(index) + " comes twice through one of its corners; divide it into triangles");
        if (!seen.insert(canonical(polygon)).second) {
            ++duplicate;
            continue;
        }
        facets_.push_back(index);
        kept.push_back(std::move(polygon));
    }
    polygons_ = std::move(kept);
    if (degenerate > 0)
        remarks_.push_back(fmt::format("facets with fewer than three different corners removed: {}", degenerate));
    if (duplicate > 0)
        remarks_.push_back(fmt::format("facets listed before removed: {}", duplicate));
}

void Soup::turn_alike()
{
    Turning turning;
    turning.reversed.assign(polygons_.size(), false);
    processing::orient_polygon_soup(points_, polygons_, CGAL::parameters::visitor(TurningVisitor(turning)));
    if (turning.edge_of_many)
        refuse_edge(turning.edge_of_many->first, turning.edge_of_many->second);
    reversed_ = std::move(turning.reversed);
    touching_ = std::move(turning.touching);
}

void Soup::refuse_edge(std::size_t a, std::size_t b) const
{
    const auto is_end = [&](std::size_t corner) {
        return points_[corner] == points_[a] || points_[corner] == points_[b];
    };
    std::vector<std::size_t> numbers;
    for (std::size_t index = 0; index < polygons_.size(); ++index)
        if (std::count_if(polygons_[index].begin(), polygons_[index].end(), is_end) == 2)
            numbers.push_back(facets_[index] + 1);
    file_.refuse(fmt::format("the edge from {} to {} belongs to more than two facets: {}. Where two bodies touch they "
                             "must be parted, or joined to one without a wall between them",
                             coordinates(points_[a]), coordinates(points_[b]), fmt::join(numbers, ", ")));
}

void Soup::refuse_touching_corner() const
{
    if (touching_.size() < 2)
        return;
    file_.refuse(fmt::format("{} and {} touch in a corner but lead around it on different parts of the surface; part "
                             "them, or join the two parts",
                             file_.facet(facets_[touching_[0]]), file_.facet(facets_[touching_[1]])));
}

} // namespace periporo::geometry
