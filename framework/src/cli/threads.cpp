// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bounds the number of threads: thousands of them end a program for want of stacks.
#include "cli/threads.hpp"

#include "cli/exit_status.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cstdio>

namespace periporo::cli {

int processors()
{
    return omp_get_num_procs();
}

int most_threads()
{
    return std::max(64, 4 * processors());
}

void use_threads(int threads)
{
    if (threads > 0)
        omp_set_num_threads(threads);
    const int wanted = omp_get_max_threads();
    if (wanted > most_threads())
        throw UsageError(fmt::format("OMP_NUM_THREADS asks for {} threads; give 1 to {}, the number of processors here",
                                     wanted, processors()));
    if (wanted > processors())
        fmt::print(stderr, "periporo: warning: {} threads share {} processors, which is slower than fewer threads\n",
                   wanted, processors());
}

} // namespace periporo::cli
