// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Stops that come from outside: Ctrl-C and SIGTERM.
#pragma once

#include <signal.h>

namespace periporo {

/// While it lives, the first SIGINT or SIGTERM is noted and a second one ends the process as usual.
class InterruptionGuard {
public:
    InterruptionGuard();
    ~InterruptionGuard();
    InterruptionGuard(const InterruptionGuard&) = delete;
    InterruptionGuard& operator=(const InterruptionGuard&) = delete;

    bool requested() const;

private:
    struct sigaction before_interrupt_;
    struct sigaction before_terminate_;
};

} // namespace periporo
