// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The option --threads of the commands that compute.
#pragma once

#include <CLI/CLI.hpp>

namespace periporo::cli {

/// Adds --threads N, from 1 to four times the number of processors. More threads than processors are a warning.
void add_threads(CLI::App& command, int& threads);

/// Sets the number of threads of all parallel loops to `threads`, or leaves what OpenMP offers when it is 0.
/// @throws UsageError when OMP_NUM_THREADS asks for more threads than --threads may.
void use_threads(int threads);

} // namespace periporo::cli
