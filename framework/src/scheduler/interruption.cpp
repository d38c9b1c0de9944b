// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Notes signals.
#include "scheduler/interruption.hpp"

#include <unistd.h>

#include <cstring>

namespace periporo {
namespace {

// A signal handler can reach nothing but global flags.
volatile sig_atomic_t signal_that_came = 0;
volatile sig_atomic_t sets_up = 0;

constexpr char end_of_set_up[] = "periporo: interrupted while the run was set up, before its first step\n";
constexpr int interrupted = 130; // as ExitStatus::interrupted

extern "C" void note_stop(int signal)
{
    signal_that_came = signal;
    if (sets_up == 0)
        return;
    [[maybe_unused]] const ssize_t told = ::write(STDERR_FILENO, end_of_set_up, sizeof(end_of_set_up) - 1);
    ::_exit(interrupted);
}

} // namespace

InterruptionGuard::InterruptionGuard()
{
    signal_that_came = 0;
    sets_up = 1;
    for (std::size_t s = 0; s < stops.size(); ++s) {
        sigaction(stops[s], nullptr, &before_[s]);
        if (stops[s] == SIGHUP && before_[s].sa_handler == SIG_IGN)
            continue;
        struct sigaction action = {};
        action.sa_handler = note_stop;
        // The system repeats SIGXCPU every second.
        action.sa_flags = stops[s] == SIGXCPU ? SA_RESTART : static_cast<int>(SA_RESETHAND) | SA_RESTART;
        sigemptyset(&action.sa_mask);
        sigaction(stops[s], &action, nullptr);
    }
}

InterruptionGuard::~InterruptionGuard()
{
    sets_up = 0;
    for (std::size_t s = 0; s < stops.size(); ++s)
        sigaction(stops[s], &before_[s], nullptr);
}

void InterruptionGuard::end_set_up()
{
    sets_up = 0;
}

const char* InterruptionGuard::signal() const
{
    switch (signal_that_came) {
    case 0:
        return nullptr;
    case SIGINT:
        return "SIGINT";
    case SIGTERM:
        return "SIGTERM";
    case SIGHUP:
        return "SIGHUP";
    default:
        return "SIGXCPU, the limit of processor time,";
    }
}

} // namespace periporo
