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
namespace {

int most_threads()
{
    return std::max(64, 4 * omp_get_num_procs());
}

std::string objection(const std::string& text)
{
    int threads = 0;
    if (CLI::detail::lexical_cast(text, threads) && threads >= 1 && threads <= most_threads())
        return {};
    return fmt::format("\"{}\" is no number of threads; give 1 to {}, the number of processors here", text,
                       omp_get_num_procs());
}

} // namespace

void add_threads(CLI::App& command, int& threads)
{
    command.add_option("--threads", threads, "Number of threads (default: all processors)")
        ->check(CLI::Validator(objection, "", "threads"))
        ->type_name("N");
}

void use_threads(int threads)
{
    if (threads > 0)
        omp_set_num_threads(threads);
    const int wanted = omp_get_max_threads();
    if (wanted > most_threads())
        throw UsageError(fmt::format("OMP_NUM_THREADS asks for {} threads; give 1 to {}, the number of processors here",
                                     wanted, omp_get_num_procs()));
    if (wanted > omp_get_num_procs())
        fmt::print(stderr, "periporo: warning: {} threads share {} processors, which is slower than fewer threads\n",
                   wanted, omp_get_num_procs());
}

} // namespace periporo::cli
