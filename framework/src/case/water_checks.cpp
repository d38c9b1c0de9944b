// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "case/water_checks.hpp"

#include "case/plane.hpp"
#include "case/table_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace periporo {
namespace {

const CheckedTable* named(const std::vector<CheckedTable>& tables, const std::string& name)
{
    const auto found = std::ranges::find(tables, name, &CheckedTable::name);
    return found == tables.end() ? nullptr : &*found;
}

void check_water_table(const CheckedTable& root, const CheckedTable& water, Diagnostics& diagnostics)
{
    const auto* text = value_of<std::string>(water, "water_table");
    const auto* gravity = value_of<std::vector<double>>(root, "gravity");
    if (text == nullptr || gravity == nullptr)
        return;
    const PlaneDescription plane = parse_plane(*text);
    bool level = plane.axis != cylinder_axis;
    for (int c = 0; level && c < 3; ++c)
        level = ((*gravity)[static_cast<std::size_t>(c)] != 0.0) == (c == plane.axis);
    if (!level)
        diagnostics.error(water.place_of("water_table"), "a water table is a plane at right angles to gravity",
                          "water_table = \"z = -2 m\" where gravity is along z");
}

/// @param material of the body, null when it is not known
void check_saturation(const CheckedTable& water, const CheckedTable* material, Diagnostics& diagnostics)
{
    const auto* type = value_of<std::string>(water, "type");
    if (type == nullptr || *type == "dry" || material == nullptr)
        return;
    const auto* suction = value_of<double>(water, "suction");
    const auto* saturation = value_of<double>(water, "saturation");
    const bool sucks = *type != "uniform" || (suction != nullptr && *suction > 0.0);
    if (!material->all("retention").empty()) {
        if (saturation != nullptr)
            diagnostics.error(
                water.place_of("saturation"),
                fmt::format("the retention curve of material '{}' says what the saturation is", material->name),
                "leave 'saturation' out, or the curve");
    } else if (saturation == nullptr && !water.places.contains("saturation")) {
        diagnostics.error(water.place_of("type"),
                          fmt::format("material '{}' has no retention curve to tell the saturation", material->name),
                          fmt::format("add [material.{}.retention], or give 'saturation' here", material->name));
    } else if (sucks && saturation != nullptr && *saturation == 0.0) {
        diagnostics.error(water.place_of("saturation"),
                          "there is a suction but a degree of saturation of 0: without water there is no suction",
                          "give 'saturation' > 0, or type = \"dry\"");
    }
}

/// @param body whose water it is, null when it is not known
void check_one(const CheckedTable& root, const CheckedTable& water, const CheckedTable* body, Diagnostics& diagnostics)
{
    check_water_table(root, water, diagnostics);
    const auto* material = body == nullptr ? nullptr : value_of<std::string>(*body, "material");
    check_saturation(water, material == nullptr ? nullptr : named(root.all("material"), *material), diagnostics);
}

void check_changes(const CheckedTable& root, const CheckedTable& stage, Diagnostics& diagnostics)
{
    const auto* stage_type = value_of<std::string>(stage, "type");
    std::set<std::string> seen;
    for (const CheckedTable& water : stage.all("water")) {
        if (stage_type != nullptr && *stage_type == "quasi_static" && water.places.contains("over"))
            diagnostics.error(water.place_of("over"), "a quasi-static stage has no time: its water changes at once",
                              "leave 'over' out");
        const auto* name = value_of<std::string>(water, "body");
        if (name == nullptr)
            continue;
        if (!seen.insert(*name).second)
            diagnostics.error(water.place_of("body"),
                              fmt::format("the water of body '{}' changes twice in one stage", *name));
        check_one(root, water, named(root.all("body"), *name), diagnostics);
    }
}

} // namespace

void check_water(const CheckedTable& root, Diagnostics& diagnostics)
{
    for (const CheckedTable& body : root.all("body"))
        for (const CheckedTable& water : body.all("water"))
            check_one(root, water, &body, diagnostics);
    for (const CheckedTable& stage : root.all("stage"))
        check_changes(root, stage, diagnostics);
}

} // namespace periporo
