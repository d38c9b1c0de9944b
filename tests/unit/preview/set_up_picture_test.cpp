// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The picture of a case before it is run.
#include "case/reader.hpp"
#include "preview/set_up_picture.hpp"
#include "support/case_text.hpp"
#include "support/plugins.hpp"
#include "support/specimens.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

using namespace periporo;
using namespace periporo::test;

namespace {

/// Of the quickstart with a text of its own, which overrides it.
std::string picture_with(const std::string& text)
{
    const TemporaryFolder folder;
    write_file(folder / "case.toml",
               "include = [\"" PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart.toml\"]\n" + text);
    PluginRegistry registry;
    const CaseDescription description =
        read_case(folder / "case.toml", {{}, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry);
    draw_set_up(build_model(description, registry), description).save(folder / "set_up.svg");
    std::ifstream file(folder / "set_up.svg");
    std::stringstream picture;
    picture << file.rdbuf();
    return picture.str();
}

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

} // namespace

TEST_CASE("points that others hide on all six sides are not drawn")
{
    const Model cube = specimens::from_positions(specimens::lattice(5, 5, 5, 0.01), 0.01);
    CHECK(visible_points(cube).size() == 125 - 27);
    const Model sheet = specimens::from_positions(specimens::lattice(5, 5, 1, 0.01), 0.01);
    CHECK(visible_points(sheet).size() == 25);
    // what lies inside is seen where another body begins
    Model two = specimens::from_positions(specimens::lattice(3, 3, 6, 0.01), 0.01);
    two.state.bodies.push_back(two.state.bodies.front());
    for (std::size_t i = 0; i < two.size(); ++i)
        two.state.points.body[i] = two.state.points.position[i].z() > 0.03 ? 1 : 0;
    CHECK(visible_points(two).size() == 54 - 2);
}

TEST_CASE("the picture has every body and obstacle, sizes, boundaries, and its points in three views")
{
    const std::string text = picture_with("");
    CHECK(contains(text, "Dry soil column, a = 1.2, rough floor"));
    CHECK(contains(text, "body 'column' of 'soil': 1200 points, 0.0012 m3, 2.112 kg"));
    CHECK(contains(text, "100 x 100 x 120 mm; spacing 10 mm"));
    for (const char* axis : {"x [mm]", "y [mm]", "z [mm]"})
        CHECK(count_of(text, axis) >= 2);
    CHECK(count_of(text, ">symmetry<") == 3); // x = 0 from the front and from above, y = 0 from above
    CHECK(count_of(text, ">roller<") == 3);
    const std::size_t visible = 1200 - 8 * 8 * 10;
    CHECK(count_of(text, "<circle") == 3 * visible + 1); // and one in the legend
    CHECK(contains(text, "</svg>"));
}

TEST_CASE("obstacles are drawn, and points with a prescribed motion have a black rim")
{
    const std::string text = picture_with(R"(
title = "a < b & c"
[obstacle.floor]
geometry = { generator = "box", size = ["1 m", "1 m", "10 mm"], origin = [0, 0, "-10 mm"] }
velocity = [0, 0, "-1 m/s"]
[[boundary]]
type = "fixed"
plane = "z = 10 mm"
[[stage]]
name = "collapse"
type = "dynamic"
duration = "1 s"
)");
    CHECK(contains(text, "obstacle 'floor', moves with (0, 0, -1) m/s"));
    CHECK(contains(text, "a &lt; b &amp; c"));
    CHECK(count_of(text, "stroke=\"#000000\"") == 3 * 100); // the lowest layer, seen from below
    CHECK(contains(text, "#9a9a9a"));
}
