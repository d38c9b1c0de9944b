// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "surface_mesh": every format, the body it makes, every repair and every refusal.
#include "facet_files.hpp"
#include "polyhedra.hpp"
#include "shape_checks.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <numbers>

namespace {

using namespace periporo;
using test::Facets;
using test::Polyhedron;
using Remarks = std::vector<std::string>;
using Given = std::map<std::string, ParameterValue>;

/// Of a file in a folder of its own, which may be gone once the geometry is made.
std::unique_ptr<Geometry> body_of(const std::string& name, const std::string& content, Given given = {})
{
    const test::TemporaryFolder folder;
    given["file"] = test::write_file(folder, name, content);
    return test::geometry("surface_mesh", given);
}

std::unique_ptr<Geometry> body_of(const Facets& facets)
{
    return body_of("body.off", test::off(facets));
}

std::string refusal(const std::string& name, const std::string& content)
{
    return test::message_of_error([&] { body_of(name, content); });
}

std::string refusal(const Facets& facets)
{
    return refusal("body.off", test::off(facets));
}

Polyhedron unit_cube()
{
    return test::block({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
}

/// The cube of quadrangles, in the order of its triangles in test::block().
Facets quadrangles()
{
    Facets cube;
    cube.points = unit_cube().points;
    cube.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return cube;
}

/// Cuts the triangle at index 0 of the cube, with the corners 0, 2, 3, where its long edge from 3 to 0 has a point in
/// its middle, so that the triangle in that edge has all corners in one line.
Facets cube_with_collinear_triangle()
{
    Facets cube = unit_cube();
    cube.points.emplace_back(0.5, 0.5, 0.0);
    cube.polygons[0] = {0, 2, 8};
    cube.polygons.push_back({8, 2, 3});
    cube.polygons.push_back({0, 8, 3});
    return cube;
}

} // namespace

TEST_CASE("a cube is read from every format")
{
    const Facets triangles = unit_cube();
    const std::vector<std::pair<std::string, std::string>> files{
        {"text.stl", test::stl(triangles)},
        {"binary.stl", test::binary_stl(triangles)},
        {"solid.stl", test::binary_stl(triangles, "solid binary")},
        {"body.off", test::off(triangles)},
        {"text.ply", test::ply(triangles)},
        {"binary.ply", test::binary_ply(triangles)},
        {"body.obj", test::obj(triangles)},
        {"CAPITAL.STL", test::stl(triangles)}};
    for (const auto& [name, content] : files) {
        CAPTURE(name);
        const auto body = body_of(name, content);
        CHECK(body->volume() == 1.0);
        CHECK(body->bounds().lower == Vector3(0.0, 0.0, 0.0));
        CHECK(body->bounds().upper == Vector3(1.0, 1.0, 1.0));
        test::check_closed_region(*body, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
        CHECK(body->remarks() == Remarks{});
    }
}

TEST_CASE("polygons are divided into triangles")
{
    for (const auto& [name, content] :
         std::vector<std::pair<std::string, std::string>>{{"body.off", test::off(quadrangles())},
                                                          {"text.ply", test::ply(quadrangles())},
                                                          {"binary.ply", test::binary_ply(quadrangles())},
                                                          {"body.obj", test::obj(quadrangles())}}) {
        CAPTURE(name);
        const auto body = body_of(name, content);
        CHECK(body->volume() == 1.0);
        test::check_closed_region(*body, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
        CHECK(body->remarks() == Remarks{"facets with more than three corners divided into triangles: 6"});
    }
}

TEST_CASE("a polygon with a re-entrant corner is divided within itself")
{
    // An L of three unit squares, extruded by 1.
    Facets corner;
    const std::vector<std::pair<double, double>> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (const double z : {0.0, 1.0})
        for (const auto& [x, y] : outline)
            corner.points.emplace_back(x, y, z);
    corner.polygons = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (std::size_t i = 0; i < 6; ++i)
        corner.polygons.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
    const auto body = body_of(corner);
    CHECK(body->volume() == 3.0);
    CHECK(body->contains({0.5, 1.5, 0.5}));
    CHECK(body->contains({1.5, 0.5, 1.0}));
    CHECK(body->contains({1.0, 1.0, 0.5})); // the re-entrant edge
    CHECK_FALSE(body->contains({1.5, 1.5, 0.5}));
    CHECK_FALSE(body->contains({test::just_above(1.0), 1.5, 1.0}));
}

TEST_CASE("relative corners of OBJ, and those with textures and normals, are understood")
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 0\n"
                             "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf -4 -1 -2\nf 2 3 4\n";
    CHECK(body_of("body.obj", text)->volume() == doctest::Approx(1.0 / 6.0).epsilon(1e-15).scale(0.0));
}

TEST_CASE("a file in millimetres is scaled, turned and put in its place")
{
    // Quarter turns about z are exact: x -> y -> -x.
    const auto body = body_of("body.stl", test::stl(test::block({0.0, 0.0, 0.0}, {2000.0, 1000.0, 500.0})),
                              {{"scale", 1e-3},
                               {"origin", std::vector<double>{3.0, 5.0, 7.0}},
                               {"rotation_axis", std::vector<double>{0.0, 0.0, 1.0}},
                               {"rotation_angle", std::numbers::pi / 2}});
    test::check_closed_region(*body, {2.0, 5.0, 7.0}, {3.0, 7.0, 7.5});
    CHECK(body->volume() == 1.0);
}

TEST_CASE("a body turned by any angle keeps its volume")
{
    const auto body = body_of("body.off", test::off(test::icosphere(3)),
                              {{"scale", 2.0},
                               {"origin", std::vector<double>{0.1, 0.2, 0.3}},
                               {"rotation_axis", std::vector<double>{1.0, 2.0, 3.0}},
                               {"rotation_angle", 0.4}});
    const auto straight = body_of(Facets(test::icosphere(3)));
    // A thousand terms of rounded corners
    CHECK(body->volume() == doctest::Approx(8.0 * straight->volume()).epsilon(1e-14).scale(0.0));
    CHECK(body->contains({0.1, 0.2, 0.3}));
}

TEST_CASE("a cube has the distance of a cube")
{
    const auto body = body_of("body.off", test::off(unit_cube()), {{"rotation_angle", 0.3}});
    test::SurfaceSamples samples;
    const Vector3 x(std::cos(0.3), std::sin(0.3), 0.0);
    const Vector3 y(-std::sin(0.3), std::cos(0.3), 0.0);
    samples.add_block({0.0, 0.0, 0.0}, {x, y, Vector3::UnitZ()}, 40);
    test::check_distance(*body, samples);
    test::check_gradient(*body);
}

TEST_CASE("a filled body has its volume exactly, in points inside")
{
    const auto body = body_of(Facets(test::icosphere(3)));
    const PointCloud cloud = body->fill(0.1);
    CHECK(test::moments(cloud).volume == doctest::Approx(body->volume()).epsilon(1e-13).scale(0.0));
    for (const Vector3& position : cloud.positions)
        CHECK(body->contains(position));
    // One cell per point on average; the surface makes the difference.
    const double cells = body->volume() / 1e-3;
    CHECK(std::abs(static_cast<double>(cloud.positions.size()) - cells) < 0.02 * cells);
}

TEST_CASE("bodies apart from each other are one geometry")
{
    Polyhedron bodies = unit_cube();
    bodies.add(test::block({2.0, 0.0, 0.0}, {1.0, 1.0, 2.0}));
    const auto body = body_of(Facets(bodies));
    CHECK(body->volume() == 3.0);
    CHECK(body->contains({0.5, 0.5, 0.5}));
    CHECK(body->contains({2.5, 0.5, 1.5}));
    CHECK_FALSE(body->contains({1.5, 0.5, 0.5}));
    CHECK(body->remarks() == Remarks{});
}

TEST_CASE("a closed surface that faces into itself inside another is a cavity")
{
    Polyhedron bodies = test::block({0.0, 0.0, 0.0}, {4.0, 4.0, 4.0});
    Polyhedron cavity = test::block({1.0, 1.0, 1.0}, {2.0, 2.0, 2.0});
    cavity.turn_inside_out();
    bodies.add(cavity);
    bodies.add(test::block({1.5, 1.5, 1.5}, {1.0, 1.0, 1.0})); // a body in the cavity
    for (const bool inside_out : {false, true}) {
        CAPTURE(inside_out);
        const auto body = body_of(Facets(bodies));
        CHECK(body->volume() == 64.0 - 8.0 + 1.0);
        CHECK(body->contains({0.5, 2.0, 2.0}));
        CHECK_FALSE(body->contains({1.25, 2.0, 2.0}));
        CHECK(body->contains({2.0, 2.0, 2.0}));
        Remarks expected{"closed surfaces inside others, taken for cavities: 1"};
        if (inside_out)
            expected.insert(expected.begin(), "facets turned because the surface was inside out: 36");
        CHECK(body->remarks() == expected);
        bodies.turn_inside_out();
    }
}

TEST_CASE("points listed twice are merged, and points of no facet left out")
{
    Facets apart; // every facet with points of its own, as in STL
    const Polyhedron cube = unit_cube();
    for (std::size_t t = 0; t < cube.triangles.size(); ++t) {
        for (const Vector3& corner : cube.corners(t))
            apart.points.push_back(corner);
        apart.polygons.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    apart.points.emplace_back(9.0, 9.0, 9.0);
    const auto body = body_of(apart);
    CHECK(body->volume() == 1.0);
    CHECK(body->bounds().upper == Vector3(1.0, 1.0, 1.0));
    CHECK(body->remarks() == Remarks{"duplicate points merged: 28", "points of no facet left out: 1"});
}

TEST_CASE("degenerate facets and facets listed before are removed")
{
    Facets cube = unit_cube();
    cube.polygons.push_back({0, 1, 0});
    cube.polygons.push_back({3, 3, 3});
    cube.polygons.push_back({3, 0, 2}); // again, with another corner first
    cube.polygons.push_back({3, 2, 0}); // and from behind
    const auto body = body_of(cube);
    CHECK(body->volume() == 1.0);
    CHECK(body->remarks() ==
          Remarks{"facets with fewer than three different corners removed: 2", "facets listed before removed: 2"});
}

TEST_CASE("a quadrangle with two corners in one place is a triangle")
{
    Facets cube = unit_cube();
    cube.polygons[4] = {0, 1, 1, 5};
    cube.polygons[5] = {0, 5, 4, 0};
    const auto body = body_of(cube);
    CHECK(body->volume() == 1.0);
    CHECK(body->remarks() == Remarks{});
}

TEST_CASE("a triangle with its corners in one line is removed without a hole")
{
    for (const double angle : {0.0, 0.3}) {
        CAPTURE(angle);
        const auto body =
            body_of("body.off", test::off(cube_with_collinear_triangle()), {{"rotation_angle", angle}, {"scale", 0.1}});
        CHECK(body->volume() == doctest::Approx(1e-3).epsilon(1e-14).scale(0.0));
        CHECK(body->remarks() == Remarks{"triangles with their corners in one line removed: 1"});
    }
}

TEST_CASE("facets that face the other way are turned, and a surface that is inside out as a whole")
{
    Facets cube = unit_cube();
    for (const std::size_t facet : {2, 7, 8})
        std::reverse(cube.polygons[facet].begin(), cube.polygons[facet].end());
    auto body = body_of(cube);
    CHECK(body->volume() == 1.0);
    CHECK(body->remarks() == Remarks{"facets turned to face as the others do: 3"});

    Polyhedron turned = unit_cube();
    turned.turn_inside_out();
    body = body_of(Facets(turned));
    CHECK(body->volume() == 1.0);
    CHECK(body->remarks() == Remarks{"facets turned because the surface was inside out: 12"});
    Vector3 normal;
    CHECK(body->signed_distance({0.5, 0.5, 3.0}, normal) == 2.0);
    CHECK(normal == Vector3(0.0, 0.0, 1.0));
    CHECK(body->signed_distance({0.5, 0.5, 1.0}, normal) == 0.0);
    CHECK(normal == Vector3(0.0, 0.0, 1.0));

    turned.add(test::block({2.0, 0.0, 0.0}, {1.0, 1.0, 1.0})); // beside one that is not
    body = body_of(Facets(turned));
    CHECK(body->volume() == 2.0);
    CHECK(body->remarks() == Remarks{"facets turned because the surface was inside out: 12"});
}

TEST_CASE("an open surface is refused with an edge of its border, the facet there and the holes")
{
    Facets cube = unit_cube();
    cube.polygons.erase(cube.polygons.begin() + 11);
    cube.polygons.erase(cube.polygons.begin());
    const std::string message = refusal(cube);
    test::check_mentions(message,
                         {"body.off: the surface is open, holes: 2", "the edge from (", "of facet ", "Close the mesh"});
    // What it names must be true: the facet has the edge, and the edge is one of a facet that was taken out.
    bool found = false;
    for (std::size_t facet = 0; facet < cube.polygons.size(); ++facet) {
        if (message.find(fmt::format("of facet {} with", facet + 1)) == std::string::npos)
            continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vector3 a = cube.points[cube.polygons[facet][corner]];
            const Vector3 b = cube.points[cube.polygons[facet][(corner + 1) % 3]];
            const bool named = message.find(fmt::format("from ({}, {}, {}) to ({}, {}, {}) of", a.x(), a.y(), a.z(),
                                                        b.x(), b.y(), b.z())) != std::string::npos;
            const auto of_hole = [](const Vector3& p) {
                return (p == Vector3(0, 0, 0) || p == Vector3(0, 1, 0) || p == Vector3(1, 1, 0)) ||
                       (p == Vector3(1, 0, 0) || p == Vector3(1, 1, 1) || p == Vector3(1, 0, 1));
            };
            found = found || (named && of_hole(a) && of_hole(b));
        }
    }
    CHECK(found);
}

TEST_CASE("the facet of a message has the number and the coordinates of the file, whatever was left out and scaled")
{
    Facets cube = unit_cube();
    cube.polygons.insert(cube.polygons.begin(), {0, 0, 1}); // facet 1, which is degenerate
    cube.polygons.insert(cube.polygons.begin() + 1, {9, 10, 8});
    cube.points.emplace_back(5.0, 0.0, 0.0);
    cube.points.emplace_back(6.0, 0.0, 0.0);
    cube.points.emplace_back(5.5, 0.5, 0.25);
    const std::string message = test::message_of_error([&] {
        body_of("body.obj", test::obj(cube), {{"scale", 0.001}, {"origin", std::vector<double>{7, 8, 9}}});
    });
    test::check_mentions(message, {"holes: 1", "facet 2 with the corners (6, 0, 0), (5.5, 0.5, 0.25), (5, 0, 0)"});
}

TEST_CASE("bodies that cross are refused with a facet of each")
{
    Polyhedron bodies = test::block({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0});
    Polyhedron tip = test::right_tetrahedron({1.0, 1.0, 1.0}, {3.0, 0.5, 0.5}); // only its tip leaves, through x = 2
    bodies.add(tip);
    const std::string message = refusal(Facets(bodies));
    test::check_mentions(message, {"body.off: the surface crosses or touches itself: facet ", " and facet ",
                                   "with the corners", "part them"});
    // One of the two facets at x = 2, which are 11 and 12, and one of those that meet at the tip, all but 15.
    CHECK((message.find("facet 11 ") != std::string::npos || message.find("facet 12 ") != std::string::npos));
    CHECK(message.find("facet 15 ") == std::string::npos);
}

TEST_CASE("bodies that touch are refused with the place")
{
    const auto with_cube_at = [](const Vector3& lower) {
        Polyhedron bodies = unit_cube();
        bodies.add(test::block(lower, {1.0, 1.0, 1.0}));
        return refusal(Facets(bodies));
    };
    // Along an edge with common corners, and along a face
    test::check_mentions(with_cube_at({1.0, 1.0, 0.0}),
                         {"the edge from (1, 1, ", "belongs to more than two facets: ", "must be parted"});
    test::check_mentions(with_cube_at({0.0, 0.0, 1.0}), {"belongs to more than two facets: "});
    // In a corner
    test::check_mentions(with_cube_at({1.0, 1.0, 1.0}), {"touch in a corner", "facet ", "(1, 1, 1)"});
    // In the middle of faces, edges and corners
    for (const Vector3& lower : {Vector3(0.5, 0.5, 1.0), Vector3(0.5, 1.0, 1.0), Vector3(1.0, 0.25, 0.25)})
        test::check_mentions(with_cube_at(lower), {"crosses or touches itself"});
    // A hair apart they are two bodies.
    Polyhedron bodies = unit_cube();
    bodies.add(test::block({test::just_above(1.0), 0.25, 0.25}, {1.0, 1.0, 1.0}));
    CHECK(body_of(Facets(bodies))->volume() == doctest::Approx(2.0).epsilon(1e-15).scale(0.0));
}

TEST_CASE("a body inside a body is refused, and a cavity that does not say what it is")
{
    Polyhedron bodies = test::block({0.0, 0.0, 0.0}, {4.0, 4.0, 4.0});
    bodies.add(test::block({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}));
    test::check_mentions(refusal(Facets(bodies)), {"lies inside the one with facet ", "a body inside a body"});

    Facets mixed = bodies;
    std::reverse(mixed.polygons[14].begin(), mixed.polygons[14].end());
    test::check_mentions(refusal(mixed), {"lies inside the one with facet ", "not all their facets face alike"});
}

TEST_CASE("a surface with one side is refused")
{
    // The projective plane of six points: any two triangles of it have neighbours, every edge has two triangles.
    Facets plane;
    plane.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}, {3, 1, 2}};
    plane.polygons = {{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 5}, {0, 3, 4},
                      {1, 2, 3}, {1, 2, 4}, {1, 3, 5}, {2, 4, 5}, {3, 4, 5}};
    test::check_mentions(refusal(plane), {"the surface has one side only", "facet "});
}

TEST_CASE("a surface without thickness is refused")
{
    Facets flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    flat.polygons = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}; // front and back have different diagonals
    test::check_mentions(refusal(flat), {"the surface crosses or touches itself"});
    flat.polygons = {{0, 1, 2}, {0, 2, 1}};
    test::check_mentions(refusal(flat), {"the surface is open"});
    Facets line;
    line.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    line.polygons = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    test::check_mentions(refusal(line), {"all facets lie in one line"});
}

TEST_CASE("a polygon that comes twice through a corner is refused")
{
    Facets cube = unit_cube();
    cube.polygons[3] = {4, 7, 6, 7, 5};
    test::check_mentions(refusal(cube), {"body.off: facet 4 with the corners (0, 0, 1)", "comes twice"});
}

TEST_CASE("coordinates that are not finite are refused with the facet or the line")
{
    Facets cube = unit_cube();
    cube.points[6].y() = std::numeric_limits<double>::quiet_NaN();
    // Corner 6 comes first in facet 4.
    for (const auto& [name, content] :
         std::vector<std::pair<std::string, std::string>>{{"body.stl", test::binary_stl(cube)},
                                                          {"solid.stl", test::binary_stl(cube, "solid")},
                                                          {"body.ply", test::binary_ply(cube)}})
        test::check_mentions(
            refusal(name, content),
            {name, "facet 4 with the corners (0, 0, 1), (1, 1, 1), (0, nan, 1)", "not a finite number"});
    cube.points[6].y() = std::numeric_limits<double>::infinity();
    test::check_mentions(refusal("body.off", test::off(cube)), {"body.off: line 9 ", "not a finite number"});
    test::check_mentions(refusal("body.obj", test::obj(cube)), {"body.obj: line 9 ", "not a finite number"});
    test::check_mentions(refusal("body.stl", test::stl(cube)), {"body.stl: line 27 ", "not a finite number"});
}

TEST_CASE("files that are cut off, empty or something else are refused")
{
    const Facets cube = unit_cube();
    for (const auto& [name, content] :
         std::vector<std::pair<std::string, std::string>>{{"text.stl", test::stl(cube)},
                                                          {"binary.stl", test::binary_stl(cube)},
                                                          {"body.off", test::off(cube)},
                                                          {"text.ply", test::ply(cube)},
                                                          {"binary.ply", test::binary_ply(cube)}}) {
        CAPTURE(name);
        test::check_mentions(refusal(name, content.substr(0, content.size() - 15)), {name, "cannot be read as a ."});
    }
    test::check_mentions(refusal("body.obj", "v 0 0 0\nv 1 0 0\nwhatever\n"), {"cannot be read as a .obj file"});
    for (const std::string name : {"body.stl", "body.off", "body.ply", "body.obj"})
        test::check_mentions(refusal(name, ""), {name});
    test::check_mentions(refusal("body.stl", "solid nothing\nendsolid nothing\n"), {"the file has no facets"});
    test::check_mentions(refusal("body.vtk", ""), {"body.vtk: ", "must be .stl, .off, .ply or .obj"});
    test::check_mentions(refusal("body.off", "OFF\n4 99999999999999 0\n"), {"cannot be read"});
    const std::string binary_count = "OFF BINARY\n" + std::string("\x6f\x6c\x6c\x64\0\0\0\4\0\0\0\0", 12);
    for (const std::string& header :
         {std::string("OFF\n# of points and facets\n1869375844 4 0\n0 0 0\n"),
          std::string("OFF\n4\n1869375844 0\n0 0 0\n"), std::string("4OFF\n1869375844 4 0\n0 0 0 1\n"), binary_count})
        test::check_mentions(refusal("body.off", header),
                             {"body.off: the header names 1.869e+09", "than the file has"});
    test::check_mentions(refusal("body.off", "4OFF\n4 1 0\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n3 0 1 2\n"),
                         {"body.off: "}); // a fourth coordinate of zero divides the others
    test::check_mentions(refusal("body.ply", "ply\nformat ascii 1.0\nelement vertex 1869375844\nend_header\n"),
                         {"body.ply: the header names 1.869e+09 elements"});
    // CGAL 5.5 reads beyond its memory at these.
    test::check_mentions(refusal("body.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n"),
                         {"line 3 has a property and no element before it"});
    test::check_mentions(refusal("body.ply", "ply\nformat ascii 1.0\nenement vertex 4\nproperty float x\nend_header\n"),
                         {"line 3 of the header"});
    for (const std::string type : {"int32", "list uchar float"})
        test::check_mentions(
            refusal("body.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty " + type + " y\nend_header\n0\n"),
            {"line 4: the coordinate y must be float or double"});
}

TEST_CASE("facets of unknown or too few corners are refused with their number")
{
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n";
    test::check_mentions(refusal("body.obj", points + "f 1 4 3\nf 2 3 5\n"),
                         {"body.obj: facet 4 has a corner that is none of the 4 points"});
    test::check_mentions(refusal("body.obj", points + "f 1 4\nf 2 3 4\n"),
                         {"body.obj: facet 3 with the corners (0, 0, 0), (0, 0, 1) has fewer than three corners"});
}

TEST_CASE("a file that is not there is an error that names it")
{
    test::check_mentions(test::message_of_error([] {
                             test::geometry("surface_mesh", {{"file", std::string("/nowhere/body.stl")}});
                         }),
                         {"/nowhere/body.stl: cannot be opened"});
}
