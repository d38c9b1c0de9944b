// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Steps that end where a stage ends.
#include "time/next_step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace periporo;

namespace {

struct Walk {
    double shortest = INFINITY;
    double longest = 0.0;
    int steps = 0;
};

/// Steps from `time` to `end` with a stable step that may differ from step to step.
template <class Stable>
Walk walk(double time, double end, const Stable& stable)
{
    Walk walked;
    for (NextStep next; !next.last; ++walked.steps) {
        next = next_step(time, end, stable(walked.steps));
        REQUIRE(next.length > 0.0);
        walked.shortest = std::min(walked.shortest, next.length);
        walked.longest = std::max(walked.longest, next.length);
        time = next.last ? end : time + next.length;
        REQUIRE(walked.steps < 2000000);
    }
    return walked;
}

} // namespace

TEST_CASE("a stage ends at its end with steps between half of the stable step and all of it")
{
    for (const double start : {0.0, 0.3, 1e3})
        for (const double steps :
             {1.0, 1.0 + 1e-12, 1.4999, 1.5, 2.0 - 1e-12, 2.0, 49.0, 100.1, 1e3 + 1e-9, 1e5 / 3.0}) {
            CAPTURE(start);
            CAPTURE(steps);
            constexpr double stable = 1e-5;
            const Walk walked = walk(start, start + steps * stable, [](int) { return stable; });
            // end and time carry round-off of the time itself, 1e-13 s at 1000 s, in the last two steps
            CHECK(walked.shortest >= 0.5 * stable * (1.0 - 1e-7));
            CHECK(walked.longest <= stable * (1.0 + stretch_of_step));
            CHECK(walked.steps >= static_cast<int>(std::floor(steps * (1.0 - 1e-6))));
            CHECK(walked.steps <= static_cast<int>(std::ceil(steps)) + 1);
        }
}

TEST_CASE("a step that divides the duration is taken as it is, in spite of the round-off of its sum")
{
    const Walk walked = walk(0.0, 4.9e-3, [](int) { return 1e-4; });
    CHECK(walked.steps == 49);
    CHECK(walked.shortest == doctest::Approx(1e-4).epsilon(1e-9).scale(0.0));
}

TEST_CASE("a stage shorter than a step is one step")
{
    CHECK(walk(1.0, 1.0 + 3e-6, [](int) { return 1e-5; }).steps == 1);
}

TEST_CASE("no sliver is left when the stable step changes from step to step by a fifth")
{
    const auto stable = [](int n) { return 1e-5 * (1.0 + 0.1 * std::sin(3.0 * n)); };
    for (int n = 0; n < 200; ++n)
        CHECK(walk(0.0, 1e-3 + 1e-7 * n, stable).shortest > 0.4e-5);
}
