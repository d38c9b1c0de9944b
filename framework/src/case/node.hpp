// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What was written in a case, as a tree in which everything knows its place. No TOML library beyond this point.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace periporo {

/// A text that case values come from: a file, or one override of the command line.
struct CaseSource {
    std::filesystem::path file;          ///< empty for an override
    std::string override_text;           ///< "body.soil.material=sand"; empty for a file
    std::vector<std::string> lines = {}; ///< of the file, to be shown in errors
    std::size_t order = 0;               ///< sorts the errors of several sources
};

struct Place {
    std::shared_ptr<const CaseSource> source;
    std::size_t line = 0;   ///< from 1; 0 for the source as a whole
    std::size_t column = 0; ///< from 1, in characters
};

struct CaseEntry;

struct CaseNode {
    using Array = std::vector<CaseNode>;
    using Table = std::vector<CaseEntry>; ///< in the order of writing
    /// Something TOML has and a case has no use for: dates and times.
    struct Other {};

    std::variant<double, std::int64_t, bool, std::string, Other, Array, Table> value;
    Place place;

    const Table* table() const { return std::get_if<Table>(&value); }
    Table* table() { return std::get_if<Table>(&value); }
    const Array* array() const { return std::get_if<Array>(&value); }
    Array* array() { return std::get_if<Array>(&value); }
    const std::string* text() const { return std::get_if<std::string>(&value); }

    /// The entry of a table, or null; null too when this is no table.
    const CaseEntry* find(std::string_view key) const;
    CaseEntry* find(std::string_view key);
};

struct CaseEntry {
    std::string key;
    Place place; ///< of the key
    CaseNode node;
};

inline const CaseEntry* CaseNode::find(std::string_view key) const
{
    const Table* entries = table();
    if (entries == nullptr)
        return nullptr;
    const auto found = std::find_if(entries->begin(), entries->end(), [key](const auto& e) { return e.key == key; });
    return found == entries->end() ? nullptr : &*found;
}

inline CaseEntry* CaseNode::find(std::string_view key)
{
    return const_cast<CaseEntry*>(std::as_const(*this).find(key));
}

/// "a number", "a text", ... for messages.
inline std::string kind_of(const CaseNode& node)
{
    static constexpr const char* kinds[] = {"a number",       "a whole number", "true or false", "a text",
                                            "a date or time", "a list",         "a table"};
    return kinds[node.value.index()];
}

/// The same with the value, where it is short: "a text, \"sand\"".
inline std::string found_text(const CaseNode& node)
{
    const std::string kind = kind_of(node);
    if (const auto* number = std::get_if<double>(&node.value))
        return fmt::format("{}, {}", kind, *number);
    if (const auto* whole = std::get_if<std::int64_t>(&node.value))
        return fmt::format("{}, {}", kind, *whole);
    if (const auto* boolean = std::get_if<bool>(&node.value))
        return fmt::format("{}, {}", kind, *boolean);
    return node.text() == nullptr ? kind : fmt::format("{}, \"{}\"", kind, *node.text());
}

} // namespace periporo
