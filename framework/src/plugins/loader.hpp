// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Opens a shared library and fetches the descriptor it exports.
#pragma once

#include "periporo/plugin.hpp"

#include <filesystem>

namespace periporo {

/// The descriptor that the library exports, unchecked and possibly null. The library stays loaded until the process
/// ends, so everything reached through the descriptor stays valid.
/// @throws std::runtime_error with the reason when the file cannot be loaded or lacks the symbol.
const PluginDescriptor* load_descriptor(const std::filesystem::path& file);

} // namespace periporo
