// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The ceilings of this machine for so many threads, as JSON: multiply-adds on packs of doubles that stay in registers,
// and the bandwidth of memory in a = b + s c over arrays far larger than any cache.
#include "periporo/pack.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>
#include <omp.h>

using namespace periporo;

namespace {

constexpr int repetitions = 5; // the best counts: the machine may be busy with something else

/// Floating-point operations a second, a multiply-add counted as two [1/s].
double arithmetic(int threads)
{
    constexpr long rounds = 20'000'000;
    constexpr std::size_t chains = 10; // enough to fill two pipes of four to five stages
    double best = 0.0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        double check = 0.0;
        const double begin = omp_get_wtime();
#pragma omp parallel num_threads(threads) reduction(+ : check)
        {
            const Pack factor = 1.0 - 1e-9 * omp_get_thread_num();
            const Pack term = 1e-9;
            // different chains, or the compiler would make one of them
            Pack a0 = 1.0, a1 = 1.1, a2 = 1.2, a3 = 1.3, a4 = 1.4, a5 = 1.5, a6 = 1.6, a7 = 1.7, a8 = 1.8, a9 = 1.9;
            for (long round = 0; round < rounds; ++round) {
                a0 = a0 * factor + term, a1 = a1 * factor + term, a2 = a2 * factor + term, a3 = a3 * factor + term;
                a4 = a4 * factor + term, a5 = a5 * factor + term, a6 = a6 * factor + term, a7 = a7 * factor + term;
                a8 = a8 * factor + term, a9 = a9 * factor + term;
            }
            check += reduce(a0 + a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9);
        }
        const double seconds = omp_get_wtime() - begin;
        if (!(check > 0.0))
            std::abort(); // the sums are used, so that they are made
        best = std::max(best, 2.0 * static_cast<double>(threads * rounds) * chains * pack_width / seconds);
    }
    return best;
}

/// Bytes a second, two arrays read and one written [B/s].
double bandwidth(int threads)
{
    constexpr std::size_t n = std::size_t{1} << 24; // 3 x 128 MiB
    const auto array = [] { return std::make_unique_for_overwrite<double[]>(n); };
    const std::unique_ptr<double[]> a = array(), b = array(), c = array();
    double best = 0.0;
    for (int repetition = 0; repetition <= repetitions; ++repetition) {
        const double begin = omp_get_wtime();
#pragma omp parallel for num_threads(threads) schedule(static)
        for (std::size_t i = 0; i < n; ++i) {
            if (repetition == 0)
                a[i] = b[i] = c[i] = 1.0; // each thread touches its part first
            else
                a[i] = b[i] + 3.0 * c[i];
        }
        if (repetition > 0)
            best = std::max(best, 3.0 * n * sizeof(double) / (omp_get_wtime() - begin));
    }
    return best;
}

} // namespace

int main(int count, char** arguments)
{
    const int threads = count > 1 ? std::atoi(arguments[1]) : omp_get_max_threads();
    if (threads < 1 || threads > 1024) {
        std::cerr << "usage: ceilings [THREADS]\n";
        return 2;
    }
    std::cout << nlohmann::json{{"threads", threads},
                                {"pack_width", pack_width},
                                {"flops_per_second", arithmetic(threads)},
                                {"bytes_per_second", bandwidth(threads)}}
              << '\n';
    return 0;
}
