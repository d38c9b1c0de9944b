// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Van Genuchten's curve over suction and porosity: how the air-entry value follows the void ratio.
#include "retention_checks.hpp"

#include <limits>

using namespace periporo;
using test::retention;
using test::rounded;

namespace {

const double air_entry = 20e3; // [Pa] at a porosity of 0.4, which is a void ratio of 2/3
const double psi = 4.0;
const test::Given shape{
    {"air_entry", air_entry}, {"exponent", 1.8}, {"residual_saturation", 0.05}, {"full_saturation", 0.95}};
const test::Given soil = test::changed(shape, {{"reference_porosity", 0.4}, {"void_ratio_exponent", psi}});
const double porosities[] = {0.05, 0.2, 0.35, 0.4, 0.45, 0.6, 0.9};

std::unique_ptr<Retention> curve(const test::Given& changes = {})
{
    return retention("van_genuchten_porosity", test::changed(soil, changes));
}

/// e/e0
double looseness(double porosity)
{
    return porosity / (1.0 - porosity) / (2.0 / 3.0);
}

} // namespace

TEST_CASE("at every porosity the curve is the plain one at the suction s (e/e0)^psi")
{
    const auto plain = retention("van_genuchten", shape);
    const auto law = curve();
    for (const double porosity : porosities)
        for (double suction = 1e-3; suction < 1e12; suction *= 3.0) {
            const double scaled = suction * std::pow(looseness(porosity), psi);
            CHECK(law->saturation(suction, porosity) == rounded(plain->saturation(scaled, porosity)));
        }
}

TEST_CASE("a second exponent goes into the shape")
{
    const auto plain = retention("van_genuchten", test::changed(shape, {{"m", 0.2}}));
    CHECK(curve({{"m", 0.2}})->saturation(5e4, 0.4) == rounded(plain->saturation(5e4, 0.4)));
}

TEST_CASE("compacted Speswhite kaolin, in the form and with the constants of Gallipoli et al. (2003)")
{
    const double k = 0.02691e-3, power = 8.433, n = 3.746, m = 0.03586; // k [1/Pa]
    const auto kaolin = retention("van_genuchten_porosity", {{"air_entry", 1.0 / k},
                                                             {"reference_porosity", 0.5}, // v - 1 = 1
                                                             {"void_ratio_exponent", power},
                                                             {"exponent", n},
                                                             {"m", m}});
    for (const double v : {1.8, 1.9, 2.0, 2.1, 2.2, 2.3})
        for (const double suction : {1e3, 1e4, 1e5, 3e5}) {
            const double expected = std::pow(1.0 + std::pow(k * std::pow(v - 1.0, power) * suction, n), -m);
            CHECK(kaolin->saturation(suction, 1.0 - 1.0 / v) == rounded(expected));
        }
}

TEST_CASE("into denser soil air enters at a higher suction, s_a0 (e0/e)^psi, and at one suction it holds more water")
{
    const auto law = curve();
    double last_entry = std::numeric_limits<double>::infinity();
    double last_saturation = 1.0;
    for (const double porosity : porosities) {
        CAPTURE(porosity);
        const double entry = air_entry * std::pow(looseness(porosity), -psi);
        CHECK(law->saturation(entry, porosity) == rounded(0.05 + 0.9 * std::pow(2.0, -(1.0 - 1.0 / 1.8)))); // 2^-m
        CHECK(entry < last_entry);
        const double saturation = law->saturation(20e3, porosity);
        CHECK(saturation < last_saturation);
        last_entry = entry;
        last_saturation = saturation;
    }
}

TEST_CASE("at each porosity saturation falls from exactly the full one over 18 decades of suction")
{
    const auto law = curve();
    for (const double porosity : porosities)
        test::check_falls(*law, porosity, 0.05, 0.95);
}

TEST_CASE("soil without voids is saturated at any suction, and where all is void only zero suction saturates")
{
    const auto law = curve();
    for (const double suction : {0.0, 1.0, 1e12}) {
        for (const double porosity : {1e-300, 0.0, -0.1}) // below 0: pressed to less than the volume of the grains
            CHECK(law->saturation(suction, porosity) == 0.95);
        CHECK(law->saturation(suction, 1.0) == (suction > 0.0 ? 0.05 : 0.95));
    }
}

TEST_CASE("with a void ratio exponent of zero the curve is the plain one at every porosity")
{
    const auto plain = retention("van_genuchten", shape);
    const auto law = curve({{"void_ratio_exponent", 0.0}});
    for (const double porosity : porosities)
        for (const double suction : {0.0, 1e3, 2e4, 1e6})
            CHECK(law->saturation(suction, porosity) == rounded(plain->saturation(suction, porosity)));
}

TEST_CASE("the curve says that it depends on the porosity")
{
    CHECK(curve()->depends_on_porosity());
}

TEST_CASE("what is out of range is refused with the range")
{
    const std::string name = "van_genuchten_porosity";
    test::check_mentions(test::objection(name, "air_entry", -1.0), {"> 0", "-1 Pa"});
    test::check_mentions(test::objection(name, "exponent", 1.0), {"> 1"});
    test::check_mentions(test::objection(name, "void_ratio_exponent", -0.1), {">= 0"});
    for (const double limit : {0.0, 1.0})
        CHECK_FALSE(test::objection(name, "reference_porosity", limit).empty());
    test::check_refused_saturations(name, soil);
}
