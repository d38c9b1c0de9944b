// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The command line, with the help that it prints. The only part of the program that includes CLI11.
#pragma once

#include "cli/exit_status.hpp"

#include <functional>
#include <variant>

namespace periporo::cli {

/// What the chosen command will do once the command line is understood.
using Action = std::function<ExitStatus()>;

/// Returns the action that the arguments of main() ask for, or the exit status when there is none: help or the version
/// has been printed, or an error with the way out.
std::variant<Action, ExitStatus> parse_command_line(int count, const char* const* arguments);

} // namespace periporo::cli
