// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Each kind of error in a case: exit status 2, the place, a way out, and nothing written.
#include "cli/program.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace periporo::test;

namespace {

/// Runs the small case after one change and expects it to be refused at the place where `at` begins.
std::string refusal(const std::string& from, const std::string& to, const std::string& at)
{
    const ProgramFolder folder;
    const std::string text = with(small_case, from, to);
    folder.write("case.toml", text);
    const ProgramResult result = folder.run("run case.toml --out results");
    const LineColumn place = place_in(text, at);
    CAPTURE(result.error);
    CHECK(result.status == 2);
    CHECK(contains(result.error, fmt::format("case.toml:{}:{}: error: ", place.line, place.column)));
    CHECK(contains(result.error, "\n1 error; nothing was run\n"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
    return result.error;
}

} // namespace

TEST_CASE("a misspelt key")
{
    const std::string error = refusal("bulk_modulus", "bulk_modulos", "bulk_modulos");
    CHECK(contains(error, "did you mean 'bulk_modulus'?"));
    CHECK(contains(error, "shear_modulus (Pa)"));
}

TEST_CASE("a missing quantity")
{
    const std::string error = refusal("porosity = 0.2\n", "", "[material.rubber]");
    CHECK(contains(error, "missing key 'porosity'"));
}

TEST_CASE("a missing quantity of a plugin")
{
    const std::string error = refusal("friction = 0.5\n", "", "[[contact]]");
    CHECK(contains(error, "missing key 'friction'"));
}

TEST_CASE("a wrong unit")
{
    const std::string error = refusal("\"1 MPa\"\nshear", "\"1 MN\"\nshear", "\"1 MN\"");
    CHECK(contains(error, "units of N, Pa is expected"));
    CHECK(contains(error, "Pa, kPa, MPa, GPa"));
}

TEST_CASE("an unknown unit")
{
    CHECK(contains(refusal("\"0.5 MPa\"", "\"0.5 Mpa\"", "\"0.5 Mpa\""), "did you mean 'MPa'?"));
}

TEST_CASE("a wrong type")
{
    CHECK(contains(refusal("\"25 mm\"", "true", "true"), "'spacing' must be a number or a text with a unit"));
}

TEST_CASE("a value out of range")
{
    CHECK(contains(refusal("porosity = 0.2", "porosity = 1.2", "1.2"), "'porosity' must be >= 0 and < 1, not 1.2"));
}

TEST_CASE("an unknown plugin of each kind")
{
    CHECK(contains(refusal("\"box\"", "\"bux\"", "\"bux\""), "did you mean box?"));
    CHECK(contains(refusal("\"linear_elastic\"", "\"linear_elastik\"", "\"linear_elastik\""),
                   "did you mean linear_elastic?"));
    CHECK(contains(refusal("\"rigid_plane\"", "\"rigid_plan\"", "\"rigid_plan\""), "did you mean rigid_plane?"));
    CHECK(contains(refusal("\"hdf5\"", "\"hdf\"", "\"hdf\""), "did you mean hdf5?"));
}

TEST_CASE("an unknown choice")
{
    CHECK(contains(refusal("\"dynamic\"", "\"dinamic\"", "\"dinamic\""), "did you mean 'dynamic'?"));
}

TEST_CASE("a key given twice")
{
    const ProgramFolder folder;
    folder.write("case.toml", with(small_case, "porosity = 0.2", "porosity = 0.2\nporosity = 0.3"));
    const ProgramResult result = folder.run("run case.toml --out results");
    const std::size_t line = place_in(small_case, "porosity").line + 1;
    CHECK(result.status == 2);
    CHECK(contains(result.error, fmt::format("case.toml:{}:", line)));
    CHECK(contains(result.error, "porosity"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
}

TEST_CASE("a syntax error")
{
    const ProgramFolder folder;
    folder.write("case.toml", with(small_case, "porosity = 0.2", "porosity = = 0.2"));
    const ProgramResult result = folder.run("check case.toml");
    CHECK(result.status == 2);
    CHECK(contains(result.error, fmt::format("case.toml:{}:", place_in(small_case, "porosity").line)));
    CHECK(contains(result.error, "| porosity = = 0.2\n"));
}

TEST_CASE("a contact with an unknown body")
{
    CHECK(contains(refusal("[\"block\"]", "[\"blok\"]", "\"blok\""), "did you mean 'block'?"));
}

TEST_CASE("a body of an unknown material")
{
    CHECK(contains(refusal("\"rubber\"", "\"ruber\"", "\"ruber\""), "did you mean 'rubber'?"));
}

TEST_CASE("parameters that a plugin refuses together")
{
    const std::string error = refusal("modulus = \"1 MPa\"\nfriction", "friction", "[[contact]]");
    CHECK(contains(error, "modulus"));
}

TEST_CASE("an unknown key of an override shows the override")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    const ProgramResult result = folder.run("run case.toml --out results --set material.rubber.porsity=0.1");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "--set material.rubber.porsity=0.1: error: unknown key 'porsity'"));
    CHECK(contains(result.error, "did you mean 'porosity'?"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
}

TEST_CASE("several errors in one go")
{
    const ProgramFolder folder;
    std::string text = with(small_case, "bulk_modulus", "bulk_modulos");
    text = with(text, "\"25 mm\"", "\"25 s\"");
    text = with(text, "\"box\"", "\"bux\"");
    folder.write("case.toml", text);
    const ProgramResult result = folder.run("check case.toml");
    CHECK(result.status == 2);
    for (const char* at : {"\"25 s\"", "bulk_modulos", "\"bux\""}) {
        const LineColumn place = place_in(text, at);
        CHECK(contains(result.error, fmt::format("case.toml:{}:{}: error: ", place.line, place.column)));
    }
    CHECK(contains(result.error, "\n3 errors; nothing was run\n"));
}
