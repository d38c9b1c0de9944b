// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps one run from writing into the results of another.
#pragma once

#include <filesystem>

namespace periporo::cli {

enum class ExistingResults {
    refuse,   ///< the default: nothing is lost by accident
    resume,   ///< go on from what is there
    overwrite ///< delete what is there
};

/// Where results go when nothing else is said: `results/<name of the case file>` under the current folder.
std::filesystem::path default_result_folder(const std::filesystem::path& case_file);

/// Makes sure that results may be written to `folder`. Makes and deletes nothing.
/// @throws UsageError with a way out.
void check_result_folder(const std::filesystem::path& folder, ExistingResults existing);

/// Checks the folder again and, with `overwrite`, empties it, but only one that holds results of this program.
/// @throws UsageError with a way out.
void prepare_result_folder(const std::filesystem::path& folder, ExistingResults existing);

} // namespace periporo::cli
