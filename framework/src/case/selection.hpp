// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which rules hold for one table of a case, once its selector has chosen a variant or a plugin.
#pragma once

#include "case/diagnostics.hpp"
#include "case/node.hpp"
#include "case/schema.hpp"
#include "plugins/registry.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace periporo {

struct SelectedRules {
    std::vector<Parameter> records;        ///< of the framework
    std::vector<Parameter> plugin_records; ///< of the plugin
    std::vector<NestedRules> nested;
    std::set<std::string> planes;

    std::string selector;                         ///< empty when nothing is to choose
    std::string choice;                           ///< value of the selector; empty when it is missing
    bool sound = true;                            ///< false when the choice is missing or unknown
    std::map<std::string, std::string> elsewhere; ///< keys of other variants, and of which

    /// True for a key that may stand in the table.
    bool knows(const std::string& key) const;
    /// True for an unknown key that a sound choice might have allowed, and that is therefore not judged.
    bool might_know(const std::string& key) const;
};

/// Reports a plugin that is not there. A selector that is wrong otherwise is left to the check of its own value.
/// @param label of the table, for messages.
SelectedRules select_rules(const CaseNode& table, const TableRules& rules, const std::string& label,
                           const PluginRegistry& registry, Diagnostics& diagnostics);

} // namespace periporo
