// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Holds the tree of a case against the rules: the one routine that knows what is an error in a table.
#pragma once

#include "case/diagnostics.hpp"
#include "case/node.hpp"
#include "case/schema.hpp"
#include "plugins/registry.hpp"

#include <map>
#include <string>
#include <vector>

namespace periporo {

/// A table after the check: values in SI with the defaults filled in, and where they came from.
struct CheckedTable {
    std::string label;                                 ///< "[material.soil]", for messages
    std::string name;                                  ///< "soil" of [material.soil]; else empty
    Place place;                                       ///< of the header, or of the parent for a defaulted table
    std::vector<Parameter> records;                    ///< of the framework
    std::vector<Parameter> plugin_records;             ///< of the plugin chosen here
    Parameters own;                                    ///< values of `records`
    Parameters plugin;                                 ///< values of `plugin_records`
    std::map<std::string, Place> places;               ///< of the values that the user gave
    std::map<std::string, std::vector<Place>> members; ///< of the members of given lists
    std::vector<NestedRules> nested;                   ///< rules of the tables below, variant included
    std::map<std::string, std::vector<CheckedTable>> tables;

    /// The tables of a nested name, none or one for a single table.
    const std::vector<CheckedTable>& all(const std::string& nested_name) const;
    /// A single table that is required or defaulted. Only after a check without errors.
    const CheckedTable& one(const std::string& nested_name) const;
    /// Place of a value, or of the table when the value is a default.
    const Place& place_of(const std::string& key) const;
};

/// Checks a whole case against the rules of its root table; every error goes to `diagnostics` and what is right is
/// still in the result.
CheckedTable check_case(const CaseNode& root, const TableRules& rules, const PluginRegistry& registry,
                        Diagnostics& diagnostics);
/// The same against case_rules().
CheckedTable check_case(const CaseNode& root, const PluginRegistry& registry, Diagnostics& diagnostics);

} // namespace periporo
