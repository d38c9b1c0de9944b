// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From TOML text to the tree of a case. The only door to the TOML library.
#pragma once

#include "case/diagnostics.hpp"
#include "case/node.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace periporo {

/// Reads a file and everything it includes: `include = ["base.toml"]` gives tables that the including file extends and
/// overrides key by key; lists are replaced as a whole. The result has no key `include`.
/// @param files_read gets every file that was read, the first one first
/// @throws CaseError when a file cannot be read, is no TOML, or includes itself.
CaseNode read_toml_files(const std::filesystem::path& file, Diagnostics& diagnostics,
                         std::vector<std::filesystem::path>* files_read = nullptr);

/// Reads one TOML value, "0.5" or "[1, 2]", or nothing when the text is none. All places are the source as a whole.
std::optional<CaseNode> parse_toml_value(const std::string& text, const std::shared_ptr<const CaseSource>& source);

} // namespace periporo
