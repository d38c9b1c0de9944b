// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the file of a path as strictly as a case: every error at once, each with its place and a way out.
#pragma once

#include "case/reader.hpp"
#include "drive/path_description.hpp"
#include "plugins/registry.hpp"

namespace periporo {

/// Reads, checks and resolves a path. Loads the plugins it needs into `registry`.
/// @throws CaseError with every error found.
PathDescription read_path(const std::filesystem::path& file, const CaseOptions& options, PluginRegistry& registry);

} // namespace periporo
