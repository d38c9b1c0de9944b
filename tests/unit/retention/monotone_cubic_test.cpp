// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Monotone cubic interpolation by itself: slopes at the nodes, rising data, few nodes.
#include "retention/table/monotone_cubic.hpp"

#include <doctest/doctest.h>

using namespace periporo;

namespace {

constexpr double step = 1e-6;

/// Slope from one side by a difference over `step`, which is off by some second derivatives (1 to 20 here) times it.
double slope(const MonotoneCubic& curve, double at)
{
    return (curve(at + step) - curve(at)) / step;
}

doctest::Approx nearly(double value)
{
    return doctest::Approx(value).epsilon(2e-5);
}

} // namespace

TEST_CASE("inside, the slope is continuous and the weighted harmonic mean of the secants")
{
    // Secants 3 and 1 over pieces of 1 and 2: the shorter piece weighs 1/3 (1 + 2/3) = 5/9, so that 1/slope =
    // 5/9 1/3 + 4/9 1 = 17/27.
    const MonotoneCubic curve({0.0, 1.0, 3.0, 4.0}, {0.0, 3.0, 5.0, 6.0});
    CHECK(slope(curve, 1.0) == nearly(27.0 / 17.0));
    CHECK(slope(curve, 1.0 - step) == nearly(27.0 / 17.0));
}

TEST_CASE("at the ends the slope is that of the parabola through three nodes")
{
    // y = x^2 has the slopes 2 at 1 and 10 at 5.
    const MonotoneCubic curve({1.0, 2.0, 4.0, 5.0}, {1.0, 4.0, 16.0, 25.0});
    CHECK(slope(curve, 1.0) == nearly(2.0));
    CHECK(slope(curve, 5.0 - step) == nearly(10.0));
}

TEST_CASE("an end slope that would point against the data is zero")
{
    // Secants 1 and 10: the parabola begins with the slope 1 - 9/2.
    const MonotoneCubic curve({0.0, 1.0, 2.0}, {0.0, 1.0, 11.0});
    CHECK(slope(curve, 0.0) == nearly(0.0));
    for (int n = 0; n < 2000; ++n)
        CHECK(curve(1e-3 * (n + 1)) >= curve(1e-3 * n));
}

TEST_CASE("two nodes make a line, one a constant")
{
    const MonotoneCubic line({1.0, 3.0}, {4.0, 0.0});
    CHECK(line(1.0) == 4.0);
    CHECK(line(1.5) == 3.0);
    CHECK(line(3.0) == 0.0);
    CHECK(line(7.0) == 0.0);
    const MonotoneCubic constant({1.0}, {0.5});
    CHECK(constant(1.0) == 0.5);
    CHECK(constant(2.0) == 0.5);
}
