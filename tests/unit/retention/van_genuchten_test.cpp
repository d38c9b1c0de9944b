// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Van Genuchten's curve: limits, closed forms, what is refused.
#include "retention_checks.hpp"

using namespace periporo;
using test::retention;
using test::rounded;

namespace {

const double air_entry = 3e3; // [Pa]
const double porosity = 0.4;
const test::Given soil{{"air_entry", air_entry}, {"exponent", 2.0}};

/// n and m.
struct Exponents {
    double n;
    double m;
};
const Exponents exponents[] = {{1.09, 1.0 - 1.0 / 1.09}, // pores of many sizes
                               {2.0, 0.5},
                               {7.0, 6.0 / 7.0}, // pores of nearly one size
                               {3.746, 0.03586},
                               {1.5, 2.0}};

std::unique_ptr<Retention> curve(const Exponents& of, double residual = 0.0, double full = 1.0)
{
    return retention("van_genuchten", {{"air_entry", air_entry},
                                       {"exponent", of.n},
                                       {"m", of.m},
                                       {"residual_saturation", residual},
                                       {"full_saturation", full}});
}

} // namespace

TEST_CASE("without suction saturation is exactly the full one, from where it falls over 18 decades")
{
    for (const Exponents& of : exponents) {
        test::check_falls(*curve(of), porosity, 0.0, 1.0);
        test::check_falls(*curve(of, 0.02, 1.0), porosity, 0.02, 1.0);
        test::check_falls(*curve(of, 0.3, 0.9), porosity, 0.3, 0.9);
    }
    static_assert(0.3 + (0.9 - 0.3) > 0.9, "a range that plain arithmetic would leave");
}

TEST_CASE("where a power exceeds all numbers, the residual saturation is left")
{
    const auto steep =
        retention("van_genuchten", {{"air_entry", 1e-3}, {"exponent", 40.0}, {"residual_saturation", 0.03}});
    CHECK(steep->saturation(1e12, porosity) == 0.03); // (1e15)^40
    test::check_falls(*steep, porosity, 0.03, 1.0);
}

TEST_CASE("at the air-entry value the effective saturation is 2^-m")
{
    for (const Exponents& of : exponents) {
        CHECK(curve(of)->saturation(air_entry, porosity) == rounded(std::pow(2.0, -of.m)));
        CHECK(curve(of, 0.2, 0.8)->saturation(air_entry, porosity) == rounded(0.2 + 0.6 * std::pow(2.0, -of.m)));
    }
}

TEST_CASE("the suction s_a (S_e^(-1/m) - 1)^(1/n) has the effective saturation S_e")
{
    for (const Exponents& of : exponents)
        for (int percent = 5; percent <= 95; percent += 5) {
            const double effective = 0.01 * percent;
            const double suction = air_entry * std::pow(std::pow(effective, -1.0 / of.m) - 1.0, 1.0 / of.n);
            CAPTURE(suction);
            CHECK(curve(of)->saturation(suction, porosity) == rounded(effective));
            CHECK(curve(of, 0.1, 0.9)->saturation(suction, porosity) == rounded(0.1 + 0.8 * effective));
        }
}

TEST_CASE("m is 1 - 1/n when left out")
{
    const auto without = retention("van_genuchten", soil);
    const auto half = retention("van_genuchten", test::changed(soil, {{"m", 0.5}}));
    const auto more = retention("van_genuchten", test::changed(soil, {{"m", 0.6}}));
    for (const double suction : {10.0, 3e3, 1e6}) {
        CHECK(without->saturation(suction, porosity) == half->saturation(suction, porosity));
        CHECK(without->saturation(suction, porosity) > more->saturation(suction, porosity));
    }
}

TEST_CASE("over ln s the curve is steepest at s_a m^(-1/n), with the slope -n (1 + 1/m)^-(m + 1)")
{
    // With x = (s/s_a)^n the slope is -n m x (1 + x)^-(m + 1), the largest in size where x m = 1.
    for (const Exponents& of : exponents) {
        const auto law = curve(of);
        const double step = 1e-3;
        const auto slope = [&](double suction) {
            const double rise = law->saturation(suction * std::exp(step), porosity) -
                                law->saturation(suction * std::exp(-step), porosity);
            return rise / (2.0 * step);
        };
        const double steepest = air_entry * std::pow(of.m, -1.0 / of.n);
        const double expected = -of.n * std::pow(1.0 + 1.0 / of.m, -(of.m + 1.0));
        // The difference is off by step^2/6 of a third derivative; each derivative is one factor n, times less than 1.
        CHECK(slope(steepest) == doctest::Approx(expected).epsilon(step * step * of.n * of.n).scale(0.0));
        for (const double away : {0.01, 0.5, 0.9, 1.1, 2.0, 100.0})
            CHECK(slope(steepest * away) > slope(steepest));
    }
}

TEST_CASE("far beyond air entry the curve is a line of slope -n m over the logarithms")
{
    for (const Exponents& of : exponents) {
        const auto law = curve(of);
        const double suction = air_entry * std::pow(1e12, 1.0 / of.n); // (s/s_a)^n = 1e12 against the 1 beside it
        const double fall = std::log(law->saturation(10.0 * suction, porosity) / law->saturation(suction, porosity));
        CHECK(fall == doctest::Approx(-of.n * of.m * std::log(10.0)).epsilon(2e-12).scale(0.0));
    }
}

TEST_CASE("the porosity does not matter, and the curve says so")
{
    const auto law = retention("van_genuchten", soil);
    CHECK_FALSE(law->depends_on_porosity());
    CHECK(law->saturation(5e3, 0.1) == law->saturation(5e3, 0.9));
}

TEST_CASE("what is out of range is refused with the range")
{
    test::check_mentions(test::objection("van_genuchten", "air_entry", 0.0), {"> 0", "0 Pa"});
    test::check_mentions(test::objection("van_genuchten", "exponent", 1.0), {"> 1"});
    test::check_mentions(test::objection("van_genuchten", "m", 0.0), {"> 0"});
    test::check_refused_saturations("van_genuchten", soil);
}
