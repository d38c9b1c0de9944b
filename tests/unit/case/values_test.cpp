// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of single values: type, unit, range and choice, each at the place of the value.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

/// The error of the minimal case after a change, which must stand where `at` begins.
CaseDiagnostic error_at(const std::string& from, const std::string& to, const std::string& at)
{
    const std::string text = with(minimal_case, from, to);
    CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, at));
    return error;
}

} // namespace

TEST_CASE("a unit of another dimension is an error that says what was given and what is expected")
{
    const CaseDiagnostic error = error_at("\"25 MPa\"", "\"25 kN\"", "\"25 kN\"");
    CHECK(contains(error.message, "\"25 kN\""));
    CHECK(contains(error.message, "units of N, Pa is expected"));
    CHECK(contains(error.hint, "Pa, kPa, MPa, GPa"));
}

TEST_CASE("a text without a unit is an error for a quantity that has one")
{
    const CaseDiagnostic error = error_at("\"25 MPa\"", "\"25\"", "\"25\"");
    CHECK(contains(error.message, "has no unit"));
}

TEST_CASE("a unit is an error for a pure number")
{
    const CaseDiagnostic error = error_at("porosity = 0.2", "porosity = \"0.2 m\"", "\"0.2 m\"");
    CHECK(contains(error.message, "a pure number is expected"));
}

TEST_CASE("an unknown unit is an error with the nearest one")
{
    const CaseDiagnostic error = error_at("\"25 MPa\"", "\"25 Mpa\"", "\"25 Mpa\"");
    CHECK(contains(error.message, "did you mean 'MPa'"));
}

TEST_CASE("a value of another type is an error that names both types")
{
    const CaseDiagnostic error = error_at("\"25 MPa\"", "true", "true");
    CHECK(contains(error.message, "'stiffness' must be a number"));
    CHECK(contains(error.message, "not true or false"));
    CHECK(contains(error_at("\"25 MPa\"", "[25]", "[25]").message, "a list"));
    CHECK(contains(error_at("\"minimal\"", "7", "7").message, "'title' must be a text"));
}

TEST_CASE("a number with a fraction is no whole number, and a number is no boolean")
{
    CHECK(contains(error_at("porosity = 0.2", "porosity = 0.2\nexponent = 2.5", "2.5").message, "a whole number"));
    CHECK(contains(error_at("porosity = 0.2", "porosity = 0.2\nassociated = 1", "1\nst").message, "true or false"));
}

TEST_CASE("a value out of range is an error with the range")
{
    CHECK(contains(error_at("\"25 MPa\"", "\"-25 MPa\"", "\"-25 MPa\"").message, "must be > 0"));
    CHECK(contains(error_at("porosity = 0.2", "porosity = 1.2", "1.2").message, "1.2"));
    CHECK(contains(error_at("porosity = 0.2", "porosity = 0.2\nexponent = 10", "10\n").message, "1 .. 9"));
}

TEST_CASE("a number that is not finite is out of every range")
{
    CHECK(contains(error_at("porosity = 0.2", "porosity = nan", "nan").message, "finite"));
    CHECK(contains(error_at("\"25 MPa\"", "inf", "inf").message, "finite"));
}

TEST_CASE("an unknown choice is an error with the nearest and all choices")
{
    const CaseDiagnostic error = error_at("porosity = 0.2", "porosity = 0.2\nsurface = \"elipse\"", "\"elipse\"");
    CHECK(contains(error.message, "ellipse | cone"));
    CHECK(contains(error.hint, "did you mean 'ellipse'"));
}

TEST_CASE("a member of a list that is wrong is an error at the member")
{
    const std::string list = "gravity = [0, \"1 m/s2\", \"-9.81 m/s\"]\n[discretization]";
    CHECK(contains(error_at("[discretization]", list, "\"-9.81 m/s\"").message, "units of m/s"));
}

TEST_CASE("a list of another length is an error at the list")
{
    const CaseDiagnostic error = error_at("[discretization]", "gravity = [0, 0]\n[discretization]", "[0, 0]");
    CHECK(contains(error.message, "3 members, not 2"));
}

TEST_CASE("a plane that is none is an error at its text")
{
    const std::string stage = "type = \"quasi_static\"\nrollers = [\"x = 1 m\", \"w = 1 m\"]";
    const std::string text = with(minimal_case, "type = \"dynamic\"\nduration = \"0.5 s\"", stage);
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "\"w = 1 m\""));
    CHECK(contains(error.message, "is not a plane"));
}
