// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where results come from.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <map>
#include <string>

namespace periporo {

/// Version, compiler, standard, threads (0 for what OpenMP offers) and pack width of this program; every plugin that
/// the case names, with its file and a CRC-32 of it.
std::map<std::string, std::string> provenance(const CaseDescription& description, const PluginRegistry& registry,
                                              int threads);

} // namespace periporo
