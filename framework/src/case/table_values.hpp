// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How values are taken from checked tables: by the checks between tables, for which values that were wrong themselves
// are absent, and by those who move them to where they belong.
#pragma once

#include "case/checker.hpp"
#include "case/description.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace periporo {

/// A value if it was given soundly or has a default. Looks at the values directly: a check is no consumption.
template <class Value>
const Value* value_of(const Parameters& values, const std::string& key)
{
    const auto found = values.values().find(key);
    return found == values.values().end() ? nullptr : std::get_if<Value>(&found->second);
}

template <class Value>
const Value* value_of(const CheckedTable& table, const std::string& key)
{
    return value_of<Value>(table.own, key);
}

inline std::vector<std::string> names_of(const std::vector<CheckedTable>& tables)
{
    std::vector<std::string> names;
    names.reserve(tables.size());
    for (const CheckedTable& table : tables)
        names.push_back(table.name);
    return names;
}

inline bool contains(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

inline std::optional<double> optional_real(const Parameters& values, const std::string& name)
{
    return values.has(name) ? std::optional(values.real(name)) : std::nullopt;
}

inline std::vector<std::string> optional_texts(const Parameters& values, const std::string& name)
{
    return values.has(name) ? values.text_list(name) : std::vector<std::string>{};
}

/// @param selector key that names the plugin
inline PluginChoice plugin_choice(const CheckedTable& table, const std::string& selector)
{
    return {table.own.text(selector), table.plugin};
}

} // namespace periporo
