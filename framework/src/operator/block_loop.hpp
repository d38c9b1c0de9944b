// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The loop of an evaluation over all points, and where its time goes.
#pragma once

#include "model/operator_result.hpp"
#include "neighbourhood/block_accumulators.hpp"
#include "periporo/first_exception.hpp"

#include <chrono>

namespace periporo {

/// Calls visit(block, samples) for every block of points, in parallel, and adds the samples to `times`.
/// @throws what visit() throws in the first block in which it does.
template <class Visit>
void for_every_block(const BlockAccumulators& blocks, OperatorTimes& times, Visit&& visit)
{
    FirstException failure;
#pragma omp parallel
    {
        OperatorTimes samples;
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < blocks.blocks(); ++block)
            failure.guard(block, [&] { visit(block, samples); });
#pragma omp critical(periporo_operator_times)
        times += samples;
    }
    failure.rethrow();
}

/// Takes the time of the parts of an evaluation for one point of sixteen: a clock for every point would be felt.
class SampledTimes {
public:
    SampledTimes(OperatorTimes& samples, std::size_t point) : samples_(samples), sampled_(point % 16 == 8)
    {
        if (sampled_)
            last_ = Clock::now();
    }
    void end_of(double OperatorTimes::*part)
    {
        if (!sampled_)
            return;
        const Clock::time_point now = Clock::now();
        samples_.*part += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

private:
    using Clock = std::chrono::steady_clock;
    OperatorTimes& samples_;
    bool sampled_;
    Clock::time_point last_;
};

} // namespace periporo
