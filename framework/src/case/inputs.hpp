// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a checked case names outside of itself, and where its parts stand.
#pragma once

#include "case/checker.hpp"
#include "case/description.hpp"

#include <map>
#include <string>
#include <vector>

namespace periporo {

/// The library of every plugin that the case uses, of all kinds, and every file that a parameter names (Naming::file).
/// A role tells the place in the case: "plugin material sand", "body.soil.water.file".
std::vector<InputFile> files_named_by(const CheckedTable& root, const PluginRegistry& registry);

/// "case.toml:12:1" of every table, "body.soil", "stage.0", "body.soil.geometry", and of every value that the user
/// gave, "body.soil.geometry.size".
std::map<std::string, std::string> places_of(const CheckedTable& root);

} // namespace periporo
