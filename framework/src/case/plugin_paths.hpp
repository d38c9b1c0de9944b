// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where a case says that further plugins are.
#pragma once

#include "case/diagnostics.hpp"
#include "case/node.hpp"

#include <filesystem>
#include <vector>

namespace periporo {

/// Makes the paths of [plugins] absolute, each relative to the file it was written in (an override: to the current
/// folder), and returns them. A path that is no folder is a warning: plugins of it will be missed. What is not a list
/// of texts is left for the check to report.
std::vector<std::filesystem::path> resolve_plugin_paths(CaseNode& root, Diagnostics& diagnostics);

} // namespace periporo
