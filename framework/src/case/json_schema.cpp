// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "case/json_schema.hpp"

#include "case/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace periporo {
namespace {

using nlohmann::json;

/// A number, with its unit when there is one to give.
constexpr const char* quantity_pattern = R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(\s.*)?$)";
constexpr const char* plane_pattern = R"(^\s*[xyzr]\s*=)";

void add_bounds(json& number, const Parameter& parameter)
{
    if (std::isfinite(parameter.minimum)) {
        number["minimum"] = parameter.minimum;
        if (parameter.minimum_excluded)
            number["exclusiveMinimum"] = true;
    }
    if (std::isfinite(parameter.maximum)) {
        number["maximum"] = parameter.maximum;
        if (parameter.maximum_excluded)
            number["exclusiveMaximum"] = true;
    }
}

json real_schema(const Parameter& parameter)
{
    json number{{"type", "number"}};
    add_bounds(number, parameter);
    return {{"anyOf", json::array({number, {{"type", "string"}, {"pattern", quantity_pattern}}})}};
}

json list_schema(const Parameter& parameter, json member)
{
    json list{{"type", "array"}, {"items", std::move(member)}};
    if (parameter.list_size > 0)
        list["minItems"] = list["maxItems"] = parameter.list_size;
    return list;
}

json value_schema(const Parameter& parameter, bool plane)
{
    json text{{"type", "string"}};
    if (!parameter.choices.empty())
        text["enum"] = parameter.choices;
    if (plane)
        text["pattern"] = plane_pattern;
    json whole{{"type", "integer"}};
    switch (parameter.type) {
    case ParameterType::real:
        return real_schema(parameter);
    case ParameterType::integer:
        add_bounds(whole, parameter);
        return whole;
    case ParameterType::boolean:
        return {{"type", "boolean"}};
    case ParameterType::text:
        return text;
    case ParameterType::real_list:
        return list_schema(parameter, real_schema(parameter));
    case ParameterType::text_list:
        return list_schema(parameter, text);
    }
    return json::object();
}

void add_parameter(json& properties, const Parameter& parameter, const TableRules& rules)
{
    const bool plane = std::ranges::find(rules.planes, parameter.name) != rules.planes.end();
    json value = value_schema(parameter, plane);
    value["description"] = describe(parameter) + (parameter.required ? ", required" : "");
    if (parameter.default_value)
        std::visit([&](const auto& given) { value["default"] = given; }, *parameter.default_value);
    for (const std::string& former : parameter.former_names) {
        properties[former] = value;
        properties[former]["description"] = fmt::format("former name of {}", parameter.name);
    }
    properties[parameter.name] = std::move(value);
}

json table_schema(const TableRules& rules, const PluginRegistry& registry);

void add_rules(json& properties, const TableRules& rules, const PluginRegistry& registry)
{
    for (const Parameter& parameter : rules.parameters)
        add_parameter(properties, parameter, rules);
    for (const NestedRules& nested : rules.nested) {
        json table = table_schema(nested.rules, registry);
        if (nested.shape == TableShape::named)
            table = {{"type", "object"}, {"additionalProperties", std::move(table)}};
        if (nested.shape == TableShape::list)
            table = {{"type", "array"}, {"items", std::move(table)}};
        table["description"] =
            nested.presence == TablePresence::required ? nested.documentation + ", required" : nested.documentation;
        properties[nested.name] = std::move(table);
    }
}

json object_of(json properties)
{
    return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

/// One object for every value of the selector, since each brings keys of its own; a table that does not choose may have
/// the keys of any.
json table_schema(const TableRules& rules, const PluginRegistry& registry)
{
    json common = json::object();
    add_rules(common, rules, registry);
    json alternatives = json::array();
    json undecided = common;
    const auto offer = [&](const std::string& choice, const std::string& summary, const TableRules& further) {
        json properties = common;
        add_rules(properties, further, registry);
        add_rules(undecided, further, registry);
        properties[rules.selector] = {{"type", "string"}, {"enum", {choice}}, {"description", summary}};
        json object = object_of(std::move(properties));
        object["required"] = {rules.selector};
        alternatives.push_back(std::move(object));
    };
    for (const TableVariant& variant : rules.variants)
        offer(variant.choice, variant.choice, variant.rules);
    if (rules.plugin)
        for (const PluginRecord& plugin : registry.plugins())
            if (plugin.kind == *rules.plugin)
                offer(plugin.name, plugin.summary, TableRules(plugin.parameters));
    if (alternatives.empty())
        return object_of(std::move(common));
    undecided.erase(rules.selector);
    alternatives.push_back(object_of(std::move(undecided)));
    return {{"anyOf", std::move(alternatives)}};
}

} // namespace

nlohmann::json json_schema(const TableRules& rules, const PluginRegistry& registry)
{
    json schema = table_schema(rules, registry);
    schema["$schema"] = "http://json-schema.org/draft-04/schema#";
    schema["title"] = "A case of periporo";
    schema["properties"]["include"] = {{"type", "array"},
                                       {"items", {{"type", "string"}}},
                                       {"description", "Files that this one adds to and overrides, relative to it"}};
    return schema;
}

} // namespace periporo
