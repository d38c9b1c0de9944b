// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Walks through the checked tables of a case.
#include "case/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace periporo {
namespace {

/// Calls visit(table, path, rules) for every table below a parent; the path is "body.soil.geometry" or "stage.0".
template <class Visit>
void visit_tables(const CheckedTable& parent, const std::string& path, const Visit& visit)
{
    for (const NestedRules& nested : parent.nested) {
        const std::vector<CheckedTable>& tables = parent.all(nested.name);
        for (std::size_t n = 0; n < tables.size(); ++n) {
            std::string here = path + nested.name;
            if (nested.shape == TableShape::named)
                here += "." + tables[n].name;
            if (nested.shape == TableShape::list)
                here += fmt::format(".{}", n);
            visit(tables[n], here, nested.rules);
            visit_tables(tables[n], here + ".", visit);
        }
    }
}

void add_plugin(std::vector<InputFile>& files, const CheckedTable& table, const TableRules& rules,
                const PluginRegistry& registry)
{
    const std::string& name = std::get<std::string>(table.own.values().at(rules.selector));
    const PluginRecord* plugin = registry.find(*rules.plugin, name);
    const std::string role = fmt::format("plugin {} {}", kind_name(*rules.plugin), name);
    if (plugin != nullptr && std::ranges::find(files, role, &InputFile::role) == files.end())
        files.push_back({role, plugin->file});
}

void add_files(std::vector<InputFile>& files, const std::vector<Parameter>& records, const Parameters& values,
               const std::string& path)
{
    for (const Parameter& record : records) {
        const auto value = values.values().find(record.name);
        if (record.naming == Naming::file && value != values.values().end())
            files.push_back({path + "." + record.name, std::get<std::string>(value->second)});
    }
}

} // namespace

std::vector<InputFile> files_named_by(const CheckedTable& root, const PluginRegistry& registry)
{
    std::vector<InputFile> files;
    visit_tables(root, {}, [&](const CheckedTable& table, const std::string& path, const TableRules& rules) {
        if (rules.plugin)
            add_plugin(files, table, rules, registry);
        add_files(files, table.records, table.own, path);
        add_files(files, table.plugin_records, table.plugin, path);
    });
    return files;
}

std::map<std::string, std::string> places_of(const CheckedTable& root)
{
    std::map<std::string, std::string> places;
    const auto add = [&](const CheckedTable& table, const std::string& path) {
        places[path] = place_text(table.place);
        for (const auto& [key, place] : table.places)
            places[path.empty() ? key : path + "." + key] = place_text(place);
    };
    add(root, {});
    visit_tables(root, {},
                 [&](const CheckedTable& table, const std::string& path, const TableRules&) { add(table, path); });
    return places;
}

} // namespace periporo
