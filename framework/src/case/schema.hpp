// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shape of a case file as data: which tables there are and the parameter records of each.
#pragma once

#include "periporo/parameters.hpp"
#include "periporo/plugin.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace periporo {

struct NestedRules;
struct TableVariant;

/// What may stand in one table.
struct TableRules {
    TableRules();
    TableRules(std::vector<Parameter> parameters);

    std::vector<Parameter> parameters;
    std::vector<NestedRules> nested;
    /// The text parameter that decides what else may stand here: a variant below, or the records of a plugin.
    std::string selector;
    std::vector<TableVariant> variants;
    std::optional<PluginKind> plugin;
    /// Those of the text parameters that are coordinate planes, "x = 100 mm".
    std::vector<std::string> planes;
};

/// Further rules of a table whose selector has the value `choice`.
struct TableVariant {
    std::string choice;
    TableRules rules;
};

enum class TableShape {
    single, ///< [time]
    named,  ///< [material.soil], one for each name
    list    ///< [[stage]]
};

enum class TablePresence {
    required,  ///< an error when it is missing
    defaulted, ///< read as an empty table when it is missing
    optional   ///< may be missing and then means nothing
};

/// A table inside another one.
struct NestedRules {
    std::string name;
    TableShape shape = TableShape::single;
    TablePresence presence = TablePresence::required;
    std::string documentation;
    TableRules rules;
};

// Not inside the class: the vectors of it hold types that are complete only here.
inline TableRules::TableRules() = default;
inline TableRules::TableRules(std::vector<Parameter> records) : parameters(std::move(records)) {}

/// The whole case. The key `include` is not part of it: it is gone after reading the files.
const TableRules& case_rules();

} // namespace periporo
