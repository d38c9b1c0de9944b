// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "heightfield": both formats, the three kinds of bottom, closed forms, every refusal.
#include "geometry/common/exact.hpp"
#include "polyhedra.hpp"
#include "shape_checks.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <functional>

namespace {

using namespace periporo;
using Given = std::map<std::string, ParameterValue>;
using List = std::vector<double>;
using Height = std::function<double(double x, double y)>;

/// Grid lines and the heights at their crossings.
struct Grid {
    List x;
    List y;
    Height height;
};

/// The points from the last to the first, as any order will do.
std::string csv(const Grid& grid)
{
    std::string text = "x, y, z\n";
    for (std::size_t j = grid.y.size(); j-- > 0;)
        for (std::size_t i = grid.x.size(); i-- > 0;)
            text += fmt::format("{}, {}, {}\n", grid.x[i], grid.y[j], grid.height(grid.x[i], grid.y[j]));
    return text;
}

std::string file_in(const test::TemporaryFolder& folder, const std::string& name, const std::string& content)
{
    std::ofstream(folder / name) << content;
    return (folder / name).string();
}

std::unique_ptr<Geometry> ground(const std::string& name, const std::string& content, Given given)
{
    const test::TemporaryFolder folder;
    given["file"] = file_in(folder, name, content);
    return test::geometry("heightfield", given);
}

std::unique_ptr<Geometry> ground(const Grid& grid, const Given& given)
{
    return ground("terrain.csv", csv(grid), given);
}

std::string refusal(const std::string& name, const std::string& content, const Given& given = {{"base", -100.0}})
{
    return test::message_of_error([&] { ground(name, content, given); });
}

std::string esri(const std::string& heights, const std::string& more = "")
{
    return "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n" + more + heights;
}

/// A rough terrain over lines at uneven distances, with coordinates that are no round numbers.
Grid rough()
{
    return {{0.1, 0.45, 0.6, 1.3, 1.7}, {-0.3, 0.2, 0.35, 1.1}, [](double x, double y) {
                return 0.3 * std::sin(5.0 * x) * std::cos(4.0 * y) + 0.1 * x;
            }};
}

/// Height of the surface of triangles over (x, y), exactly; every cell is parted from south-west to north-east.
geometry::Exact exact_height(const Grid& grid, double x, double y)
{
    using geometry::Exact;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 2 < grid.x.size() && x > grid.x[i + 1])
        ++i;
    while (j + 2 < grid.y.size() && y > grid.y[j + 1])
        ++j;
    const auto z = [&](std::size_t a, std::size_t b) { return Exact(grid.height(grid.x[a], grid.y[b])); };
    const Exact u = (Exact(x) - Exact(grid.x[i])) / (Exact(grid.x[i + 1]) - Exact(grid.x[i]));
    const Exact v = (Exact(y) - Exact(grid.y[j])) / (Exact(grid.y[j + 1]) - Exact(grid.y[j]));
    return u > v ? z(i, j) + u * (z(i + 1, j) - z(i, j)) + v * (z(i + 1, j + 1) - z(i + 1, j))
                 : z(i, j) + v * (z(i, j + 1) - z(i, j)) + u * (z(i + 1, j + 1) - z(i, j + 1));
}

double rounded(const geometry::Exact& value)
{
    return CGAL::to_double(value);
}

} // namespace

TEST_CASE("the ground under an inclined plane is a prism: volume, bounds and containment")
{
    const Height plane = [](double x, double y) { return 4.0 + 0.5 * x - 0.25 * y; };
    const auto body = ground(Grid{{0.0, 1.0, 3.0, 4.0}, {0.0, 2.0, 4.0}, plane}, {{"base", 1.0}});
    CHECK(body->volume() == 16.0 * 3.5); // area times the thickness in the middle, (4 + 1 - 0.5) - 1
    CHECK(body->bounds().lower == Vector3(0.0, 0.0, 1.0));
    CHECK(body->bounds().upper == Vector3(4.0, 4.0, 6.0));
    for (const double x : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0})
        for (const double y : {0.0, 0.5, 1.0, 2.0, 3.5, 4.0}) {
            const double z = plane(x, y); // exact in binary, like the plane through the corners
            CAPTURE(x);
            CAPTURE(y);
            CHECK(body->contains({x, y, z}));
            CHECK_FALSE(body->contains({x, y, test::just_above(z)}));
            CHECK(body->contains({x, y, 2.0}));
            CHECK(body->contains({x, y, 1.0}));
            CHECK_FALSE(body->contains({x, y, test::just_below(1.0)}));
        }
    CHECK_FALSE(body->contains({test::just_above(4.0), 1.0, 2.0}));
    CHECK_FALSE(body->contains({-std::numeric_limits<double>::denorm_min(), 1.0, 2.0}));
    CHECK_FALSE(body->contains({1.0, test::just_above(4.0), 2.0}));
    CHECK_FALSE(body->contains({1.0, std::numeric_limits<double>::quiet_NaN(), 2.0}));
    CHECK_FALSE(body->contains({1.0, 1.0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST_CASE("a peak on one crossing is a pyramid over the six triangles around it")
{
    const Height peak = [](double x, double y) { return x == 2.0 && y == 1.0 ? 7.0 : 1.0; };
    const auto body = ground(Grid{{0.0, 2.0, 4.0}, {0.0, 1.0, 2.0}, peak}, {{"base", 0.0}});
    // Six triangles of area 1 as the base, a height of 6, on a slab of 4 x 2 x 1
    CHECK(body->volume() == 8.0 + 6.0 * 1.0 * 6.0 / 3.0);
    // Half way up the diagonal of the south-west, and beside it half way on the flank that the south-east lacks
    CHECK(body->contains({1.0, 0.5, 4.0}));
    CHECK_FALSE(body->contains({1.0, 0.5, test::just_above(4.0)}));
    CHECK(body->contains({3.0, 0.5, 1.0})); // on the diagonal of the flat corner
    CHECK_FALSE(body->contains({3.0, 0.25, test::just_above(1.0)}));
    CHECK(body->contains({2.0, 1.0, 7.0}));
}

TEST_CASE("a thickness gives a layer of that depth, and a second grid the space between the two")
{
    const Grid terrain = rough();
    const double area = (terrain.x.back() - terrain.x.front()) * (terrain.y.back() - terrain.y.front());
    const auto layer = ground(terrain, {{"thickness", 0.125}});
    CHECK(layer->volume() == doctest::Approx(0.125 * area).epsilon(1e-14).scale(0.0)); // a few roundings of z
    CHECK_FALSE(layer->contains({0.6, 0.2, terrain.height(0.6, 0.2) - 0.126}));
    CHECK(layer->contains({0.6, 0.2, terrain.height(0.6, 0.2) - 0.124}));

    const test::TemporaryFolder folder;
    Grid bottom = terrain;
    bottom.height = [](double x, double y) { return -2.0 + x - 0.5 * y; };
    const auto between = test::geometry("heightfield", {{"file", file_in(folder, "terrain.csv", csv(terrain))},
                                                        {"bottom_file", file_in(folder, "bottom.csv", csv(bottom))}});
    const auto above = ground(terrain, {{"base", -10.0}});
    const auto below = ground(bottom, {{"base", -10.0}});
    CHECK(between->volume() == doctest::Approx(above->volume() - below->volume()).epsilon(1e-14));
    CHECK(between->contains({0.6, 0.2, -1.5}));       // on the plane of the bottom, exactly 0.6 and 0.1 aside
    CHECK_FALSE(between->contains({1.3, 0.2, -0.9})); // below it
}

TEST_CASE("within a rounding of the terrain containment is that of exact arithmetic")
{
    const Grid terrain = rough();
    const auto body = ground(terrain, {{"base", -1.0}});
    std::mt19937 generator(3);
    int inside = 0;
    int count = 0;
    const auto check = [&](double x, double y) {
        const geometry::Exact height = exact_height(terrain, x, y);
        const double nearby = rounded(height);
        for (const double z : {test::just_below(nearby), nearby, test::just_above(nearby)}) {
            const bool expected = geometry::Exact(z) <= height;
            CHECK(body->contains({x, y, z}) == expected);
            inside += expected ? 1 : 0;
            ++count;
        }
    };
    std::uniform_real_distribution<double> across(terrain.x.front(), terrain.x.back());
    std::uniform_real_distribution<double> along(terrain.y.front(), terrain.y.back());
    for (int i = 0; i < 1000; ++i)
        check(across(generator), along(generator));
    for (const double x : terrain.x)
        check(x, along(generator)); // on the grid lines
    for (const double y : terrain.y)
        check(across(generator), y);
    for (std::size_t i = 1; i < terrain.x.size(); ++i)
        check((terrain.x[i - 1] + terrain.x[i]) / 2, (terrain.y[0] + terrain.y[1]) / 2); // beside the diagonal
    for (const double x : terrain.x)
        for (const double y : terrain.y)
            CHECK(body->contains({x, y, terrain.height(x, y)}));
    CHECK(inside > count / 4);
    CHECK(inside < 3 * count / 4);
}

TEST_CASE("the volume is that of the exact prisms")
{
    const Grid terrain = rough();
    geometry::Exact volume = 0;
    for (std::size_t i = 1; i < terrain.x.size(); ++i)
        for (std::size_t j = 1; j < terrain.y.size(); ++j) {
            const geometry::Exact dx = geometry::Exact(terrain.x[i]) - geometry::Exact(terrain.x[i - 1]);
            const geometry::Exact dy = geometry::Exact(terrain.y[j]) - geometry::Exact(terrain.y[j - 1]);
            const auto z = [&](std::size_t a, std::size_t b) -> geometry::Exact {
                return geometry::Exact(terrain.height(terrain.x[a], terrain.y[b])) + 1;
            };
            volume += dx * dy / 6 * (2 * z(i - 1, j - 1) + 2 * z(i, j) + z(i, j - 1) + z(i - 1, j));
        }
    CHECK(ground(terrain, {{"base", -1.0}})->volume() == doctest::Approx(rounded(volume)).epsilon(1e-15).scale(0.0));
}

TEST_CASE("an ESRI grid has its heights in the centres of its cells, rows from the north")
{
    const std::string heights = "1 2 3\n4 5 6\n";
    const auto body = ground("terrain.asc", esri(heights), {{"base", 0.0}});
    CHECK(body->bounds().lower == Vector3(11.0, 21.0, 0.0));
    CHECK(body->bounds().upper == Vector3(15.0, 23.0, 6.0));
    const auto is_height = [&](double x, double y, double z) {
        return body->contains({x, y, z}) && !body->contains({x, y, test::just_above(z)});
    };
    CHECK(is_height(11.0, 23.0, 1.0));
    CHECK(is_height(15.0, 23.0, 3.0));
    CHECK(is_height(11.0, 21.0, 4.0));
    CHECK(is_height(15.0, 21.0, 6.0));
    CHECK(is_height(13.0, 22.0, 3.5));

    const auto centred = ground("terrain.ASC", "NCOLS 3\nNROWS 2\nXLLCENTER 10\nYLLCENTER 20\nCELLSIZE 2\r\n" + heights,
                                {{"base", 0.0}});
    CHECK(centred->bounds().lower == Vector3(10.0, 20.0, 0.0));
    CHECK(centred->volume() == body->volume());
}

TEST_CASE("the columns of a CSV file may have any order, blanks, and lines that end as under Windows")
{
    const auto body =
        ground("terrain.csv", "Z,X,Y\r\n1.5,0,0\r\n 1.5 , +1e0 , 0\r\n\r\n1.5,1,2\r\n1.5,0,2\r\n", {{"base", 0.5}});
    CHECK(body->volume() == 2.0);
    CHECK(body->bounds().upper == Vector3(1.0, 2.0, 1.5));
}

TEST_CASE("an extent cuts out a rectangle, and a shift moves it to the model, bottom and all")
{
    const Height plane = [](double x, double y) { return 300.0 + (x - 452000.0) + 2.0 * (y - 5412000.0); };
    const Grid grid{{452000.0, 452010.0, 452020.0, 452030.0}, {5412000.0, 5412010.0, 5412020.0}, plane};
    const auto body = ground(grid, {{"base", 290.0},
                                    {"extent", List{452010.0, 5412000.0, 452030.0, 5412010.0}},
                                    {"shift", List{-452010.0, -5412000.0, -290.0}}});
    CHECK(body->bounds().lower == Vector3(0.0, 0.0, 0.0));
    CHECK(body->bounds().upper == Vector3(20.0, 10.0, 60.0));
    CHECK(body->volume() == 200.0 * 40.0); // 300 + 20 + 10 - 290 in the middle
}

TEST_CASE("an extent leaves out what has no height")
{
    const std::string heights = "-9999 2 3\n4 5 6\n";
    const List clear{13.0, 21.0, 15.0, 23.0};
    CHECK(ground("terrain.asc", esri(heights), {{"base", 1.0}, {"extent", clear}})->volume() ==
          4.0 / 6.0 * (2 * 4.0 + 2 * 2.0 + 5.0 + 1.0));
    test::check_mentions(refusal("terrain.asc", esri(heights)),
                         {"terrain.asc: there is no height at row 1, column 1 (x = 11, y = 23)", "\"extent\""});
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 5 -1\n", "NODATA_value -1\n")), {"row 2, column 3"});
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 nan 1\n")), {"row 2, column 2"});
    test::check_mentions(refusal("terrain.csv", "x,y,z\n0,0,1\n1,0,\n0,1,1\n1,1,1\n"),
                         {"terrain.csv: there is no height at row 2, column 2 (x = 1, y = 0)"});
    // Rows and columns are still those of the file.
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 5 -9999\n"), {{"base", 0.0}, {"extent", clear}}),
                         {"row 2, column 3 (x = 15, y = 21)"});
}

TEST_CASE("an extent off the grid lines is refused with the nearest one")
{
    const auto with = [](const List& extent) {
        return refusal("terrain.asc", esri("1 2 3\n4 5 6\n"), {{"base", 0.0}, {"extent", extent}});
    };
    test::check_mentions(with({11.4, 21.0, 15.0, 23.0}),
                         {"terrain.asc: the extent must end on grid lines", "x = 11.4 is none, the nearest is 11"});
    test::check_mentions(with({11.0, 21.0, 15.0, 25.0}), {"y = 25 is none, the nearest is 23"});
    test::check_mentions(with({15.0, 21.0, 11.0, 23.0}), {"must have x0 below x1; they are 15 and 11"});
}

TEST_CASE("a terrain on or below its bottom is refused with the place")
{
    test::check_mentions(refusal("terrain.asc", esri("9 9 9\n9 5 9\n"), {{"base", 5.0}}),
                         {"terrain.asc: the terrain must lie above the bottom; at row 2, column 2 (x = 13, y = 21)",
                          "it is at 5 m and the bottom at 5 m"});
    const test::TemporaryFolder folder;
    const std::string terrain = file_in(folder, "terrain.asc", esri("9 9 9\n9 9 9\n"));
    const auto with_bottom = [&](const std::string& heights, const std::string& more = "") {
        return test::message_of_error([&] {
            test::geometry("heightfield",
                           {{"file", terrain}, {"bottom_file", file_in(folder, "bottom.asc", more + esri(heights))}});
        });
    };
    test::check_mentions(with_bottom("1 2 10\n4 5 6\n"), {"row 1, column 3", "it is at 9 m and the bottom at 10 m"});
    test::check_mentions(with_bottom("1 2 -9999\n4 5 6\n"), {"bottom.asc: there is no height at row 1, column 3"});
}

TEST_CASE("a thickness that rounding swallows is refused")
{
    const Grid high{{0.0, 1.0}, {0.0, 1.0}, [](double, double) { return 1e10; }};
    test::check_mentions(refusal("terrain.csv", csv(high), {{"thickness", 1e-7}}), {"must lie above the bottom"});
}

TEST_CASE("a bottom on other grid lines is refused")
{
    const test::TemporaryFolder folder;
    const Height flat = [](double, double) { return 0.0; };
    const auto message = [&](const Grid& bottom) {
        const Grid terrain{{0.0, 1.0, 2.0}, {0.0, 1.0}, [](double, double) { return 1.0; }};
        return test::message_of_error([&] {
            test::geometry("heightfield", {{"file", file_in(folder, "terrain.csv", csv(terrain))},
                                           {"bottom_file", file_in(folder, "bottom.csv", csv(bottom))}});
        });
    };
    test::check_mentions(message({{0.0, 1.0}, {0.0, 1.0}, flat}),
                         {"bottom.csv: must have the grid lines of ", "terrain.csv, but has 2 and not 3 along x"});
    test::check_mentions(message({{0.0, 1.0, 2.0}, {0.0, 1.5}, flat}), {"has y = 1.5 where that has 1"});
}

TEST_CASE("exactly one bottom must be given")
{
    const std::string heights = esri("1 2 3\n4 5 6\n");
    for (const Given& given : {Given{}, Given{{"base", 0.0}, {"thickness", 1.0}}})
        test::check_mentions(refusal("terrain.asc", heights, given),
                             {"exactly one of base, thickness and bottom_file"});
}

TEST_CASE("a shift that makes grid lines one is refused")
{
    test::check_mentions(
        refusal("terrain.asc", esri("1 2 3\n4 5 6\n"), {{"base", 0.0}, {"shift", List{1e17, 0.0, 0.0}}}),
        {"terrain.asc: the grid lines x = 1", "cannot be told apart"});
}

TEST_CASE("faults of an ESRI grid are refused with the line or the place")
{
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 5\n")),
                         {"the file ends before row 2, column 3; its header promises 2 rows of 3 heights"});
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 5 6\n7\n")), {"line 8: there are more heights"});
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 5,5 6\n")), {"line 7: \"5,5\" is not a number"});
    test::check_mentions(refusal("terrain.asc", esri("1 2 3\n4 5 6\n", "dx 3\n")),
                         {"line 6: \"dx\" is none of the keys"});
    test::check_mentions(refusal("terrain.asc", "ncols 3\nnrows two\n"), {"line 2: nrows must be a number", "\"two\""});
    test::check_mentions(refusal("terrain.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2 3 4 5 6\n"),
                         {"the header of the ESRI ASCII grid has no cellsize"});
    test::check_mentions(refusal("terrain.asc", "ncols 1\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n"),
                         {"ncols must be a whole number from 2 on, it is 1"});
    test::check_mentions(refusal("terrain.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n1 2\n"),
                         {"cellsize must be positive"});
    test::check_mentions(refusal("terrain.asc", "ncols 30000\nnrows 20000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n"),
                         {"too short for 20000 rows of 30000 heights"});
    test::check_mentions(refusal("terrain.asc", ""), {"has no ncols"});
    test::check_mentions(refusal("terrain.tif", ""), {"must be .asc (ESRI ASCII grid) or .csv"});
    test::check_mentions(test::message_of_error([] {
                             test::geometry("heightfield", {{"file", std::string("/nowhere/a.asc")}, {"base", 0.0}});
                         }),
                         {"/nowhere/a.asc: cannot be opened"});
}

TEST_CASE("faults of a CSV grid are refused with the line")
{
    const std::string head = "x,y,z\n0,0,1\n1,0,1\n";
    test::check_mentions(refusal("terrain.csv", head + "0,1,1\n1.5,1,1\n"),
                         {"terrain.csv: line 3: x = 1 is shared by 1 of the 2 points that it needs"});
    test::check_mentions(refusal("terrain.csv", head + "0,1,1\n"), {"line 3: x = 1 is shared by 1 of the 2 points"});
    test::check_mentions(refusal("terrain.csv", head + "0,1,1\n1,0,2\n1,1,1\n"), {"line 5 has the x and y of line 3"});
    test::check_mentions(refusal("terrain.csv", head + "0,1,one\n1,1,1\n"), {"line 4: \"one\" is not a number"});
    test::check_mentions(refusal("terrain.csv", head + "inf,1,1\n1,1,1\n"), {"line 4: \"inf\" is not a finite number"});
    test::check_mentions(refusal("terrain.csv", head + "0,1\n1,1,1\n"), {"line 4: \"0,1\" has 2 fields, not three"});
    test::check_mentions(refusal("terrain.csv", head), {"at least two lines along x and two along y"});
    test::check_mentions(refusal("terrain.csv", "x,y\n0,0\n"), {"line 1 must name the columns", "\"x,y\""});
    test::check_mentions(refusal("terrain.csv", ""), {"at least two lines"});
}

TEST_CASE("the distance from a flat layer is that from a block, and its normal the gradient")
{
    const Grid flat{{0.0, 0.5, 0.75, 1.0}, {0.0, 0.25, 1.0}, [](double, double) { return 2.0; }};
    const auto body = ground(flat, {{"base", 1.0}});
    test::SurfaceSamples samples;
    samples.add_block({0.0, 0.0, 1.0}, {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()}, 40);
    test::check_distance(*body, samples);
    test::check_gradient(*body);
}

TEST_CASE("above and below an inclined plane the distance is that from the plane")
{
    const auto body = ground(Grid{{0.0, 5.0, 10.0}, {0.0, 4.0, 10.0}, [](double x, double y) { return x - 0.5 * y; }},
                             {{"thickness", 8.0}});
    const Vector3 upwards = Vector3(-1.0, 0.5, 1.0).normalized();
    const Vector3 foot(5.5, 4.25, 3.375);
    for (const double distance : {-1.0, -0.125, 0.25, 2.0}) {
        Vector3 normal;
        CHECK(body->signed_distance(foot + distance * upwards, normal) == doctest::Approx(distance).epsilon(1e-14));
        CHECK((normal - upwards).norm() < 1e-13); // rounding of 1e-15 over the least distance, 0.125
    }
}

TEST_CASE("ground is filled with its volume exactly, in points inside")
{
    const auto body = ground(rough(), {{"base", -1.0}});
    const PointCloud cloud = body->fill(0.05);
    CHECK(test::moments(cloud).volume == doctest::Approx(body->volume()).epsilon(1e-13).scale(0.0));
    for (const Vector3& position : cloud.positions)
        CHECK(body->contains(position));
}
