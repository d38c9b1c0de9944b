// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the writers of a case find of an earlier run in a folder.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace periporo {

struct EarlierResults {
    std::vector<std::string> holds;   ///< rows and snapshots in words
    bool complete = false;            ///< a writer says that the run is complete
    std::vector<std::string> missing; ///< files that a complete run leaves, and that are not there or not whole
};

/// Looks and changes nothing. @throws FolderError when something there cannot be read
EarlierResults earlier_results(const CaseDescription& description, const PluginRegistry& registry,
                               const std::filesystem::path& folder);

/// Names of the files and folders that the writers of a case make.
std::vector<std::string> files_of_writers(const CaseDescription& description, const PluginRegistry& registry);

} // namespace periporo
