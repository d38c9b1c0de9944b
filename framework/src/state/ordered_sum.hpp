// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums over points whose last bit does not depend on the number of threads.
#pragma once

#include "periporo/first_exception.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace periporo {

/// `count` sums over the points 0 ... n-1 at a time. add(i, sums) adds the terms of point i. Fixed runs of points are
/// summed each by itself, then the runs in their order.
template <std::size_t count, class Add>
std::array<double, count> ordered_sums(std::size_t n, Add&& add)
{
    constexpr std::size_t run = 512;
    const std::size_t runs = (n + run - 1) / run;
    thread_local std::vector<std::array<double, count>> kept; // only ever grows
    if (kept.size() < runs)
        kept.resize(runs);
    std::array<double, count>* sums = kept.data();
    FirstException failure;
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < runs; ++r)
        failure.guard(r, [&] {
            std::array<double, count> sum{};
            for (std::size_t i = r * run; i < std::min(n, (r + 1) * run); ++i)
                add(i, sum);
            sums[r] = sum;
        });
    failure.rethrow();
    std::array<double, count> total{};
    for (std::size_t r = 0; r < runs; ++r)
        for (std::size_t c = 0; c < count; ++c)
            total[c] += sums[r][c];
    return total;
}

} // namespace periporo
