// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where results come from.
#pragma once

#include "io/input_hashes.hpp"

#include <map>
#include <string>

namespace periporo {

/// Version, compiler, standard, threads (0 for what OpenMP offers) and pack width of this program; every file that the
/// run has read, as "path sha256 hash": "file_case", "file_include_1", "file_body.soil.water.file",
/// "plugin_material_sand", "library_libmine.so".
std::map<std::string, std::string> provenance(const InputHashes& inputs, int threads);

} // namespace periporo
