// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Joins the facets of a file to a closed surface, by CGAL.
#include "surface.hpp"

#include "soup.hpp"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace periporo::geometry {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;

using OriginMap = Mesh::Property_map<Mesh::Face_index, Origin>;

/// Hands the origin of a polygon to the triangles it is divided into. CGAL copies its visitors.
struct InheritOrigin : processing::Triangulate_faces::Default_visitor<Mesh> {
    InheritOrigin(OriginMap& origins, Origin& parent) : origins(&origins), parent(&parent) {}

    void before_subface_creations(Mesh::Face_index polygon) { *parent = (*origins)[polygon]; }
    void after_subface_created(Mesh::Face_index triangle) { (*origins)[triangle] = *parent; }

    OriginMap* origins;
    Origin* parent;
};

/// Two edges of the border between the same corners are one edge that CGAL cut, because the facets on its two sides
/// could not be made to face alike.
bool is_cut(const Mesh& mesh, const std::vector<Mesh::Halfedge_index>& border)
{
    std::set<std::pair<MeshPoint, MeshPoint>> seen;
    return std::any_of(border.begin(), border.end(), [&](Mesh::Halfedge_index edge) {
        return !seen.insert(std::minmax(mesh.point(mesh.source(edge)), mesh.point(mesh.target(edge)))).second;
    });
}

std::vector<Mesh::Face_index> degenerate_triangles(const Mesh& mesh)
{
    std::vector<Mesh::Face_index> found;
    processing::degenerate_faces(mesh, std::back_inserter(found));
    return found;
}

} // namespace

Surface::Surface(FacetFile file) : file_(std::move(file))
{
    Soup soup(file_);
    soup.turn_alike();
    processing::polygon_soup_to_polygon_mesh(soup.points(), soup.polygons(), mesh_);
    origins_ = mesh_.add_property_map<Mesh::Face_index, Origin>("f:origin", Origin{}).first;
    for (const Mesh::Face_index face : mesh_.faces()) // in the order of the polygons
        origins_[face] = {soup.facet(face.idx()), soup.reversed(face.idx())};
    refuse_holes();
    soup.refuse_touching_corner();
    remarks_ = soup.remarks();
    divide_polygons();
    remove_degenerate_triangles();
}

void Surface::refuse_holes() const
{
    std::vector<Mesh::Halfedge_index> border;
    std::copy_if(mesh_.halfedges().begin(), mesh_.halfedges().end(), std::back_inserter(border),
                 [&](Mesh::Halfedge_index edge) { return mesh_.is_border(edge); });
    if (border.empty())
        return;
    const Mesh::Halfedge_index edge = mesh_.opposite(border.front());
    const std::string where = fmt::format("the edge from {} to {} of {}", coordinates(mesh_.point(mesh_.source(edge))),
                                          coordinates(mesh_.point(mesh_.target(edge))), facet(mesh_.face(edge)));
    if (is_cut(mesh_, border))
        file_.refuse(
            fmt::format("the surface has one side only, so that it bounds no body; its two sides meet at {}", where));
    std::vector<Mesh::Halfedge_index> holes;
    processing::extract_boundary_cycles(mesh_, std::back_inserter(holes));
    file_.refuse(fmt::format("the surface is open, holes: {}; {} has no facet on its other side. Close the mesh in the "
                             "program it comes from; points that should be one must have the same coordinates",
                             holes.size(), where));
}

void Surface::divide_polygons()
{
    std::set<std::size_t> polygons;
    for (const Mesh::Face_index face : mesh_.faces())
        if (mesh_.degree(face) > 3)
            polygons.insert(origins_[face].facet);
    if (polygons.empty())
        return;
    Origin parent;
    processing::triangulate_faces(mesh_, CGAL::parameters::visitor(InheritOrigin(origins_, parent)));
    for (const Mesh::Face_index face : mesh_.faces())
        if (mesh_.degree(face) > 3)
            file_.refuse(facet(face) + " cannot be divided into triangles");
    remarks_.push_back(fmt::format("facets with more than three corners divided into triangles: {}", polygons.size()));
}

void Surface::remove_degenerate_triangles()
{
    const std::size_t count = degenerate_triangles(mesh_).size();
    if (count == 0)
        return;
    processing::remove_degenerate_faces(mesh_);
    mesh_.collect_garbage();
    if (mesh_.is_empty())
        file_.refuse("all facets lie in one line");
    if (const auto left = degenerate_triangles(mesh_); !left.empty())
        file_.refuse(facet(left.front()) + " has its corners in one line and cannot be removed without a hole");
    remarks_.push_back(fmt::format("triangles with their corners in one line removed: {}", count));
}

void Surface::place(const std::function<Vector3(const Vector3&)>& placed)
{
    for (const Mesh::Vertex_index corner : mesh_.vertices())
        mesh_.point(corner) = mesh_point(placed(vector(mesh_.point(corner))));
    remove_degenerate_triangles(); // by rounding
}

std::string Surface::facet(Mesh::Face_index face) const
{
    const std::size_t facet = origins_[face].facet;
    return facet == Origin::repair ? "a facet made to replace degenerate ones" : file_.facet(facet);
}

Mesh Surface::release() &&
{
    mesh_.remove_property_map(origins_);
    return std::move(mesh_);
}

} // namespace periporo::geometry
