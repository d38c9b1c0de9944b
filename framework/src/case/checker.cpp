// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Walks through a case and its rules side by side.
#include "case/checker.hpp"

#include "case/plane.hpp"
#include "case/selection.hpp"
#include "case/value.hpp"
#include "sdk/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace periporo {
namespace {

std::string label_of(const std::string& path, TableShape shape)
{
    if (path.empty())
        return "the case";
    return shape == TableShape::list ? fmt::format("[[{}]]", path) : fmt::format("[{}]", path);
}

/// Names must be usable as bare TOML keys and in overrides.
bool is_plain_name(const std::string& name)
{
    constexpr std::string_view allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
    return !name.empty() && name.find_first_not_of(allowed) == std::string::npos;
}

/// Checks one table; tables inside it are checked by objects of their own.
class TableChecker {
public:
    TableChecker(const CaseNode& node, std::string path, const PluginRegistry& registry, Diagnostics& diagnostics)
        : node_(node), path_(std::move(path)), registry_(registry), diagnostics_(diagnostics)
    {
    }

    CheckedTable check(const TableRules& rules, TableShape shape, const Place& place)
    {
        result_.label = label_of(path_, shape);
        result_.place = place;
        selected_ = select_rules(node_, rules, result_.label, registry_, diagnostics_);
        for (const Parameter& record : selected_.records)
            read(record, result_.own);
        for (const Parameter& record : selected_.plugin_records)
            read(record, result_.plugin);
        report_unknown_keys();
        report_missing_keys();
        for (const NestedRules& nested : selected_.nested)
            check_nested(nested);
        result_.records = std::move(selected_.records);
        result_.plugin_records = std::move(selected_.plugin_records);
        result_.nested = std::move(selected_.nested);
        return std::move(result_);
    }

private:
    /// The entry of a record under its name or a former one.
    const CaseEntry* find_entry(const Parameter& record)
    {
        const CaseEntry* entry = node_.find(record.name);
        for (const std::string& former : record.former_names) {
            const CaseEntry* old = node_.find(former);
            if (old == nullptr)
                continue;
            former_.insert(former);
            if (entry != nullptr) {
                diagnostics_.error(old->place, fmt::format("'{}' is the former name of '{}', which is given too",
                                                           former, record.name));
                continue;
            }
            diagnostics_.warning(old->place, fmt::format("'{}' is now called '{}'", former, record.name));
            entry = old;
        }
        return entry;
    }

    void read(const Parameter& record, Parameters& values)
    {
        const CaseEntry* entry = find_entry(record);
        if (entry == nullptr) {
            if (record.default_value)
                values.set(record.name, *record.default_value);
            else if (record.required)
                missing_.push_back(&record);
            return;
        }
        result_.places[record.name] = entry->node.place;
        if (const CaseNode::Array* array = entry->node.array())
            for (const CaseNode& member : *array)
                result_.members[record.name].push_back(member.place);
        std::optional<ParameterValue> value = read_value(entry->node, record, diagnostics_);
        if (value && selected_.planes.contains(record.name))
            value = read_planes(entry->node, std::move(*value));
        if (value)
            values.set(record.name, std::move(*value));
    }

    /// Planes in SI, so that what follows need not know how they were written.
    std::optional<ParameterValue> read_planes(const CaseNode& node, ParameterValue value)
    {
        bool sound = true;
        const auto normalize = [&](std::string& text, const Place& place, bool cylinders) {
            try {
                const PlaneDescription plane = parse_plane(text);
                if (plane.axis == cylinder_axis && !cylinders)
                    throw std::invalid_argument(fmt::format("\"{}\" is a cylinder, which only rollers may be", text));
                text = plane_text(plane);
            } catch (const std::invalid_argument& fault) {
                diagnostics_.error(place, fault.what(), "write a plane as \"x = 100 mm\"");
                sound = false;
            }
        };
        if (auto* text = std::get_if<std::string>(&value))
            normalize(*text, node.place, false);
        if (auto* list = std::get_if<std::vector<std::string>>(&value))
            for (std::size_t i = 0; i < list->size(); ++i)
                normalize((*list)[i], (*node.array())[i].place, true);
        return sound ? std::optional(std::move(value)) : std::nullopt;
    }

    void report_unknown_keys()
    {
        for (const CaseEntry& entry : *node_.table()) {
            if (selected_.knows(entry.key) || selected_.might_know(entry.key) || former_.contains(entry.key))
                continue;
            const auto other = selected_.elsewhere.find(entry.key);
            if (other == selected_.elsewhere.end())
                report_unknown_key(entry);
            else
                diagnostics_.error(
                    entry.place,
                    fmt::format("'{}' does not belong to {} = \"{}\"", entry.key, selected_.selector, selected_.choice),
                    fmt::format("it is a key of {} = \"{}\"", selected_.selector, other->second));
        }
    }

    void report_unknown_key(const CaseEntry& entry)
    {
        std::vector<std::string> names;
        std::vector<std::string> allowed;
        for (const auto* records : {&selected_.records, &selected_.plugin_records})
            for (const Parameter& record : *records) {
                names.push_back(record.name);
                allowed.push_back(fmt::format("{} ({})", record.name, type_text(record)));
            }
        for (const NestedRules& nested : selected_.nested) {
            names.push_back(nested.name);
            allowed.push_back(fmt::format("{} (table)", nested.name));
        }
        std::string hint;
        if (const std::optional<std::string> nearest = nearest_name(entry.key, names)) {
            hint = fmt::format("did you mean '{}'?\n", *nearest);
            suggested_.insert(*nearest);
        }
        diagnostics_.error(entry.place, fmt::format("unknown key '{}' in {}", entry.key, result_.label),
                           hint + fmt::format("allowed: {}", fmt::join(allowed, ", ")));
    }

    /// A missing key is not reported again when a misspelt one was taken for it.
    void report_missing_keys()
    {
        for (const Parameter* record : missing_)
            if (!suggested_.contains(record->name))
                diagnostics_.error(result_.place, fmt::format("missing key '{}' in {}", record->name, result_.label),
                                   fmt::format("{}: {}", record->name, describe(*record)));
    }

    void check_nested(const NestedRules& nested)
    {
        const CaseEntry* entry = node_.find(nested.name);
        if (entry == nullptr) {
            static const CaseNode empty{CaseNode::Table{}, {}};
            if (nested.presence == TablePresence::defaulted)
                add_table(nested, empty, {}, result_.place);
            else if (nested.presence == TablePresence::required && !suggested_.contains(nested.name))
                diagnostics_.error(result_.place, fmt::format("missing {} in {}", shape_text(nested), result_.label),
                                   nested.documentation);
            return;
        }
        switch (nested.shape) {
        case TableShape::single:
            return check_single(nested, *entry);
        case TableShape::named:
            return check_named(nested, *entry);
        case TableShape::list:
            return check_list(nested, *entry);
        }
    }

    std::string child_path(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

    std::string shape_text(const NestedRules& nested) const
    {
        const std::string path = child_path(nested.name);
        return label_of(nested.shape == TableShape::named ? path + ".NAME" : path, nested.shape);
    }

    void add_table(const NestedRules& nested, const CaseNode& node, const std::string& name, const Place& place)
    {
        const std::string path = child_path(nested.name) + (name.empty() ? "" : "." + name);
        CheckedTable table = TableChecker(node, path, registry_, diagnostics_).check(nested.rules, nested.shape, place);
        table.name = name;
        result_.tables[nested.name].push_back(std::move(table));
    }

    void wrong_shape(const NestedRules& nested, const Place& place, const CaseNode& found)
    {
        diagnostics_.error(place,
                           fmt::format("'{}' must be {}, not {}", nested.name, shape_text(nested), found_text(found)),
                           nested.documentation);
    }

    void check_single(const NestedRules& nested, const CaseEntry& entry)
    {
        if (entry.node.table() == nullptr)
            return wrong_shape(nested, entry.node.place, entry.node);
        add_table(nested, entry.node, {}, entry.node.place);
    }

    void check_named(const NestedRules& nested, const CaseEntry& entry)
    {
        if (entry.node.table() == nullptr)
            return wrong_shape(nested, entry.node.place, entry.node);
        if (entry.node.table()->empty() && nested.presence == TablePresence::required)
            diagnostics_.error(entry.node.place, fmt::format("there is no {}", shape_text(nested)),
                               nested.documentation);
        for (const CaseEntry& member : *entry.node.table()) {
            if (member.node.table() == nullptr)
                diagnostics_.error(
                    member.place,
                    fmt::format("'{}' stands where the name of a {} is expected", member.key, nested.name),
                    fmt::format("begin the table with {}", shape_text(nested)));
            else if (!is_plain_name(member.key))
                diagnostics_.error(member.place,
                                   fmt::format("\"{}\" cannot be the name of a {}", member.key, nested.name),
                                   "use letters, digits, '_' and '-'");
            else
                add_table(nested, member.node, member.key, member.node.place);
        }
    }

    void check_list(const NestedRules& nested, const CaseEntry& entry)
    {
        const CaseNode::Array* array = entry.node.array();
        if (array == nullptr)
            return wrong_shape(nested, entry.node.place, entry.node);
        if (array->empty() && nested.presence == TablePresence::required)
            diagnostics_.error(entry.node.place, fmt::format("there is no {}", shape_text(nested)),
                               nested.documentation);
        for (const CaseNode& member : *array) {
            if (member.table() == nullptr)
                wrong_shape(nested, member.place, member);
            else
                add_table(nested, member, {}, member.place);
        }
    }

    const CaseNode& node_;
    std::string path_;
    const PluginRegistry& registry_;
    Diagnostics& diagnostics_;

    CheckedTable result_;
    SelectedRules selected_;
    std::set<std::string> former_;    ///< former names that were used
    std::set<std::string> suggested_; ///< names offered for misspelt keys
    std::vector<const Parameter*> missing_;
};

} // namespace

const std::vector<CheckedTable>& CheckedTable::all(const std::string& nested_name) const
{
    static const std::vector<CheckedTable> none;
    const auto found = tables.find(nested_name);
    return found == tables.end() ? none : found->second;
}

const CheckedTable& CheckedTable::one(const std::string& nested_name) const
{
    return all(nested_name).at(0);
}

const Place& CheckedTable::place_of(const std::string& key) const
{
    const auto found = places.find(key);
    return found == places.end() ? place : found->second;
}

CheckedTable check_case(const CaseNode& root, const TableRules& rules, const PluginRegistry& registry,
                        Diagnostics& diagnostics)
{
    return TableChecker(root, {}, registry, diagnostics).check(rules, TableShape::single, root.place);
}

CheckedTable check_case(const CaseNode& root, const PluginRegistry& registry, Diagnostics& diagnostics)
{
    return check_case(root, case_rules(), registry, diagnostics);
}

} // namespace periporo
