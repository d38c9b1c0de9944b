// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Influence functions.
#include "operator/influence.hpp"

#include <doctest/doctest.h>

using namespace periporo;

TEST_CASE("influence functions have their defining values, for doubles and packs alike")
{
    const double h = 0.03;
    const auto at = [h](const char* name, double x) { return Influence::by_name(name, h)(x * x * h * h); };
    CHECK(at("constant", 0.5) == 1.0);
    CHECK(at("linear", 0.5) == doctest::Approx(0.5).epsilon(1e-15));
    CHECK(at("quadratic", 0.25) == doctest::Approx(0.5625).epsilon(1e-15));
    CHECK(at("gaussian", 0.5) == doctest::Approx(std::exp(-1.0)).epsilon(1e-15));
    CHECK(at("cubic_b_spline", 0.0) == doctest::Approx(1.0).epsilon(1e-15));
    CHECK(at("cubic_b_spline", 0.5) == doctest::Approx(0.25).epsilon(1e-15));
    CHECK(at("cubic_b_spline", 0.5 - 1e-9) == doctest::Approx(0.25).epsilon(1e-8)); // the two pieces meet
    CHECK(at("inverse_distance", 0.5) == doctest::Approx(2.0).epsilon(1e-15));
    CHECK(at("inverse_distance", 0.0) == doctest::Approx(10.0).epsilon(1e-15));
    for (const std::string& name : influence_names()) {
        CAPTURE(name);
        for (const double x : {0.0, 0.05, 0.37, 0.8, 1.0, 1.2})
            CHECK(lane_of(Influence::by_name(name, h)(Pack(x * x * h * h)), 0) ==
                  doctest::Approx(at(name.c_str(), x)).epsilon(1e-14));
    }
}

TEST_CASE("every influence function is positive inside the horizon and falls with distance or stays")
{
    const double h = 0.03;
    for (const std::string& name : influence_names()) {
        CAPTURE(name);
        const Influence influence = Influence::by_name(name, h);
        double last = INFINITY;
        for (double x = 0.0; x < 0.999; x += 0.01) {
            const double omega = influence(x * x * h * h);
            CHECK(omega > 0.0);
            CHECK(omega <= last * (1.0 + 1e-15));
            last = omega;
        }
        if (name == "linear" || name == "quadratic" || name == "cubic_b_spline")
            CHECK(influence(h * h) == doctest::Approx(0.0).epsilon(1e-15));
    }
}

TEST_CASE("an unknown influence function is named in the error")
{
    CHECK_THROWS_WITH_AS(Influence::by_name("cosine", 1.0), doctest::Contains("cosine"), std::invalid_argument);
}

TEST_CASE("second moments are those of the ball: delta^2/5 for constant, 2/15 for linear, 2/21 for quadratic")
{
    // int x^4 omega dx/(3 int x^2 omega dx)
    CHECK(Influence::by_name("constant", 0.03).second_moment() ==
          doctest::Approx(0.0009 / 5.0).epsilon(1e-5).scale(0.0));
    CHECK(Influence::by_name("linear", 0.03).second_moment() ==
          doctest::Approx(0.0009 * 2.0 / 15.0).epsilon(1e-5).scale(0.0));
    CHECK(Influence::by_name("quadratic", 0.03).second_moment() ==
          doctest::Approx(0.0009 * 2.0 / 21.0).epsilon(1e-5).scale(0.0));
}
