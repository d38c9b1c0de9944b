// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The outcome of a path as files and as text.
#pragma once

#include "drive/path_driver.hpp"

namespace periporo {

/// Names of the files in the folder of a path, so that those of an earlier one can be told and removed.
inline constexpr const char* path_result_names[] = {"path.toml", "path.csv", "yield_surface.csv", "failing_step.toml"};

/// Writes into the folder, each file complete or not at all: the resolved path, a row of path.csv a step, the yield
/// surfaces at start and end when the law has them, and failing_step.toml when a step failed. Removes those of an
/// earlier path first.
/// @throws std::runtime_error when a file cannot be written.
void write_path_results(const PathDescription& path, const PathRecord& record, const std::filesystem::path& folder);

/// Header and rows: step, stage, time, stresses, strains, invariants, specific volume and void ratio when the porosity
/// at the start is known, water, and all state variables. Numbers read back as the same doubles.
std::string path_table(const PathDescription& path, const PathRecord& record);

/// A path that begins before the failed step, makes this step alone, and so fails in the same way.
std::string failing_step_text(const PathDescription& path, const PathRecord& record);

/// Where the path came to, in one line.
std::string summary_line(const PathDescription& path, const PathRecord& record);

/// What failed, where, and in which state.
std::string failure_text(const PathDescription& path, const PathRecord& record);

} // namespace periporo
