// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes checked tables as TOML.
#include "case/resolved.hpp"

#include <fmt/format.h>

namespace periporo {
namespace {

/// A TOML basic string.
std::string quoted(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += fmt::format("\\{}", c);
        else if (code < 0x20 || code == 0x7f)
            result += fmt::format("\\u{:04X}", code);
        else
            result += c;
    }
    return result + "\"";
}

/// Shortest text that reads back to the same double and is a float in TOML.
std::string written(double value)
{
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text;
}

std::string written(std::int64_t value)
{
    return fmt::format("{}", value);
}

std::string written(bool value)
{
    return value ? "true" : "false";
}

std::string written(const std::string& value)
{
    return quoted(value);
}

template <class Member>
std::string written(const std::vector<Member>& list)
{
    std::string text = "[";
    for (const Member& member : list)
        text += (text.size() > 1 ? ", " : "") + written(member);
    return text + "]";
}

void append_values(std::string& text, const std::vector<Parameter>& records, const Parameters& values)
{
    for (const Parameter& record : records) {
        const auto found = values.values().find(record.name);
        if (found == values.values().end())
            continue;
        text += fmt::format("{} = {}", record.name, toml_text(found->second));
        if (record.dimension != dimension::none)
            text += fmt::format("  # {}", si_unit(record.dimension));
        text += '\n';
    }
}

void append_tables(std::string& text, const CheckedTable& parent, const std::string& path)
{
    for (const NestedRules& nested : parent.nested) {
        for (const CheckedTable& table : parent.all(nested.name)) {
            const std::string here = path + nested.name + (table.name.empty() ? "" : "." + table.name);
            text += nested.shape == TableShape::list ? fmt::format("\n[[{}]]\n", here) : fmt::format("\n[{}]\n", here);
            append_values(text, table.records, table.own);
            append_values(text, table.plugin_records, table.plugin);
            append_tables(text, table, here + ".");
        }
    }
}

} // namespace

std::string toml_text(const ParameterValue& value)
{
    return std::visit([](const auto& held) { return written(held); }, value);
}

std::string resolved_text(const CheckedTable& root)
{
    std::string text = "# The whole case: defaults, includes and overrides filled in, numbers in SI units.\n";
    append_values(text, root.records, root.own);
    append_tables(text, root, {});
    return text;
}

} // namespace periporo
