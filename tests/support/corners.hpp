// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Obstacles with corners and valleys for tests, made by the geometry plugins.
#pragma once

#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace periporo::test {

using Shape = std::shared_ptr<const Geometry>;

inline Shape box(const Vector3& lower, const Vector3& upper)
{
    const Vector3 size = upper - lower;
    return geometry("box", {{"size", std::vector{size.x(), size.y(), size.z()}},
                            {"origin", std::vector{lower.x(), lower.y(), lower.z()}}});
}

inline Shape boolean(const std::string& operation, const std::vector<Shape>& operands)
{
    std::vector<std::string> names;
    for (std::size_t n = 0; n < operands.size(); ++n)
        names.push_back(fmt::format("operand {}", n));
    std::unique_ptr<Geometry> made = geometry("boolean", {{"operation", operation}, {"of", names}});
    made->set_operands(operands);
    return made;
}

inline Shape mesh(const std::vector<std::vector<Vector3>>& facets)
{
    std::string points, polygons;
    std::size_t count = 0;
    for (const std::vector<Vector3>& facet : facets) {
        polygons += fmt::format("{}", facet.size());
        for (const Vector3& corner : facet) {
            points += fmt::format("{} {} {}\n", corner.x(), corner.y(), corner.z());
            polygons += fmt::format(" {}", count++);
        }
        polygons += '\n';
    }
    const TemporaryFolder folder;
    const std::string file = (folder / "body.off").string();
    std::ofstream(file) << fmt::format("OFF\n{} {} 0\n{}{}", count, facets.size(), points, polygons);
    return geometry("surface_mesh", {{"file", file}});
}

/// The ground under heights over count x count cells of a square, with its middle at the origin.
inline Shape heightfield(double half_width, int count, const std::function<double(double x, double y)>& height)
{
    std::string text = "x, y, z\n";
    for (int j = 0; j <= count; ++j)
        for (int i = 0; i <= count; ++i) {
            const double x = half_width * (2.0 * i / count - 1.0);
            const double y = half_width * (2.0 * j / count - 1.0);
            text += fmt::format("{}, {}, {}\n", x, y, height(x, y));
        }
    const TemporaryFolder folder;
    const std::string file = (folder / "terrain.csv").string();
    std::ofstream(file) << text;
    return geometry("heightfield", {{"file", file}, {"base", -1.0}});
}

constexpr double wall = 0.05; ///< thickness of what is around the corners [m]
constexpr double far = 0.2;   ///< extent of it [m]

inline std::vector<std::vector<Vector3>> box_facets(const Vector3& lower, const Vector3& upper)
{
    std::vector<std::vector<Vector3>> facets;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool above : {false, true}) {
            std::vector<Vector3> facet(4, above ? upper : lower);
            const int u = above ? (axis + 1) % 3 : (axis + 2) % 3;
            const int v = above ? (axis + 2) % 3 : (axis + 1) % 3;
            for (int k = 0; k < 4; ++k) {
                facet[static_cast<std::size_t>(k)][u] = k == 1 || k == 2 ? upper[u] : lower[u];
                facet[static_cast<std::size_t>(k)][v] = k >= 2 ? upper[v] : lower[v];
            }
            facets.push_back(facet);
        }
    return facets;
}

/// Facets of the cube from -wall to far without what has only positive coordinates.
inline std::vector<std::vector<Vector3>> bitten_cube()
{
    std::vector<std::vector<Vector3>> facets;
    for (int axis = 0; axis < 3; ++axis) {
        const auto facet = [&](double along, const std::vector<std::array<double, 2>>& corners) {
            std::vector<Vector3> result;
            for (const auto& [u, v] : corners) {
                Vector3 corner;
                corner[axis] = along;
                corner[(axis + 1) % 3] = u;
                corner[(axis + 2) % 3] = v;
                result.push_back(corner);
            }
            facets.push_back(result);
        };
        facet(-wall, {{-wall, -wall}, {-wall, far}, {far, far}, {far, -wall}});
        facet(far, {{-wall, -wall}, {far, -wall}, {far, 0.0}, {0.0, 0.0}, {0.0, far}, {-wall, far}});
        facet(0.0, {{0.0, 0.0}, {far, 0.0}, {far, far}, {0.0, far}});
    }
    return facets;
}

struct NamedShape {
    std::string name;
    Shape shape;
};

/// Solids that leave free what has positive coordinates, around the origin: three faces, edges and a corner.
inline std::vector<NamedShape> solid_corners()
{
    const Vector3 low = Vector3::Constant(-wall);
    const auto slab = [&](int axis) { return box(low, Vector3::Constant(far) - far * Vector3::Unit(axis)); };
    const Shape angle_iron =
        geometry("prism", {{"polygon", std::vector{-wall, -wall, far, -wall, far, 0.0, 0.0, 0.0, 0.0, far, -wall, far}},
                           {"height", far + wall},
                           {"origin", std::vector{0.0, 0.0, -wall}}});
    return {{"union of boxes", boolean("union", {slab(0), slab(1), slab(2)})},
            {"box with a box taken away", boolean("difference", {box(low, Vector3::Constant(far)),
                                                                 box(Vector3::Zero(), Vector3::Constant(2.0 * far))})},
            {"union of an L prism and a box", boolean("union", {angle_iron, slab(2)})},
            {"mesh", mesh(bitten_cube())},
            {"box with a mesh taken away",
             boolean("difference", {box(low, Vector3::Constant(far)),
                                    mesh(box_facets(Vector3::Zero(), Vector3::Constant(2.0 * far)))})}};
}

} // namespace periporo::test
