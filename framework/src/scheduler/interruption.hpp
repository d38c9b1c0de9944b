// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Stops that come from outside: Ctrl-C, SIGTERM, a terminal that hangs up, and the end of the processor time.
#pragma once

#include <signal.h>

#include <array>

namespace periporo {

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGXCPU stop the run: while the run is set up at once, with exit status
/// 130, for there is nothing to keep; after that at the next step. A second SIGINT, SIGTERM or SIGHUP ends the process
/// as usual. A SIGHUP that was ignored before, as nohup does it, stays ignored.
class InterruptionGuard {
public:
    InterruptionGuard();
    ~InterruptionGuard();
    InterruptionGuard(const InterruptionGuard&) = delete;
    InterruptionGuard& operator=(const InterruptionGuard&) = delete;

    /// From now on a signal is noted and ends nothing by itself.
    void end_set_up();
    /// Name of the signal that came, or null.
    const char* signal() const;

    static constexpr std::array stops{SIGINT, SIGTERM, SIGHUP, SIGXCPU};

private:
    std::array<struct sigaction, stops.size()> before_;
};

} // namespace periporo
