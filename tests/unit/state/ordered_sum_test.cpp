// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums whose last bit does not depend on the number of threads.
#include "state/ordered_sum.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <omp.h>
#include <random>

using namespace periporo;

TEST_CASE("sums have the same bits whatever the number of threads")
{
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<double> terms(5000);
    for (double& term : terms)
        term = std::exp(20.0 * value(engine)) * value(engine);
    const auto sums = [&](int threads) {
        const int before = omp_get_max_threads();
        omp_set_num_threads(threads);
        const std::array<double, 2> result =
            ordered_sums<2>(terms.size(), [&](std::size_t i, std::array<double, 2>& sum) {
                sum[0] += terms[i];
                sum[1] += terms[i] * terms[i];
            });
        omp_set_num_threads(before);
        return result;
    };
    const std::array<double, 2> one = sums(1);
    for (const int threads : {2, 3, 7})
        CHECK(sums(threads) == one);
    double plain = 0.0, size = 0.0;
    for (const double term : terms) {
        plain += term;
        size += std::abs(term);
    }
    CHECK(std::abs(one[0] - plain) < 1e-12 * size);
}

TEST_CASE("the sum over nothing is zero")
{
    CHECK(ordered_sums<1>(0, [](std::size_t, std::array<double, 1>& sum) { sum[0] += 1.0; })[0] == 0.0);
}
