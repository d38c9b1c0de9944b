// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The water of bodies in a case: what is read, and what is refused.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

const std::string uniform = "water = { type = \"uniform\", suction = \"20 kPa\", saturation = 0.3 }";
/// The same sound case with gravity along one axis.
const std::string level_case = with(full_case, "[\"1 m/s2\", 0, \"-9.8 m/s2\"]", "[0, 0, \"-9.8 m/s2\"]");

std::string with_water(const std::string& water)
{
    return with(level_case, uniform, water);
}

} // namespace

TEST_CASE("a body is dry when nothing is said of its water")
{
    const CaseDescription read = read_text(minimal_case);
    CHECK(read.bodies.at(0).water.kind == WaterKind::dry);
    CHECK(!read.materials.at(0).retention);
}

TEST_CASE("a water table, a bound on the suction and a saturation are read")
{
    const WaterDescription water =
        read_text(
            with_water("water = { type = \"hydrostatic\", water_table = \"z = -2 m\", largest_suction = \"9 kPa\", "
                       "saturation = 0.4 }"))
            .bodies.at(0)
            .water;
    CHECK(water.kind == WaterKind::hydrostatic);
    CHECK(water.water_table.axis == 2);
    CHECK(water.water_table.offset == -2.0);
    CHECK(water.largest == 9e3);
    CHECK(water.saturation == 0.4);
}

TEST_CASE("the curve of a material and the changes of a stage are read")
{
    const CaseDescription read = read_text(full_case);
    REQUIRE(read.materials.at(1).retention);
    CHECK(read.materials.at(1).retention->name == "test_curve");
    CHECK(read.materials.at(1).retention->parameters.real("air_entry") == 3e3);
    CHECK(read.stages.at(0).water_changes.empty());
    REQUIRE(read.stages.at(1).water_changes.size() == 1);
    const WaterChangeDescription& change = read.stages.at(1).water_changes[0];
    CHECK(change.body == "bubble");
    CHECK(change.water.suction == 5e3);
    CHECK(change.over == 10e-3);
}

TEST_CASE("a change of the water takes the whole stage when nothing is said, and none of a quasi-static one")
{
    CHECK(read_text(with(full_case, "over = \"10 ms\"\n", "")).stages.at(1).water_changes.at(0).over == 0.5);
    const std::string settles = with(
        with(full_case,
             "[[stage.water]]\nbody = \"bubble\"\ntype = \"uniform\"\nsuction = \"5 kPa\"\nover = \"10 ms\"\n", ""),
        "response = \"full\"\n", "response = \"full\"\nwater = [{ body = \"bubble\", type = \"dry\" }]\n");
    CHECK(read_text(settles).stages.at(0).water_changes.at(0).over == 0.0);
    const std::string timed = with(settles, "type = \"dry\" }", "type = \"dry\", over = 1 }");
    CHECK(contains(error_of(timed).message, "has no time"));
}

TEST_CASE("suction needs to know the saturation, from the case or from a curve but not from both")
{
    const std::string silent = with_water("water = { type = \"uniform\", suction = \"20 kPa\" }");
    CHECK(contains(error_of(silent).message, "no retention curve"));
    CHECK(contains(error_of(silent).hint, "[material.soil.retention]"));
    const std::string empty = with_water("water = { type = \"uniform\", suction = \"20 kPa\", saturation = 0 }");
    CHECK(contains(error_of(empty).message, "without water there is no suction"));
    CHECK(errors_of(with_water("water = { type = \"uniform\", suction = 0, saturation = 0 }")).empty());
    const std::string twice = with(level_case, "suction = \"5 kPa\"\n", "suction = \"5 kPa\"\nsaturation = 0.2\n");
    CHECK(contains(error_of(twice).message, "retention curve of material 'air'"));
    CHECK(place_of(error_of(twice)) == place_in(twice, "0.2\nover"));
}

TEST_CASE("a water table lies at right angles to gravity")
{
    const std::string water = "water = { type = \"hydrostatic\", water_table = \"z = 0\", saturation = 0.4 }";
    CHECK(errors_of(with(level_case, uniform, water)).empty());
    for (const std::string& text : {with(full_case, uniform, water), with_water(with(water, "z = 0", "x = 0")),
                                    with_water(with(water, "z = 0", "y = 0"))})
        CHECK(contains(error_of(text).message, "right angles to gravity"));
}

TEST_CASE("a stage changes the water of bodies that are there, each once")
{
    const std::string change = "body = \"bubble\"\ntype = \"uniform\"\nsuction = \"5 kPa\"\n";
    const std::string wrong = with(full_case, change, with(change, "bubble", "buble"));
    CHECK(place_of(error_of(wrong)) == place_in(wrong, "\"buble\""));
    CHECK(contains(error_of(wrong).hint, "did you mean 'bubble'?"));
    const std::string again = with(full_case, "over = \"10 ms\"\n", "over = \"10 ms\"\n[[stage.water]]\n" + change);
    CHECK(contains(error_of(again).message, "changes twice"));
}
