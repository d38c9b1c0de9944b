// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the program returns to the shell, and the one place where exceptions become it.
#pragma once

#include <functional>
#include <stdexcept>

namespace periporo::cli {

enum class ExitStatus {
    done = 0,
    failed = 1,        ///< something went wrong while running
    wrong_input = 2,   ///< a bad case, an unknown option or plugin, a file that is not there
    interrupted = 130, ///< stopped by a signal, to be resumed
};

/// The user asked for something that cannot be; the message says what can.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Runs `action`; an exception is printed to standard error and becomes its exit status.
ExitStatus report_faults(const std::function<ExitStatus()>& action);

/// Brings what was printed to the standard output. What cannot be written there is told, and makes a command that is
/// done one that failed.
ExitStatus report_unwritten_output(ExitStatus status);

} // namespace periporo::cli
