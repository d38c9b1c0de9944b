// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps --resume from touching what is no unfinished run of the case.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <filesystem>

namespace periporo::cli {

/// Looks at the run in a folder that check_result_folder() has let pass, and changes nothing. A checkpoint is looked at
/// later, by find_checkpoint().
/// @throws UsageError with a way out when the run is complete, by its summary or by its results; or when it has no
/// checkpoint and is of another case, has failed, or has left results that a new run would replace
void require_unfinished_run(const std::filesystem::path& folder, const CaseDescription& description,
                            const PluginRegistry& registry);

} // namespace periporo::cli
