// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small files of text, complete or absent.
#pragma once

#include <filesystem>
#include <string_view>

namespace periporo {

/// Writes `text` aside, to `<file>.part`, and renames it over `file`.
/// @throws std::runtime_error naming the file that could not be written
/// @throws std::filesystem::filesystem_error when it could not be renamed
void write_whole(const std::filesystem::path& file, std::string_view text);

} // namespace periporo
