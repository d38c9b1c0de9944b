// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a closed surface bounds a body, and which side of it the body is on, by CGAL.
#include "surface.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace periporo::geometry {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;

/// The closed parts of a surface, and how they lie in each other.
struct Parts {
    Mesh::Property_map<Mesh::Face_index, std::size_t> part; ///< of a triangle
    std::vector<std::size_t> level;                         ///< in how many others each part lies
    std::vector<std::vector<std::size_t>> around;           ///< for each part the one next around it, if any
    std::vector<bool> outwards;                             ///< as each part faces now
    std::vector<bool> mixed;                                ///< whose facets did not face alike in the file
    std::vector<Mesh::Face_index> example;                  ///< a triangle of each part

    /// Every second part, from the outside, bounds a cavity and must face inwards.
    bool must_turn(std::size_t p) const { return outwards[p] != (level[p] % 2 == 0); }
};

Parts parts_of(Mesh& mesh, const Mesh::Property_map<Mesh::Face_index, Origin>& origins)
{
    Parts parts;
    parts.part = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:part", 0).first;
    auto volume = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:volume", 0).first;
    processing::volume_connected_components(mesh, volume,
                                            CGAL::parameters::face_connected_component_map(parts.part)
                                                .nesting_levels(std::ref(parts.level))
                                                .volume_inclusions(std::ref(parts.around))
                                                .is_cc_outward_oriented(std::ref(parts.outwards)));
    mesh.remove_property_map(volume);
    parts.mixed.resize(parts.level.size(), false);
    parts.example.resize(parts.level.size());
    for (const Mesh::Face_index face : mesh.faces()) {
        const std::size_t part = parts.part[face];
        parts.example[part] = face;
        parts.mixed[part] = parts.mixed[part] || origins[face].reversed;
    }
    return parts;
}

} // namespace

void Surface::bound_body()
{
    refuse_intersections();
    Parts parts = parts_of(mesh_, origins_);
    for (std::size_t p = 0; p < parts.level.size(); ++p)
        for (const std::size_t around : parts.around[p]) {
            const std::string where = fmt::format("the closed surface with {} lies inside the one with {}",
                                                  facet(parts.example[p]), facet(parts.example[around]));
            if (parts.mixed[p] || parts.mixed[around])
                file_.refuse(where + ", but not all their facets face alike, so that the file does not say whether it "
                                     "is a cavity; let the facets of a cavity face into it");
            if (parts.must_turn(p) != parts.must_turn(around))
                file_.refuse(where + " and faces the same way, a body inside a body; leave it out, or let the facets "
                                     "of a cavity face into it");
        }
    std::vector<Mesh::Face_index> to_turn;
    std::set<std::size_t> turned; // facets of the file
    std::set<std::size_t> inside_out;
    for (const Mesh::Face_index face : mesh_.faces()) {
        const std::size_t part = parts.part[face];
        if (parts.must_turn(part))
            to_turn.push_back(face);
        if (parts.must_turn(part) != origins_[face].reversed)
            (parts.mixed[part] ? turned : inside_out).insert(origins_[face].facet);
    }
    processing::reverse_face_orientations(to_turn, mesh_);
    if (!turned.empty())
        remarks_.push_back(fmt::format("facets turned to face as the others do: {}", turned.size()));
    if (!inside_out.empty())
        remarks_.push_back(fmt::format("facets turned because the surface was inside out: {}", inside_out.size()));
    const auto cavities =
        std::count_if(parts.level.begin(), parts.level.end(), [](std::size_t level) { return level % 2 == 1; });
    if (cavities > 0)
        remarks_.push_back(fmt::format("closed surfaces inside others, taken for cavities: {}", cavities));
    mesh_.remove_property_map(parts.part);
}

void Surface::refuse_intersections() const
{
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
    processing::self_intersections(mesh_, std::back_inserter(found), CGAL::parameters::maximum_number(1));
    if (!found.empty())
        file_.refuse(fmt::format("the surface crosses or touches itself: {} and {}. Join the bodies that overlap, or "
                                 "part them",
                                 facet(found.front().first), facet(found.front().second)));
}

} // namespace periporo::geometry
