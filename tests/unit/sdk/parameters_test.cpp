// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parameter records and checked values.
#include "periporo/parameters.hpp"
#include "periporo/plugin.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

using namespace periporo;

namespace {

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a parameter is required until it has a default or is optional")
{
    CHECK(Parameter::real("k", dimension::pressure, "K").required);
    CHECK_FALSE(Parameter::real("k", dimension::pressure, "K").by_default(1.0).required);
    const Parameter optional = Parameter::real("k", dimension::pressure, "K").optional();
    CHECK_FALSE(optional.required);
    CHECK_FALSE(optional.default_value.has_value());
}

TEST_CASE("a whole number as the default of a real becomes a real")
{
    const Parameter parameter = Parameter::real("n", dimension::none, "N").by_default(3);
    CHECK(std::get<double>(*parameter.default_value) == 3.0);
}

TEST_CASE("a text literal as a default is a text, not a boolean")
{
    const Parameter parameter = Parameter::text("t", "T").by_default("pair");
    CHECK(std::get<std::string>(*parameter.default_value) == "pair");
}

TEST_CASE("a default of another type is a fault of the plugin")
{
    CHECK_THROWS_AS(Parameter::integer("n", "N").by_default(0.5), std::logic_error);
    CHECK_THROWS_AS(Parameter::real("n", dimension::none, "N").by_default("x"), std::logic_error);
}

TEST_CASE("an excluded bound is outside and an included one inside")
{
    const Parameter above = Parameter::real("x", dimension::none, "X").above(0.0).below(1.0);
    CHECK_FALSE(above.objection(0.0).empty());
    CHECK_FALSE(above.objection(1.0).empty());
    CHECK(above.objection(0.5).empty());
    const Parameter from = Parameter::real("x", dimension::none, "X").at_least(0.0).at_most(1.0);
    CHECK(from.objection(0.0).empty());
    CHECK(from.objection(1.0).empty());
    CHECK_FALSE(from.objection(1.0000001).empty());
}

TEST_CASE("an objection names the range and the value with its unit")
{
    const std::string objection = Parameter::real("K", dimension::pressure, "K").above(0.0).objection(-3.0);
    CHECK(contains(objection, "> 0"));
    CHECK(contains(objection, "-3 Pa"));
}

TEST_CASE("what is not finite is outside of every range")
{
    const Parameter parameter = Parameter::real("x", dimension::none, "X");
    CHECK_FALSE(parameter.objection(std::numeric_limits<double>::quiet_NaN()).empty());
    CHECK_FALSE(parameter.objection(std::numeric_limits<double>::infinity()).empty());
}

TEST_CASE("the range of a list holds for each member and the size for the list")
{
    const Parameter sizes = Parameter::real_list("size", dimension::length, 3, "Edges").above(0.0);
    CHECK(sizes.objection(std::vector<double>{1.0, 1.0, 1.0}).empty());
    CHECK(contains(sizes.objection(std::vector<double>{1.0, 0.0, 1.0}), "> 0"));
    CHECK(contains(sizes.objection(std::vector<double>{1.0, 1.0}), "3 members"));
}

TEST_CASE("a text outside of the choices is objected to with all choices")
{
    const Parameter parameter = Parameter::text("normal", "Direction").one_of({"pair", "surface"});
    CHECK(parameter.objection(std::string("pair")).empty());
    CHECK(contains(parameter.objection(std::string("par")), "pair | surface"));
}

TEST_CASE("ranges in words")
{
    CHECK(Parameter::real("x", dimension::none, "X").range_text().empty());
    CHECK(Parameter::real("x", dimension::pressure, "X").above(0.0).range_text() == "> 0");
    CHECK(Parameter::real("x", dimension::none, "X").at_least(0.0).at_most(1.0).range_text() == "0 .. 1");
    CHECK(Parameter::real("x", dimension::none, "X").above(0.0).at_most(1.0).range_text() == "> 0 and <= 1");
    CHECK(Parameter::real("x", dimension::length, "X").at_most(2.0).range_text() == "<= 2 m");
}

TEST_CASE("asking for a value, or whether there is one, consumes it")
{
    Parameters parameters;
    parameters.set("a", 1.0);
    parameters.set("b", std::string("text"));
    CHECK(parameters.consumed().empty());
    CHECK(parameters.real("a") == 1.0);
    CHECK_FALSE(parameters.has("c"));
    CHECK(parameters.consumed() == std::set<std::string>{"a", "c"});
}

TEST_CASE("asking for what was not declared or is of another type is a fault of the plugin")
{
    Parameters parameters;
    parameters.set("n", std::int64_t{3});
    CHECK_THROWS_AS(parameters.real("n"), std::logic_error);
    CHECK_THROWS_AS(parameters.integer("m"), std::logic_error);
    CHECK(parameters.integer("n") == 3);
}

TEST_CASE("every kind of plugin has a name of its own")
{
    std::set<std::string> names;
    for (const PluginKind kind :
         {PluginKind::geometry, PluginKind::material, PluginKind::contact, PluginKind::retention, PluginKind::output})
        names.insert(kind_name(kind));
    CHECK(names == std::set<std::string>{"geometry", "material", "contact", "retention", "output"});
}
