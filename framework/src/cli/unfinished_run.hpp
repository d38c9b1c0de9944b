// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps --resume from touching what is no unfinished run of the case.
#pragma once

#include <filesystem>
#include <string>

namespace periporo::cli {

/// Changes nothing. A checkpoint is looked at later, by find_checkpoint().
/// @throws UsageError with a way out when the folder holds no run, a run that is complete or that failed before its
/// first checkpoint, or, without a checkpoint, the run of another case
void require_unfinished_run(const std::filesystem::path& folder, const std::string& resolved_case);

} // namespace periporo::cli
