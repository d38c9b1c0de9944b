// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/interruption.hpp"

namespace periporo {
namespace {

// A signal handler can reach nothing but a global flag.
volatile sig_atomic_t stop_requested = 0;

extern "C" void note_stop(int)
{
    stop_requested = 1;
}

} // namespace

InterruptionGuard::InterruptionGuard()
{
    stop_requested = 0;
    struct sigaction action = {};
    action.sa_handler = note_stop;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &before_interrupt_);
    sigaction(SIGTERM, &action, &before_terminate_);
}

InterruptionGuard::~InterruptionGuard()
{
    sigaction(SIGINT, &before_interrupt_, nullptr);
    sigaction(SIGTERM, &before_terminate_, nullptr);
}

bool InterruptionGuard::requested() const
{
    return stop_requested != 0;
}

} // namespace periporo
