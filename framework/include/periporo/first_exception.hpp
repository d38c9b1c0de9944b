// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Carries an exception out of a parallel loop, in which it would end the program without a word.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace periporo {

/// Every parallel loop whose body may throw (it allocates, or calls a plugin) has one of these:
///
///     FirstException failure;
///     #pragma omp parallel for
///     for (std::size_t i = 0; i < n; ++i)
///         failure.guard(i, [&] { law.update(i); });
///     failure.rethrow();
///
/// Of several exceptions the one of the smallest index stays, so that the message does not depend on the threads.
class FirstException {
public:
    /// Calls work() and keeps what it throws. Skips the work when a smaller or equal index has thrown already.
    template <class Work>
    void guard(std::size_t index, Work&& work) noexcept
    {
        if (index >= first_.load(std::memory_order_relaxed))
            return;
        try {
            work();
        } catch (...) {
            keep(index);
        }
    }

    /// Sets up what a thread needs for the loop. Once this has thrown, no thread does any work.
    template <class Work>
    void guard_set_up(Work&& work) noexcept
    {
        guard(0, work);
    }

    /// @throws the exception of the smallest index, if there is one. To be called after the parallel region.
    void rethrow() const
    {
        if (exception_)
            std::rethrow_exception(exception_);
    }

private:
    [[gnu::noinline, gnu::cold]] void keep(std::size_t index) noexcept
    {
        const std::scoped_lock lock(mutex_);
        if (index >= first_.load(std::memory_order_relaxed))
            return;
        first_.store(index, std::memory_order_relaxed);
        exception_ = std::current_exception();
    }

    std::atomic<std::size_t> first_{std::numeric_limits<std::size_t>::max()};
    std::exception_ptr exception_;
    std::mutex mutex_;
};

} // namespace periporo
