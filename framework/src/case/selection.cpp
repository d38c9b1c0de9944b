// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Follows the selector of a table to the rules it chooses.
#include "case/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace periporo {
namespace {

void add_rules(SelectedRules& selected, const TableRules& rules)
{
    selected.records.insert(selected.records.end(), rules.parameters.begin(), rules.parameters.end());
    selected.nested.insert(selected.nested.end(), rules.nested.begin(), rules.nested.end());
    selected.planes.insert(rules.planes.begin(), rules.planes.end());
}

std::string default_choice(const TableRules& rules)
{
    for (const Parameter& record : rules.parameters)
        if (record.name == rules.selector && record.default_value)
            return std::get<std::string>(*record.default_value);
    return {};
}

void select_variant(SelectedRules& selected, const TableRules& rules)
{
    selected.sound = false;
    for (const TableVariant& variant : rules.variants) {
        if (variant.choice == selected.choice) {
            add_rules(selected, variant.rules);
            selected.sound = true;
            continue;
        }
        for (const Parameter& record : variant.rules.parameters)
            selected.elsewhere.emplace(record.name, variant.choice);
        for (const NestedRules& nested : variant.rules.nested)
            selected.elsewhere.emplace(nested.name, variant.choice);
    }
}

void select_plugin(SelectedRules& selected, PluginKind kind, const Place& place, const std::string& label,
                   const PluginRegistry& registry, Diagnostics& diagnostics)
{
    const PluginRecord* plugin = registry.find(kind, selected.choice);
    selected.sound = plugin != nullptr;
    if (plugin == nullptr) {
        const std::string message = registry.missing_message(kind, selected.choice);
        const std::size_t end = std::min(message.find('\n'), message.size());
        diagnostics.error(place, message.substr(0, end), message.substr(std::min(end + 1, message.size())));
        return;
    }
    for (const Parameter& record : plugin->parameters)
        if (selected.knows(record.name))
            diagnostics.error(place,
                              fmt::format("{} '{}' declares the parameter '{}', which the framework has in {}",
                                          kind_name(kind), selected.choice, record.name, label),
                              "a fault of the plugin in " + plugin->file.string());
    selected.plugin_records = plugin->parameters;
}

} // namespace

bool SelectedRules::knows(const std::string& key) const
{
    const auto named = [&key](const auto& rule) { return rule.name == key; };
    return std::any_of(records.begin(), records.end(), named) ||
           std::any_of(plugin_records.begin(), plugin_records.end(), named) ||
           std::any_of(nested.begin(), nested.end(), named);
}

bool SelectedRules::might_know(const std::string& key) const
{
    // Without variants it is a plugin that is missing, and nothing is known of its keys.
    return !sound && (elsewhere.empty() || elsewhere.contains(key));
}

SelectedRules select_rules(const CaseNode& table, const TableRules& rules, const std::string& label,
                           const PluginRegistry& registry, Diagnostics& diagnostics)
{
    SelectedRules selected;
    add_rules(selected, rules);
    if (rules.selector.empty())
        return selected;
    selected.selector = rules.selector;
    const CaseEntry* entry = table.find(rules.selector);
    if (entry == nullptr)
        selected.choice = default_choice(rules);
    else if (entry->node.text() != nullptr)
        selected.choice = *entry->node.text();

    if (!rules.plugin)
        select_variant(selected, rules);
    else if (entry != nullptr && entry->node.text() != nullptr)
        select_plugin(selected, *rules.plugin, entry->node.place, label, registry, diagnostics);
    else
        selected.sound = false;
    return selected;
}

} // namespace periporo
