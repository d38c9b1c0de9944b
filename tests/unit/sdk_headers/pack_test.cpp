// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Packs against the same functions of one double.
#include "periporo/pack.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace periporo;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// 0, 1, 2, ... in the lanes
Pack counted()
{
    return Pack([](auto lane) { return static_cast<double>(lane); });
}

Pack random_pack(std::mt19937_64& engine, double low, double high)
{
    std::uniform_real_distribution<double> distribution(low, high);
    return Pack([&](auto) { return distribution(engine); });
}

} // namespace

TEST_CASE("the exponential agrees with that of the standard library within two units in the last place")
{
    std::mt19937_64 engine(1);
    double worst = 0.0;
    for (const double range : {1e-9, 1e-3, 0.34, 0.36, 1.0, 10.0, 100.0, 708.0})
        for (int n = 0; n < 20000; ++n) {
            const Pack x = random_pack(engine, -range, range);
            const Pack y = exponential(x);
            for (std::size_t lane = 0; lane < pack_width; ++lane)
                worst = std::max(worst, std::abs(y[lane] / std::exp(x[lane]) - 1.0));
        }
    CHECK(worst <= 2.0 * epsilon);
    CHECK(worst > 0.0); // the comparison sees differences of one unit
}

TEST_CASE("the exponential of zero is one, exactly")
{
    CHECK(all(exponential(Pack(0.0)) == Pack(1.0)));
}

TEST_CASE("the exponential is held at the ends of its interval")
{
    CHECK(lane_of(exponential(Pack(-1e9)), 0) == doctest::Approx(std::exp(-708.0)).epsilon(1e-15).scale(0.0));
    CHECK(lane_of(exponential(Pack(1e9)), 0) == doctest::Approx(std::exp(709.0)).epsilon(1e-15));
}

TEST_CASE("the exponential of a sum is the product of exponentials")
{
    std::mt19937_64 engine(2);
    for (int n = 0; n < 1000; ++n) {
        const Pack a = random_pack(engine, -100.0, 100.0), b = random_pack(engine, -100.0, 100.0);
        const Pack ratio = exponential(a) * exponential(b) / exponential(Pack(a + b));
        // the sum of up to 200 is rounded to half of 2.8e-14, and the exponential carries that as a relative error
        CHECK(all(absolute(Pack(ratio - 1.0)) <= Pack(2e-14)));
    }
}

TEST_CASE("logarithm, root and magnitude work lane by lane")
{
    std::mt19937_64 engine(3);
    const Pack x = random_pack(engine, 1e-3, 1e3);
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        CHECK(lane_of(logarithm(x), lane) == std::log(x[lane]));
        CHECK(lane_of(square_root(x), lane) == std::sqrt(x[lane]));
        CHECK(lane_of(absolute(Pack(-x)), lane) == lane_of(x, lane));
    }
}

TEST_CASE("select takes each lane from the side its mask says")
{
    const Pack lane_number = counted();
    const Pack chosen = select(lane_number < Pack(1.0), Pack(10.0), lane_number);
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        CHECK(chosen[lane] == (lane < 1 ? 10.0 : static_cast<double>(lane)));
    CHECK(select(true, 1.0, 2.0) == 1.0);
    CHECK(select(false, 1.0, 2.0) == 2.0);
}

TEST_CASE("any and all say what they say")
{
    const Pack lane_number = counted();
    CHECK(any(lane_number == Pack(0.0)));
    CHECK_FALSE(any(lane_number < Pack(0.0)));
    CHECK(all(lane_number >= Pack(0.0)));
    CHECK(all(lane_number == Pack(0.0)) == (pack_width == 1));
    CHECK(any(true));
    CHECK_FALSE(all(false));
}

TEST_CASE("minimum and maximum work lane by lane")
{
    const Pack low = minimum(counted(), Pack(1.5)), high = maximum(counted(), Pack(1.5));
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        CHECK(low[lane] == std::min(static_cast<double>(lane), 1.5));
        CHECK(high[lane] == std::max(static_cast<double>(lane), 1.5));
    }
}

TEST_CASE("lane_bits sets bit l for lane l")
{
    for (std::size_t chosen = 0; chosen < pack_width; ++chosen)
        CHECK(lane_bits(counted() == Pack(static_cast<double>(chosen))) == (1u << chosen));
    CHECK(lane_bits(counted() < Pack(0.0)) == 0u);
}

TEST_CASE("what is done to a pair of packs is done to each of them")
{
    std::mt19937_64 engine(3);
    const PackPair a(random_pack(engine, 0.5, 2.0), random_pack(engine, 0.5, 2.0));
    const PackPair b(random_pack(engine, 0.5, 2.0), random_pack(engine, 0.5, 2.0));
    const auto same = [&](auto&& operation) {
        const PackPair both = operation(a, b);
        const Pack first = operation(a.first, b.first);
        const Pack second = operation(a.second, b.second);
        return all(both.first == first) && all(both.second == second);
    };
    CHECK(same([](auto x, auto y) { return x + y; }));
    CHECK(same([](auto x, auto y) { return x - 2.0 * y; }));
    CHECK(same([](auto x, auto y) { return -x * y; }));
    CHECK(same([](auto x, auto y) { return 1.0 / x / y; }));
    CHECK(same([](auto x, auto y) { return square_root(x) + exponential(y); }));
    CHECK(same([](auto x, auto y) { return minimum(x, y) + 3.0 * maximum(x, y); }));
    CHECK(same([](auto x, auto y) { return absolute(x - y) + logarithm(x); }));
    CHECK(same([](auto x, auto y) {
        x += y;
        x *= y;
        x -= 1.0;
        x /= y;
        return x;
    }));
    CHECK(same([](auto x, auto y) { return select(x < y || x == y, x, y); }));
    CHECK(same([](auto x, auto y) { return select(!(x >= y) && x <= 1.5, x, y); }));
    CHECK(same([](auto x, auto y) { return select(x > y && x != y, x, y); }));
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        CHECK(lane_of(a, lane) == a.first[lane]);
        CHECK(lane_of(a, pack_width + lane) == a.second[lane]);
    }
}

TEST_CASE("any and all look at both packs of a pair")
{
    const PackPair pair(Pack(1.0), counted());
    CHECK(any(pair < PackPair(0.5)));
    CHECK_FALSE(all(pair < PackPair(0.5)));
    CHECK(all(pair >= PackPair(0.0)));
    CHECK_FALSE(any(pair < PackPair(0.0)));
}
