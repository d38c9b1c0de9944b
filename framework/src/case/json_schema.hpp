// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shape of a case file for editors: completion, meaning and a first check while typing.
#pragma once

#include "case/schema.hpp"
#include "plugins/registry.hpp"

#include <nlohmann/json_fwd.hpp>

namespace periporo {

/// JSON schema (draft 4, the one that editors of TOML understand) of a case file with the plugins of the registry. Keys
/// that must be there are not demanded, since an included file may hold them, and numbers with units are checked for
/// their form only: what a whole case lacks, `check` says.
nlohmann::json json_schema(const TableRules& rules, const PluginRegistry& registry);

} // namespace periporo
