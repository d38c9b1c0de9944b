// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps --resume from touching what is no unfinished run of the case.
#pragma once

#include <filesystem>
#include <string>

namespace periporo::cli {

/// Looks at the run in a folder that check_result_folder() has let pass, and changes nothing. A checkpoint is looked at
/// later, by find_checkpoint().
/// @throws UsageError with a way out when the run is complete or failed before its first checkpoint, or, without a
/// checkpoint, is of another case
void require_unfinished_run(const std::filesystem::path& folder, const std::string& resolved_case);

} // namespace periporo::cli
