// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rest on made-up histories of motion. Drifts are in mm/s and rest is below 20; windows last 20 ms.
#include "time/rest.hpp"

#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

using namespace specimens;

namespace {

constexpr double window = 0.02;
constexpr double never = -1.0;
const RestRule free_rule{0.02, 0.01, window, 0.0, 0.16};
const RestRule driven_rule{0.02, 0.01, window, 0.0, INFINITY};

/// Time of rest of a history of drift(t) [mm/s] and unbalanced(t) [-] over 2 s.
double rest_of(const RestRule& rule, const std::function<double(double)>& drift,
               const std::function<double(double)>& unbalanced)
{
    RestCriterion::State state;
    RestCriterion criterion(rule, state);
    for (int n = 1; n <= 100; ++n)
        if (const double t = n * window; criterion.judge({1e-3 * drift(t), unbalanced(t)}, t))
            return t;
    return never;
}

double balanced(double)
{
    return 1e-3;
}

/// A collapse that is fastest, at 400 mm/s, after 0.2 s and has stopped after 0.4 s.
double collapse(double t)
{
    return t < 0.4 ? 400.0 * std::sin(0.5 * std::numbers::pi * t / 0.2) : 0.0;
}

} // namespace

TEST_CASE("a collapse is at rest when its motion is over, and not while its forces do not balance")
{
    CHECK(rest_of(free_rule, collapse, balanced) == doctest::Approx(0.4).epsilon(0.06));
    const auto trembling = [](double t) { return t < 0.7 ? 0.02 : 1e-3; };
    CHECK(rest_of(free_rule, collapse, trembling) == doctest::Approx(0.7).epsilon(0.03));
}

TEST_CASE("a slope that creeps has not come to rest, be it slower than the rest speed, gaining or even")
{
    CHECK(rest_of(
              free_rule, [](double t) { return 2.0 + 5.0 * t; }, balanced) == never);
    CHECK(rest_of(
              free_rule, [](double) { return 15.0; }, balanced) == never);
    // slower and slower, but hardly: an even creep with a decay that a window does not show
    CHECK(rest_of(
              free_rule, [](double t) { return 15.0 - t; }, balanced) == never);
}

TEST_CASE("a cut that fails slowly comes to rest when it has failed, not while it gathers speed")
{
    // drifts of a slab of soil, every 40 ms: cases of the size of 20 mm/s for half a second before the wedge lets go
    const std::vector<double> slab{3.6,  7.9,  11.3, 14.5, 17.3,  19.3,  20.8,  22.9, 25.8, 29.8, 35.7,
                                   44.1, 56.0, 73.6, 103., 141.6, 135.0, 109.3, 80.0, 50.0, 19.0, 0.3};
    const auto drift = [&](double t) { return slab[std::min(static_cast<std::size_t>(t / 0.04001), slab.size() - 1)]; };
    CHECK(rest_of(free_rule, drift, balanced) > 0.8);
    CHECK(rest_of(free_rule, drift, balanced) < 0.9);
}

TEST_CASE("what stands and only twitches is at rest after the time of a fall, and not before")
{
    const auto twitch = [](double t) { return 0.02 * (1.0 + std::sin(150.0 * t)); };
    CHECK(rest_of(free_rule, twitch, balanced) > 0.16);
    CHECK(rest_of(free_rule, twitch, balanced) < 0.25);
}

TEST_CASE("a heap that lies still for a while and then slides has not come to rest when it lets go within a fall")
{
    const auto late = [](double t) { return t < 0.12 ? 0.05 : 4e3 * (t - 0.12); };
    CHECK(rest_of(free_rule, late, balanced) == never);
}

TEST_CASE("where something is driven rest needs a motion before it")
{
    const auto still = [](double) { return 0.01; };
    const auto pushed = [](double t) { return t > 1.0 && t < 1.2 ? 60.0 : 0.01; };
    CHECK(rest_of(driven_rule, still, balanced) == never);
    CHECK(rest_of(driven_rule, pushed, balanced) == doctest::Approx(1.2).epsilon(0.02));
}

TEST_CASE("a speed that is no number is no rest")
{
    CHECK(rest_of(
              free_rule, [](double) { return std::nan(""); }, balanced) == never);
}

TEST_CASE("a vibration about a place is rest, a creep below a stronger vibration is none")
{
    const auto rest_with = [](double creep) {
        Model model = from_positions(lattice(2, 2, 2, 0.01), 0.01);
        RestCriterion::State state;
        RestCriterion criterion(free_rule, state);
        const std::vector<Vector3> first = model.state.points.position;
        constexpr double speed = 0.03, frequency = 4e3, step = 2e-5; // faster than the rest speed
        for (int n = 1; n < 50000; ++n) {
            const double t = n * step;
            for (std::size_t i = 0; i < model.size(); ++i) {
                const double side = i % 2 == 0 ? 1.0 : -1.0;
                model.state.points.position[i].z() = first[i].z() + side * speed / frequency * std::sin(frequency * t);
                model.state.points.position[i].x() = first[i].x() + creep * t;
                model.state.points.velocity[i] = {creep, 0.0, side * speed * std::cos(frequency * t)};
            }
            if (criterion.follow(model, t, 9.81))
                return t;
        }
        return never;
    };
    // a window of T = 20 ms leaves a drift of at most 2 v/(omega T) = 0.8 mm/s and a mean force of 4 v/(omega g T^2) =
    // 0.8 per cent of the weight; the force itself is v omega/g = 12 times the weight
    CHECK(rest_with(0.0) > 0.16);
    CHECK(rest_with(0.0) < 0.5);
    CHECK(rest_with(0.015) == never);
}

TEST_CASE("a body on a heavy one that is at rest keeps a stage going, by its motion and by its own forces")
{
    const auto rest_with = [](double creep, double tremble) {
        Model model = from_positions(lattice(3, 1, 1, 0.01), 0.01);
        model.state.bodies.push_back(model.state.bodies.front());
        model.state.points.body[2] = 1;
        model.state.points.mass[0] = model.state.points.mass[1] = 100.0; // the ground
        const Vector3 first = model.state.points.position[2];
        RestCriterion::State state;
        RestCriterion criterion(free_rule, state);
        double place = 0.0;
        for (int n = 1; n < 1000; ++n) {
            place += 1e-3 * (creep + (n / 20 % 2 == 0 ? tremble : -tremble));
            model.state.points.position[2] = first + place * Vector3::UnitX();
            if (criterion.follow(model, 1.000001e-3 * n, 9.81)) // 20 steps fill a window in spite of round-off
                return true;
        }
        return false;
    };
    CHECK(rest_with(0.0, 0.0));
    CHECK_FALSE(rest_with(0.015, 0.0));
    // 1.5 mm/s to and fro are no motion, but from window to window, which are one step off, 2.7 mm/s: 1.4 per cent of
    // its weight over 20 ms
    CHECK_FALSE(rest_with(0.0, 0.0015));
    CHECK(rest_with(0.0, 0.0005));
}
