// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs a function on a stack of its own, which the function may leave for good from any depth.
#pragma once

#include <ucontext.h>

#include <cstddef>

namespace periporo::abaqus {

/// A routine that calls XIT must not be returned to, but the process goes on. To throw or to jump over frames of
/// Fortran is undefined; here no frame is jumped over: the routine stands still where it is, and its stack is used
/// anew.
class SideStack {
public:
    enum class Ending { returned, left, threw };

    /// @throws std::system_error when there is no memory for the stack
    SideStack();
    ~SideStack();
    SideStack(const SideStack&) = delete;
    SideStack& operator=(const SideStack&) = delete;

    /// Calls function(argument) and says how it ended. What the function owned when it left stays as it is.
    Ending run(void (*function)(void*), void* argument);

    /// Leaves the function that this thread has in run(), which then returns Ending::left; this call does not return.
    /// Returns only where the thread has none.
    static void leave();

    /// Is this thread inside a function that run() called?
    static bool in_use();

private:
    static void enter();

    void* memory_;
    ucontext_t caller_{};
    ucontext_t callee_{};
    void (*function_)(void*) = nullptr;
    void* argument_ = nullptr;
    Ending ending_ = Ending::returned;
};

} // namespace periporo::abaqus
