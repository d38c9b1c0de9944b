// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Brooks and Corey's curve: air entry, slope, what is refused.
#include "retention_checks.hpp"

using namespace periporo;
using test::retention;
using test::rounded;

namespace {

const double air_entry = 1.5e3; // [Pa]
const double porosity = 0.4;
const double indices[] = {0.1, 0.6, 2.0, 8.0};

std::unique_ptr<Retention> curve(double index, double residual = 0.0, double full = 1.0)
{
    return retention("brooks_corey", {{"air_entry", air_entry},
                                      {"pore_size_index", index},
                                      {"residual_saturation", residual},
                                      {"full_saturation", full}});
}

} // namespace

TEST_CASE("up to the air-entry value saturation is exactly the full one, and beyond it falls without a jump")
{
    for (const double index : indices) {
        const auto law = curve(index, 0.1, 0.9);
        for (const double suction : {0.0, 1e-3, 0.999 * air_entry, air_entry})
            CHECK(law->saturation(suction, porosity) == 0.9);
        const double fall = 0.9 - law->saturation(air_entry * (1.0 + 1e-9), porosity);
        // (S2 - S1) lambda 1e-9 to first order; roundings of 1e-16 are 3e-6 of 8e-11, the least of these
        CHECK(fall == doctest::Approx(0.8e-9 * index).epsilon(1e-5).scale(0.0));
    }
}

TEST_CASE("beyond air entry the effective saturation is a line of slope -lambda over the logarithms")
{
    for (const double index : indices)
        for (const double ratio : {1.1, 10.0, 1e4}) {
            const double line = -index * std::log(ratio);
            CHECK(std::log(curve(index)->saturation(ratio * air_entry, porosity)) == rounded(line));
            CHECK(curve(index, 0.25, 0.75)->saturation(ratio * air_entry, porosity) ==
                  rounded(0.25 + 0.5 * std::exp(line)));
        }
}

TEST_CASE("saturation falls over 18 decades and keeps within its range")
{
    for (const double index : indices) {
        test::check_falls(*curve(index), porosity, 0.0, 1.0);
        test::check_falls(*curve(index, 0.3, 0.9), porosity, 0.3, 0.9);
    }
    const auto steep = curve(60.0, 0.03);
    CHECK(steep->saturation(1e12, porosity) == 0.03); // (1.5e-9)^60
    test::check_falls(*steep, porosity, 0.03, 1.0);
}

TEST_CASE("the porosity does not matter, and the curve says so")
{
    const auto law = curve(0.6);
    CHECK_FALSE(law->depends_on_porosity());
    CHECK(law->saturation(5e3, 0.1) == law->saturation(5e3, 0.9));
}

TEST_CASE("what is out of range is refused with the range")
{
    test::check_mentions(test::objection("brooks_corey", "air_entry", 0.0), {"> 0", "0 Pa"});
    test::check_mentions(test::objection("brooks_corey", "pore_size_index", 0.0), {"> 0"});
    test::check_refused_saturations("brooks_corey", {{"air_entry", air_entry}, {"pore_size_index", 0.6}});
}
