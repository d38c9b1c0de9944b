// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The examples of a material, plugins/material/<plugin>/example.toml: parameters to check it with.
//
// Each [material.NAME] is written as in a case; the density of the grains and the porosity, which are the framework's,
// may be left out. A [range.NAME] beside it holds what the checks are to know of it (kit::Range) and defaults do not
// say. @BUILD@ in a text stands for the build folder, for laws that need a library of it.
#pragma once

#include "case/toml_source.hpp"
#include "case/value.hpp"
#include "periporo/material_kit.hpp"

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo::test {

struct MaterialExample {
    std::string name;
    Parameters parameters;
    kit::Range range;
};

/// The members of kit::Range that an example may set; `unlimited_tension` stands for an infinite limit.
inline std::vector<Parameter> range_records()
{
    const kit::Range range;
    return {Parameter::real_list("pressures", dimension::pressure, 0, "Mean pressures of starting states")
                .above(0.0)
                .by_default(range.pressures),
            Parameter::real("stress_ratio", dimension::none, "Largest q/p of starting states")
                .at_least(0.0)
                .by_default(range.stress_ratio),
            Parameter::real("overconsolidation_ratio", dimension::none, "OCR of starting states")
                .at_least(1.0)
                .by_default(range.overconsolidation_ratio),
            Parameter::real_list("strain_increments", dimension::none, 0, "Sizes of strain increments")
                .above(0.0)
                .by_default(range.strain_increments),
            Parameter::real("time_step", dimension::time, "Time step").above(0.0).by_default(range.time_step),
            Parameter::real("suction", dimension::pressure, "Suction").at_least(0.0).by_default(range.suction),
            Parameter::real("saturation", dimension::none, "Degree of saturation")
                .at_least(0.0)
                .at_most(1.0)
                .by_default(range.saturation),
            Parameter::real("tension_limit", dimension::pressure, "Largest mean tension")
                .at_least(0.0)
                .by_default(range.tension_limit),
            Parameter::boolean("unlimited_tension", "Whether any tension is borne").by_default(false),
            Parameter::boolean("rate_dependent", "Whether time changes the stress").by_default(range.rate_dependent),
            Parameter::boolean("stores_energy", "Whether hardening stores energy").by_default(range.stores_energy),
            Parameter::real("accuracy", dimension::none, "Relative accuracy of the law's iterations")
                .above(0.0)
                .by_default(range.accuracy)};
}

/// A value with the build folder in place of @BUILD@.
inline ParameterValue with_build_folder(ParameterValue value)
{
    static const std::string mark = "@BUILD@";
    if (auto* text = std::get_if<std::string>(&value))
        if (const std::size_t at = text->find(mark); at != std::string::npos)
            text->replace(at, mark.size(), PERIPORO_BUILD_DIR);
    return value;
}

/// The values of one table, by the rules of a case; keys in `others` are left to others.
inline Parameters values_in(const CaseNode& table, const std::vector<Parameter>& records,
                            const std::vector<std::string>& others, Diagnostics& diagnostics)
{
    std::map<std::string, ParameterValue> given;
    for (const CaseEntry& entry : *table.table()) {
        const auto record = std::find_if(records.begin(), records.end(),
                                         [&](const Parameter& candidate) { return candidate.name == entry.key; });
        if (record != records.end()) {
            if (const std::optional<ParameterValue> value = read_value(entry.node, *record, diagnostics))
                given[entry.key] = with_build_folder(*value);
        } else if (std::find(others.begin(), others.end(), entry.key) == others.end()) {
            diagnostics.error(entry.place, "unknown key '" + entry.key + "'");
        }
    }
    diagnostics.raise();
    return kit::parameters_of(records, given);
}

inline kit::Range range_of(const Parameters& values)
{
    kit::Range range;
    range.pressures = values.real_list("pressures");
    range.stress_ratio = values.real("stress_ratio");
    range.overconsolidation_ratio = values.real("overconsolidation_ratio");
    range.strain_increments = values.real_list("strain_increments");
    range.time_step = values.real("time_step");
    range.suction = values.real("suction");
    range.saturation = values.real("saturation");
    range.tension_limit =
        values.boolean("unlimited_tension") ? std::numeric_limits<double>::infinity() : values.real("tension_limit");
    range.rate_dependent = values.boolean("rate_dependent");
    range.stores_energy = values.boolean("stores_energy");
    range.accuracy = values.real("accuracy");
    return range;
}

/// All examples of a material plugin.
/// @throws std::exception that names the file, when there is none, it cannot be read, or a value does not fit.
inline std::vector<MaterialExample> material_examples(const std::string& plugin, const std::vector<Parameter>& records)
{
    const std::filesystem::path file =
        std::filesystem::path(PERIPORO_SOURCE_DIR) / "plugins" / "material" / plugin / "example.toml";
    if (!std::filesystem::exists(file))
        throw std::runtime_error("every material comes with an example to check it with; there is no " + file.string());
    Diagnostics diagnostics;
    const CaseNode root = read_toml_files(file, diagnostics);
    const CaseEntry* materials = root.find("material");
    if (materials == nullptr || materials->node.table() == nullptr || materials->node.table()->empty())
        throw std::runtime_error(file.string() + " has no [material.example]");
    const CaseEntry* ranges = root.find("range");
    if (ranges != nullptr)
        for (const CaseEntry& range : *ranges->node.table())
            if (materials->node.find(range.key) == nullptr)
                diagnostics.error(range.place, "[range." + range.key + "] has no [material." + range.key + "]");
    std::vector<MaterialExample> examples;
    for (const CaseEntry& material : *materials->node.table()) {
        const CaseEntry* model = material.node.find("model");
        if (model == nullptr || model->node.text() == nullptr || *model->node.text() != plugin)
            diagnostics.error(material.place, "an example of " + plugin + " has model = \"" + plugin + "\"");
        const CaseEntry* range = ranges == nullptr ? nullptr : ranges->node.find(material.key);
        examples.push_back(
            {material.key, values_in(material.node, records, {"model", "grain_density", "porosity"}, diagnostics),
             range == nullptr ? kit::Range() : range_of(values_in(range->node, range_records(), {}, diagnostics))});
    }
    return examples;
}

} // namespace periporo::test
