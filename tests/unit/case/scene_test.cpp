// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometries by name, obstacles, regions of points, files: what a case says of them and what it gets wrong.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

TEST_CASE("geometries, obstacles, held regions and fills arrive in the description")
{
    const CaseDescription read = read_text(full_case);
    REQUIRE(read.geometries.size() == 2);
    CHECK(read.geometries[1].name == "rim");
    CHECK(read.geometries[1].plugin.parameters.text_list("of") == std::vector<std::string>{"core"});
    REQUIRE(read.obstacles.size() == 1);
    CHECK(read.obstacles[0].velocity == Vector3(0.0, 0.0, 3e-3));
    CHECK(*read.obstacles[0].moves_in == std::vector<std::string>{"collapse"});
    CHECK(read.obstacles[0].stages.size() == 2);
    CHECK(read.boundaries.size() == 2);
    REQUIRE(read.held_regions.size() == 3);
    CHECK(read.held_regions[0].body == "heap");
    CHECK(read.held_regions[0].below->offset == 1e-3);
    CHECK(read.held_regions[1].layer[1].offset == 3e-3);
    CHECK((read.held_regions[1].direction - Vector3(0.0, 0.6, 0.8)).norm() < 1e-15);
    CHECK(read.held_regions[2].within == "rim");
    CHECK(read.held_regions[2].velocity == Vector3(1e-3, 2e-3, 0.0));
    CHECK(read.held_regions[2].stages == std::vector<std::string>{"settle"});
    CHECK(read.contacts[1].surface == "heap");
    CHECK(read.contacts[2].between[1] == "plate");
    CHECK(read.bodies[0].fill.kind == FillKind::jittered);
    CHECK(read.bodies[0].fill.align == LatticeAxes::axes);
    CHECK(read.bodies[0].fill.amplitude == 0.1);
    CHECK(read.bodies[0].fill.seed == 5);
    CHECK(read.bodies[1].fill.iterations == 7);
}

TEST_CASE("a name that nothing has is an error at its place, with the nearest one")
{
    const auto check = [](const char* right, const std::string& wrong, const char* hint) {
        CAPTURE(wrong);
        const std::string text = with(full_case, right, wrong);
        const CaseDiagnostic error = error_of(text);
        CHECK(contains(error.hint, hint));
        CHECK(place_of(error) == place_in(text, wrong.substr(wrong.rfind('"', wrong.size() - 3))));
    };
    check("of = [\"rim\"]", "of = [\"rin\"]", "did you mean 'rim'?");
    check("moves_in = [\"collapse\"]", "moves_in = [\"colapse\"]", "did you mean 'collapse'?");
    const std::string within = with(full_case, "within = \"rim\"", "within = \"rum\"");
    CHECK(place_of(error_of(within)) == place_in(within, "\"rum\""));
    const std::string body = with(full_case, "body = \"heap\"", "body = \"hip\"");
    CHECK(contains(error_of(body).hint, "bodies of the case: heap, bubble"));
}

TEST_CASE("a geometry that is made of itself is an error, however long the way")
{
    const std::string text = with(full_case, "generator = \"test_shell\"\ninner = \"3 mm\"\nouter = \"4 mm\"",
                                  "generator = \"test_union\"\nof = [\"rim\"]");
    const std::vector<CaseDiagnostic> errors = errors_of(text);
    REQUIRE(errors.size() == 2); // core and rim
    CHECK(contains(errors[0].message, "[geometry.core] is made of itself"));
}

TEST_CASE("a held region says which points, a layer which planes, a roller a direction")
{
    const auto message = [](const char* right, const char* wrong) {
        return error_of(with(full_case, right, wrong)).message;
    };
    CHECK(contains(message("within = \"rim\"\n", ""), "does not say which points"));
    CHECK(contains(message("[\"z = 2 mm\", \"z = 3 mm\"]", "[\"z = 2 mm\", \"x = 3 mm\"]"), "two planes of one axis"));
    CHECK(contains(message("[\"z = 2 mm\", \"z = 3 mm\"]", "[\"z = 3 mm\", \"z = 2 mm\"]"), "two planes of one axis"));
    CHECK(contains(message("[\"z = 2 mm\", \"z = 3 mm\"]", "[\"r = 2 mm\", \"r = 3 mm\"]"), "two planes of one axis"));
    CHECK(contains(message("[0, 3, 4]", "[0, 0, 0]"), "must not be zero"));
}

TEST_CASE("a smoothed surface is that of one of two bodies, and obstacles do not meet each other")
{
    const auto message = [](const char* right, const char* wrong) {
        return error_of(with(full_case, right, wrong)).message;
    };
    CHECK(contains(message("surface = \"heap\"", "surface = \"plate\""), "one of the two bodies"));
    CHECK(contains(message("[\"bubble\", \"heap\"]", "[\"heap\", \"heap\"]"), "one of the two bodies"));
    CHECK(contains(message("[\"heap\", \"plate\"]", "[\"plate\"]"), "needs a body"));
}

TEST_CASE("a body and an obstacle cannot have one name")
{
    std::string text = with(full_case, "[obstacle.plate]", "[obstacle.bubble]");
    text = with(text, "[\"heap\", \"plate\"]", "[\"heap\"]");
    CHECK(contains(error_of(text).message, "a body has the name 'bubble' too"));
}

TEST_CASE("a file is looked for beside the case that names it, and must be there")
{
    const std::string text =
        with(minimal_case, "geometry = { generator = \"test_shell\", inner = \"1 cm\", outer = \"2 cm\" }",
             "geometry = { generator = \"test_scan\", file = \"data/scan.csv\" }");
    const TemporaryFolder folder;
    write_file(folder / "case.toml", text);
    PluginRegistry registry = test_registry();
    try {
        read_case(folder / "case.toml", {}, registry);
        FAIL("the file is not there");
    } catch (const CaseError& error) {
        REQUIRE(error.diagnostics().size() == 1);
        CHECK(contains(error.diagnostics()[0].message, "there is no file " + (folder / "data/scan.csv").string()));
        CHECK(place_of(error.diagnostics()[0]) == place_in(text, "\"data/scan.csv\""));
    }
    write_file(folder / "data/scan.csv", "x\n");
    const CaseDescription read = read_case(folder / "case.toml", {}, registry);
    CHECK(read.bodies[0].geometry.parameters.text("file") == (folder / "data/scan.csv").string());
    // the resolved case holds the full path: it can be run from anywhere
    const TemporaryFolder elsewhere;
    write_file(elsewhere / "case.toml", read.resolved);
    CHECK(read_case(elsewhere / "case.toml", {}, registry).resolved == read.resolved);
}
