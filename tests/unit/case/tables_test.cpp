// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of tables: unknown and missing keys, unknown plugins, tables of the wrong shape.
#include "unit/case/case_support.hpp"

#include <tuple>

using namespace periporo;
using namespace periporo::test;

TEST_CASE("a misspelt key is one error at the key, with the nearest name and the allowed ones with their units")
{
    const std::string text = with(minimal_case, "stiffness", "stifness");
    const CaseDiagnostic error = error_of(text); // the missing 'stiffness' is not reported a second time
    CHECK(place_of(error) == place_in(text, "stifness"));
    CHECK(contains(error.message, "unknown key 'stifness' in [material.soil]"));
    CHECK(contains(error.hint, "did you mean 'stiffness'?"));
    CHECK(contains(error.hint, "stiffness (Pa)"));
    CHECK(contains(error.hint, "grain_density (kg/m3)"));
}

TEST_CASE("an unknown key is an error in every section")
{
    for (const std::string header :
         {"[discretization]\nspacing = \"5 mm\"\n", "[material.soil]\n", "[body.heap]\n", "[[stage]]\n"}) {
        CAPTURE(header);
        const std::string text = with(minimal_case, header, header + "nonsense_of_mine = 1\n");
        CHECK(place_of(error_of(text)) == place_in(text, "nonsense_of_mine"));
    }
    for (const std::string section : {"operator", "time", "run", "plugins"}) {
        CAPTURE(section);
        const std::string text = minimal_case + "[" + section + "]\nnonsense_of_mine = 1\n";
        CHECK(place_of(error_of(text)) == place_in(text, "nonsense_of_mine"));
    }
}

TEST_CASE("an unknown section is an error with the nearest one")
{
    const CaseDiagnostic error = error_of(minimal_case + "[[bondary]]\ntype = \"symmetry\"\n");
    CHECK(contains(error.message, "unknown key 'bondary'"));
    CHECK(contains(error.hint, "did you mean 'boundary'?"));
}

TEST_CASE("an unknown key of an inline table is found at its own place")
{
    const std::string text = with(minimal_case, "outer = \"2 cm\"", "outer = \"2 cm\", center = [0, 0, 0]");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "center"));
    CHECK(contains(error.hint, "did you mean 'centre'?"));
    CHECK(contains(error.message, "[body.heap.geometry]"));
}

TEST_CASE("a missing quantity is an error at the header of its table, with what it means and its unit")
{
    for (const auto& [line, key, unit] : std::vector<std::tuple<std::string, std::string, std::string>>{
             {"porosity = 0.2\n", "porosity", "number"},
             {"grain_density = 2200\n", "grain_density", "kg/m3"},
             {"stiffness = \"25 MPa\"\n", "stiffness", "Pa"}}) {
        CAPTURE(key);
        const std::string text = with(minimal_case, line, "");
        const CaseDiagnostic error = error_of(text);
        CHECK(place_of(error) == place_in(text, "[material.soil]"));
        CHECK(contains(error.message, "missing key '" + key + "'"));
        CHECK(contains(error.hint, unit));
    }
}

TEST_CASE("the spacing is never taken for granted")
{
    const std::string text = with(minimal_case, "spacing = \"5 mm\"\n", "");
    CHECK(place_of(error_of(text)) == place_in(text, "[discretization]"));
}

TEST_CASE("a geostatic stress needs its K0, at its own table")
{
    const std::string text = with(minimal_case, "[[stage]]", "initial_stress = { type = \"geostatic\" }\n[[stage]]");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "{ type"));
    CHECK(contains(error.message, "'K0'"));
}

TEST_CASE("K0 without a geostatic stress is an error that says where it belongs")
{
    const std::string text =
        with(minimal_case, "[[stage]]", "initial_stress = { type = \"zero\", K0 = 0.5 }\n[[stage]]");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "K0"));
    CHECK(contains(error.hint, "geostatic"));
}

TEST_CASE("a dynamic stage needs a duration")
{
    const std::string text = with(minimal_case, "duration = \"0.5 s\"\n", "");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "[[stage]]"));
    CHECK(contains(error.message, "'duration'"));
}

TEST_CASE("keys of quasi-static stages are refused in dynamic ones")
{
    for (const std::string line :
         {"rollers = [\"x = 1 m\"]", "damping = 0.5", "maximum_steps = 5", "response = \"full\""}) {
        CAPTURE(line);
        const std::string text = minimal_case + line + "\n";
        const CaseDiagnostic error = error_of(text);
        CHECK(place_of(error) == place_in(text, line));
        CHECK(contains(error.message, "does not belong to type = \"dynamic\""));
        CHECK(contains(error.hint, "quasi_static"));
    }
}

TEST_CASE("a stage cannot wait for what its type does not know")
{
    const std::string dynamic = minimal_case + "until = { residual = 1e-3 }\n"; // without a rest speed
    CHECK(place_of(error_of(dynamic)) == place_in(dynamic, "1e-3 }"));
    const std::string settling = with(minimal_case, "type = \"dynamic\"\nduration = \"0.5 s\"",
                                      "type = \"quasi_static\"\nuntil = { rest_speed = \"1 mm/s\" }");
    CHECK(place_of(error_of(settling)) == place_in(settling, "rest_speed"));
}

TEST_CASE("when the type of a stage is wrong its other keys are not judged")
{
    const std::string text = with(minimal_case, "\"dynamic\"", "\"dinamic\"");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "\"dinamic\""));
    CHECK(contains(error.hint, "did you mean 'dynamic'?"));
}

TEST_CASE("an unknown plugin is one error with the nearest name and where was looked, and its keys are not judged")
{
    const std::string text = with(minimal_case, "test_clay", "test_klay");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "\"test_klay\""));
    CHECK(contains(error.message, "test_klay"));
    CHECK(contains(error.message + error.hint, "test_clay"));
    CHECK(contains(error.hint, "searched"));
}

TEST_CASE("without the key that names a plugin that key alone is missing")
{
    const std::string text = with(minimal_case, "model = \"test_clay\"\n", "");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "[material.soil]"));
    CHECK(contains(error.message, "'model'"));
}

TEST_CASE("what a plugin refuses in its constructor is an error at its table")
{
    const std::string text = with(minimal_case, "\"1 cm\"", "\"3 cm\"");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "{ generator"));
    CHECK(contains(error.message, "the inner radius must be smaller"));
}

TEST_CASE("an old name beside the new one is an error")
{
    const std::string text = with(minimal_case, "stiffness = ", "modulus = 1e6\nstiffness = ");
    CHECK(place_of(error_of(text)) == place_in(text, "modulus"));
}

TEST_CASE("sections that every case needs are missed by name")
{
    for (const std::string section : {"[discretization]", "[material.NAME]", "[body.NAME]", "[[stage]]"}) {
        const std::vector<CaseDiagnostic> errors = errors_of("title = \"empty\"\n");
        CAPTURE(section);
        CHECK(std::any_of(errors.begin(), errors.end(),
                          [&](const CaseDiagnostic& error) { return contains(error.message, "missing " + section); }));
    }
}

TEST_CASE("a single table where a list is due is shown the brackets")
{
    const std::string text = with(minimal_case, "[[stage]]", "[stage]");
    const CaseDiagnostic error = error_of(text);
    CHECK(contains(error.message, "[[stage]]"));
}

TEST_CASE("a material without a name is shown where the name goes")
{
    const std::vector<CaseDiagnostic> errors = errors_of(with(minimal_case, "[material.soil]", "[material]"));
    CHECK(std::any_of(errors.begin(), errors.end(),
                      [](const CaseDiagnostic& error) { return contains(error.hint, "[material.NAME]"); }));
}

TEST_CASE("a name that an override could not write is refused")
{
    const std::string text = with(minimal_case, "[material.soil]", "[material.\"so.il\"]");
    const std::vector<CaseDiagnostic> errors = errors_of(text);
    CHECK(std::any_of(errors.begin(), errors.end(), [](const CaseDiagnostic& error) {
        return contains(error.message, "\"so.il\" cannot be the name");
    }));
}

TEST_CASE("all errors of a file come in one go, in the order of their places")
{
    std::string text = with(minimal_case, "\"5 mm\"", "\"5 kg\"");
    text = with(text, "porosity = 0.2", "porosity = 2");
    text = with(text, "material = \"soil\"", "material = \"soul\"");
    text = with(text, "duration", "durration");
    const std::vector<CaseDiagnostic> errors = errors_of(text);
    REQUIRE(errors.size() == 4);
    CHECK(place_of(errors[0]) == place_in(text, "\"5 kg\""));
    CHECK(place_of(errors[1]) == place_in(text, "2\nstiff"));
    CHECK(place_of(errors[2]) == place_in(text, "\"soul\""));
    CHECK(place_of(errors[3]) == place_in(text, "durration"));
}
