// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parameter values from what is given and what is declared.
#include "periporo/kit/parameters.hpp"

#include "support/errors.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

const std::vector<Parameter> records = {
    Parameter::real("stiffness", dimension::pressure, "Young's modulus").above(0.0),
    Parameter::real("density", dimension::density, "Density"), Parameter::integer("exponent", "Exponent").by_default(2),
    Parameter::text("surface", "Yield surface").one_of({"ellipse", "cone"}).by_default("ellipse"),
    Parameter::real("cohesion", dimension::pressure, "Cohesion").optional()};

std::string objection(std::map<std::string, ParameterValue> given)
{
    try {
        kit::parameters_of(records, std::move(given));
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("given values stand over defaults, and an optional parameter may be absent")
{
    const Parameters values =
        kit::parameters_of(records, {{"stiffness", 2e6}, {"density", 1e3}, {"surface", std::string("cone")}});
    CHECK(values.real("stiffness") == 2e6);
    CHECK(values.integer("exponent") == 2);
    CHECK(values.text("surface") == "cone");
    CHECK_FALSE(values.has("cohesion"));
}

TEST_CASE("a whole number may be given for a real")
{
    const Parameters values = kit::parameters_of(records, {{"stiffness", std::int64_t(3)}, {"density", 1e3}});
    CHECK(values.real("stiffness") == 3.0);
}

TEST_CASE("everything that is missing is named")
{
    check_mentions(objection({}), {"missing", "'stiffness'", "'density'"});
}

TEST_CASE("an unknown parameter is named")
{
    check_mentions(objection({{"stiffness", 2e6}, {"density", 1e3}, {"stifness", 1.0}}), {"no parameter 'stifness'"});
}

TEST_CASE("a value out of its range is named with the range")
{
    check_mentions(objection({{"stiffness", -1.0}, {"density", 1e3}}), {"'stiffness'", "> 0", "-1"});
}

TEST_CASE("a choice that is not offered is named with those that are")
{
    check_mentions(objection({{"stiffness", 2e6}, {"density", 1e3}, {"surface", std::string("egg")}}),
                   {"'surface'", "ellipse", "egg"});
}

TEST_CASE("a value of another type is refused")
{
    check_mentions(objection({{"stiffness", std::string("2 MPa")}, {"density", 1e3}}), {"'stiffness'", "real", "text"});
}
