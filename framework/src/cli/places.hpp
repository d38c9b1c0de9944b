// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tries whether results can be written to a place, before a command computes them.
#pragma once

#include <filesystem>

namespace periporo::cli {

/// Makes a folder that is missing, with those above it, and removes them again. @throws UsageError with a way out when
/// it cannot be made or written
void require_possible_folder(const std::filesystem::path& folder);

/// Makes a file beside the one that is to be written, and removes it again. @throws UsageError with a way out
void require_possible_file(const std::filesystem::path& file);

} // namespace periporo::cli
