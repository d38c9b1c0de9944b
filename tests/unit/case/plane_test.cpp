// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Coordinate planes as text.
#include "case/plane.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using namespace periporo;

TEST_CASE("a plane has an axis and an offset in metre")
{
    const PlaneDescription plane = parse_plane("y = -100 mm");
    CHECK(plane.axis == 1);
    CHECK(plane.offset == -0.1);
}

TEST_CASE("spaces do not matter and zero needs no unit")
{
    CHECK(parse_plane(" z=0").axis == 2);
    CHECK(parse_plane("z=0").offset == 0.0);
}

TEST_CASE("a cylinder about the vertical axis has a positive radius")
{
    CHECK(parse_plane("r = 100 mm").axis == cylinder_axis);
    CHECK(parse_plane("r = 100 mm").offset == 0.1);
    CHECK_THROWS_AS(parse_plane("r = -1 mm"), std::invalid_argument);
}

TEST_CASE("what is no plane is refused")
{
    for (const std::string text : {"", "x", "x =", "= 1 m", "w = 1 m", "xy = 1 m", "x = 1", "x = 1 s", "x == 1 m",
                                   "x = 1 m, y = 2 m", "2 x = 1 m"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_plane(text), std::invalid_argument);
    }
}

TEST_CASE("a written plane reads back to the very same offset")
{
    for (const double offset : {0.1, -1.0 / 3.0, 1e-300, 12345678.9, 0.0}) {
        const PlaneDescription plane = parse_plane(plane_text({2, offset}));
        CHECK(plane.axis == 2);
        CHECK(plane.offset == offset);
    }
}
