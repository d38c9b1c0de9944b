// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The number of threads of the commands that compute. More threads than processors are a warning.
#pragma once

namespace periporo::cli {

/// The number of processors that OpenMP may use.
int processors();

/// The most that --threads may ask for: four times the number of processors, and at least 64.
int most_threads();

/// Sets the number of threads of all parallel loops to `threads`, or leaves what OpenMP offers when it is 0.
/// @throws UsageError when OMP_NUM_THREADS asks for more threads than --threads may.
void use_threads(int threads);

} // namespace periporo::cli
