// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Quantities with units: values, dimensions and refusals.
#include "periporo/units.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

using namespace periporo;

namespace {

std::string refusal(const std::string& text)
{
    try {
        parse_quantity(text);
    } catch (const std::invalid_argument& fault) {
        return fault.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

const std::vector<Dimension> named_dimensions{dimension::none,
                                              dimension::length,
                                              dimension::area,
                                              dimension::volume,
                                              dimension::time,
                                              dimension::mass,
                                              dimension::velocity,
                                              dimension::acceleration,
                                              dimension::density,
                                              dimension::force,
                                              dimension::energy,
                                              dimension::pressure,
                                              dimension::spring,
                                              dimension::pressure_per_length,
                                              dimension::dynamic_viscosity,
                                              dimension::squared_yield_viscosity};

} // namespace

TEST_CASE("a decimal prefix rounds once: the value is the double nearest to the number as written in SI")
{
    // Exact comparison on purpose: 5/1000 and the literal 0.005 are the same double, 5 * 0.001 need not be.
    CHECK(parse_quantity("5 mm").value == 0.005);
    CHECK(parse_quantity("120 mm").value == 0.12);
    CHECK(parse_quantity("2.5 mm").value == 0.0025);
    CHECK(parse_quantity("25 MPa").value == 25e6);
    CHECK(parse_quantity("20 ms").value == 0.02);
}

TEST_CASE("a quantity has the dimension of its unit")
{
    CHECK(parse_quantity("25 MPa").dimension == dimension::pressure);
    CHECK(parse_quantity("9.81 m/s2").dimension == dimension::acceleration);
    CHECK(parse_quantity("2200 kg/m3").dimension == dimension::density);
    CHECK(parse_quantity("1e3 Pa^3 s").dimension == dimension::squared_yield_viscosity);
    CHECK(parse_quantity("4 MN/m").dimension == dimension::spring);
    CHECK(parse_quantity("3 J/m3").dimension == dimension::pressure);
    CHECK(parse_quantity("10 MPa/mm").dimension == dimension::pressure_per_length);
}

TEST_CASE("a power applies to the prefix too")
{
    CHECK(parse_quantity("1 mm2").value == 1e-6);
    CHECK(parse_quantity("2 kPa3 s").value == 2e9);
    CHECK(parse_quantity("10 MPa/mm").value == 1e10);
    CHECK(parse_quantity("1 g/cm3").value == doctest::Approx(1000.0).epsilon(1e-15));
}

TEST_CASE("one unit may be spelled in several ways")
{
    for (const std::string text :
         {"3 m/s2", "3 m/s^2", "3 m s^-2", "3 m*s-2", "3m/s\u00b2", "+3  m/s/s", " 3 m\u00b7s^-2 "}) {
        CAPTURE(text);
        CHECK(parse_quantity(text).value == 3.0);
        CHECK(parse_quantity(text).dimension == dimension::acceleration);
    }
}

TEST_CASE("angles are in radian and no pure numbers, per cent are")
{
    CHECK(parse_quantity("180 deg").value == doctest::Approx(std::numbers::pi).epsilon(1e-15));
    CHECK(parse_quantity("1 rad").value == 1.0);
    CHECK(parse_quantity("30 deg").dimension == dimension::angle);
    CHECK(parse_quantity("30 deg/s").dimension == dimension::angular_velocity);
    CHECK(parse_quantity("1.5 %").value == 0.015);
    CHECK(parse_quantity("1.5 %").dimension == dimension::none);
}

TEST_CASE("a pure number may be an angle, but an angle is never a pure number")
{
    CHECK(fits(dimension::none, dimension::angle));
    CHECK(fits(dimension::rate, dimension::angular_velocity));
    CHECK_FALSE(fits(dimension::angle, dimension::none));
    CHECK_FALSE(fits(dimension::angular_velocity, dimension::rate));
    CHECK_FALSE(fits(dimension::length, dimension::angle));
}

TEST_CASE("units of time that are no powers of ten")
{
    CHECK(parse_quantity("2 min").value == 120.0);
    CHECK(parse_quantity("1 h").value == 3600.0);
    CHECK(parse_quantity("36 km/h").value == doctest::Approx(10.0).epsilon(1e-15));
}

TEST_CASE("a bare number has no dimension")
{
    CHECK(parse_quantity("-1.5e3").value == -1500.0);
    CHECK(parse_quantity("-1.5e3").dimension == dimension::none);
}

TEST_CASE("an unknown unit is refused with the nearest one")
{
    CHECK(contains(refusal("25 Mpa"), "did you mean 'MPa'"));
    CHECK(contains(refusal("2 kpa"), "did you mean 'kPa'"));
    CHECK(contains(refusal("2 sec"), "unknown unit 'sec'"));
}

TEST_CASE("the refusal shows the whole quantity")
{
    CHECK(contains(refusal("7 m/foo"), "\"7 m/foo\""));
}

TEST_CASE("a product after a division is refused, for it can be read in two ways")
{
    CHECK(contains(refusal("1 kg/m s"), "two ways"));
    CHECK(refusal("1 kg/m/s").empty());
}

TEST_CASE("what is no finite number is refused")
{
    for (const std::string text : {"", "MPa", "nan", "inf m", "-inf", "1e400", "0x10 m", "--1", "1e308 Tm"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_quantity(text), std::invalid_argument);
    }
}

TEST_CASE("malformed units are refused")
{
    for (const std::string text : {"1 m^", "1 m^x", "1 /s", "1 m//s", "1 m0", "1 m^99", "1 m *", "1 m^-", "1 m + m"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_quantity(text), std::invalid_argument);
    }
}

TEST_CASE("the SI unit of every named dimension reads back as one of that dimension")
{
    for (const Dimension& dimension : named_dimensions) {
        if (dimension == dimension::none)
            continue;
        const Quantity one = parse_quantity("1 " + si_unit(dimension));
        CAPTURE(si_unit(dimension));
        CHECK(one.value == 1.0);
        CHECK(one.dimension == dimension);
    }
}

TEST_CASE("the SI unit of a dimension without a name reads back as well")
{
    const Dimension odd{2, -1, -3};
    const Quantity one = parse_quantity("1 " + si_unit(odd));
    CHECK(one.value == 1.0);
    CHECK(one.dimension == odd);
}

TEST_CASE("all units that messages offer for a dimension are of that dimension")
{
    for (const Dimension& dimension : named_dimensions) {
        if (dimension == dimension::none)
            continue; // begins with words
        const std::string units = known_units(dimension);
        for (std::size_t begin = 0; begin < units.size();) {
            const std::size_t end = std::min(units.find(", ", begin), units.size());
            const std::string unit = units.substr(begin, end - begin);
            CAPTURE(unit);
            CHECK(parse_quantity("1 " + unit).dimension == dimension);
            begin = end + 2;
        }
    }
}
