// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps one run from writing into the results of another, or over files of somebody else.
#pragma once

#include "io/folder_lock.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace periporo::cli {

enum class ExistingResults {
    refuse,   ///< the default: nothing is lost by accident
    resume,   ///< go on from what is there
    overwrite ///< delete what is there
};

/// The first names of a list, for the terminal, and how many more there are.
std::string list_of(const std::vector<std::string>& names);

/// Where results go when nothing else is said: `results/<name of the case file>` under the current folder, the name
/// without its extension and without dots at its beginning.
std::filesystem::path default_result_folder(const std::filesystem::path& case_file);

/// Makes sure that results may be written to `folder`. Makes and deletes nothing.
/// @param of_writers names that the writers of the case make
/// @throws UsageError or FolderError with a way out.
void check_result_folder(const std::filesystem::path& folder, ExistingResults existing,
                         const std::vector<std::string>& of_writers);

/// Keeps --overwrite from deleting what the case reads. @throws UsageError naming the input
void require_no_input_in(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& inputs,
                         const std::vector<std::string>& of_writers);

/// Checks the folder again, and keeps it for this run as long as the lock lives. With `overwrite` deletes what a run
/// wrote there and nothing else: files of somebody else stay, and are named on standard error.
/// @throws UsageError or FolderError with a way out; nothing is changed then.
FolderLock take_result_folder(const std::filesystem::path& folder, ExistingResults existing,
                              const std::vector<std::string>& of_writers);

} // namespace periporo::cli
