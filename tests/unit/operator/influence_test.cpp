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
    const Influence constant = Influence::by_name("constant", h);
    const Influence linear = Influence::by_name("linear", h);
    const Influence gaussian = Influence::by_name("gaussian", h);
    CHECK(constant(0.25 * h * h) == 1.0);
    CHECK(linear(0.25 * h * h) == doctest::Approx(0.5).epsilon(1e-15));
    CHECK(linear(h * h) == doctest::Approx(0.0).epsilon(1e-15));
    CHECK(gaussian(0.25 * h * h) == doctest::Approx(std::exp(-1.0)).epsilon(1e-15));
    for (const Influence& influence : {constant, linear, gaussian})
        CHECK(lane_of(influence(Pack(0.37 * h * h)), 0) == doctest::Approx(influence(0.37 * h * h)).epsilon(1e-15));
}

TEST_CASE("an unknown influence function is named in the error")
{
    CHECK_THROWS_WITH_AS(Influence::by_name("cubic", 1.0), doctest::Contains("cubic"), std::invalid_argument);
}
