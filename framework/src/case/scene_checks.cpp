// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "case/scene_checks.hpp"

#include "case/plane.hpp"
#include "case/table_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>

namespace periporo {
namespace {

using Texts = std::vector<std::string>;

/// How messages call a thing.
struct Word {
    const char* one;
    const char* many;
};
constexpr Word body_word{"body", "bodies"};
constexpr Word geometry_word{"geometry", "geometries"};
constexpr Word stage_word{"stage", "stages"};

/// Whatever a table may name.
struct Names {
    Texts bodies, obstacles, geometries, stages;

    explicit Names(const CheckedTable& root)
        : bodies(names_of(root.all("body"))), obstacles(names_of(root.all("obstacle"))),
          geometries(names_of(root.all("geometry")))
    {
        for (const CheckedTable& stage : root.all("stage"))
            if (const auto* name = value_of<std::string>(stage, "name"))
                stages.push_back(*name);
    }
};

void check_names_in_list(const CheckedTable& table, const std::string& key, const Texts& known, const Word& word,
                         Diagnostics& diagnostics)
{
    const auto* list = value_of<Texts>(table, key);
    if (list == nullptr)
        return;
    if (list->empty())
        diagnostics.error(table.place_of(key), fmt::format("'{}' names no {}", key, word.one),
                          fmt::format("leave '{}' out for all {}, or name some", key, word.many));
    for (std::size_t i = 0; i < list->size(); ++i)
        if (!contains(known, (*list)[i]))
            diagnostics.error(table.members.at(key)[i], fmt::format("there is no {} '{}'", word.one, (*list)[i]),
                              naming_hint((*list)[i], known, fmt::format("{} of the case", word.many)));
}

void check_name(const CheckedTable& table, const std::string& key, const Texts& known, const Word& word,
                Diagnostics& diagnostics)
{
    const auto* name = value_of<std::string>(table, key);
    if (name != nullptr && !contains(known, *name))
        diagnostics.error(table.place_of(key), fmt::format("there is no {} '{}'", word.one, *name),
                          naming_hint(*name, known, fmt::format("{} of the case", word.many)));
}

/// Is an obstacle named by a contact?
bool is_touched(const CheckedTable& root, const std::string& obstacle)
{
    return std::ranges::any_of(root.all("contact"), [&](const CheckedTable& contact) {
        const auto* between = value_of<Texts>(contact, "between");
        return between == nullptr || contains(*between, obstacle);
    });
}

void check_obstacles(const CheckedTable& root, const Names& names, Diagnostics& diagnostics)
{
    for (const CheckedTable& obstacle : root.all("obstacle")) {
        check_names_in_list(obstacle, "moves_in", names.stages, stage_word, diagnostics);
        check_names_in_list(obstacle, "stages", names.stages, stage_word, diagnostics);
        if (!is_touched(root, obstacle.name))
            diagnostics.warning(obstacle.place,
                                fmt::format("no contact names obstacle '{}': bodies pass through it", obstacle.name));
        if (contains(names.bodies, obstacle.name))
            diagnostics.error(obstacle.place, fmt::format("a body has the name '{}' too", obstacle.name),
                              "contacts name bodies and obstacles: their names must differ");
    }
}

void check_between(const CheckedTable& contact, const Names& names, Diagnostics& diagnostics)
{
    const auto* between = value_of<Texts>(contact, "between");
    if (between == nullptr)
        return;
    if (between->empty() || between->size() > 2)
        diagnostics.error(contact.place_of("between"),
                          fmt::format("'between' must name one or two things, not {}", between->size()),
                          "one body meets the surface of the law; two bodies, or a body and an obstacle, meet each "
                          "other; one body twice lets its free grains meet");
    Texts known = names.bodies;
    known.insert(known.end(), names.obstacles.begin(), names.obstacles.end());
    for (std::size_t i = 0; i < between->size(); ++i)
        if (!contains(known, (*between)[i]))
            diagnostics.error(contact.members.at("between")[i],
                              fmt::format("there is no [body.{0}] or [obstacle.{0}]", (*between)[i]),
                              naming_hint((*between)[i], known, "bodies and obstacles of the case"));
    const bool some_body = std::any_of(between->begin(), between->end(),
                                       [&](const auto& name) { return !contains(names.obstacles, name); });
    if (!between->empty() && !some_body)
        diagnostics.error(contact.place_of("between"), "obstacles do not feel each other: 'between' needs a body",
                          naming_hint({}, names.bodies, "bodies of the case"));
    const auto* surface = value_of<std::string>(contact, "surface");
    if (surface == nullptr)
        return;
    const bool two_bodies = between->size() == 2 && between->front() != between->back() &&
                            contains(names.bodies, between->front()) && contains(names.bodies, between->back());
    if (!two_bodies || !contains(*between, *surface))
        diagnostics.error(contact.place_of("surface"),
                          fmt::format("'surface' must be one of the two bodies in 'between', not '{}'", *surface),
                          "between = [\"column\", \"substrate\"], surface = \"substrate\"");
}

void check_layer(const CheckedTable& region, Diagnostics& diagnostics)
{
    const auto* layer = value_of<Texts>(region, "layer");
    if (layer == nullptr || layer->size() != 2)
        return;
    const PlaneDescription lower = parse_plane(layer->front());
    const PlaneDescription upper = parse_plane(layer->back());
    if (lower.axis != upper.axis || lower.axis == cylinder_axis || !(lower.offset < upper.offset))
        diagnostics.error(region.place_of("layer"), "a layer lies between two planes of one axis, the lower one first",
                          "layer = [\"z = 0 mm\", \"z = 20 mm\"]");
}

void check_regions(const CheckedTable& root, const Names& names, Diagnostics& diagnostics)
{
    for (const CheckedTable& region : root.all("boundary")) {
        const auto* type = value_of<std::string>(region, "type");
        if (type == nullptr || *type == "symmetry" || *type == "periodic")
            continue;
        check_name(region, "within", names.geometries, geometry_word, diagnostics);
        check_name(region, "body", names.bodies, body_word, diagnostics);
        check_names_in_list(region, "stages", names.stages, stage_word, diagnostics);
        check_layer(region, diagnostics);
        const Texts keys{"plane", "layer", "within", "body"};
        if (std::none_of(keys.begin(), keys.end(), [&](const auto& key) { return region.places.contains(key); }))
            diagnostics.error(region.place, fmt::format("a boundary of type \"{}\" does not say which points", *type),
                              fmt::format("give one or more of {}", fmt::join(keys, ", ")));
        const auto* direction = value_of<std::vector<double>>(region, "direction");
        if (direction != nullptr &&
            std::all_of(direction->begin(), direction->end(), [](double c) { return c == 0.0; }))
            diagnostics.error(region.place_of("direction"), "'direction' must not be zero");
    }
}

/// The names that the geometry of a table is made of, with the key that has them.
std::vector<std::pair<std::string, Texts>> operands_of(const CheckedTable& table)
{
    std::vector<std::pair<std::string, Texts>> operands;
    for (const Parameter& record : table.plugin_records)
        if (record.naming == Naming::geometry)
            if (const auto* names = value_of<Texts>(table.plugin, record.name))
                operands.emplace_back(record.name, *names);
    return operands;
}

void check_operands(const CheckedTable& table, const Names& names, Diagnostics& diagnostics)
{
    for (const auto& [key, operands] : operands_of(table))
        for (std::size_t i = 0; i < operands.size(); ++i)
            if (!contains(names.geometries, operands[i]))
                diagnostics.error(table.members.at(key)[i], fmt::format("there is no [geometry.{}]", operands[i]),
                                  naming_hint(operands[i], names.geometries, "geometries of the case"));
}

/// No geometry may be made of itself.
void check_cycles(const CheckedTable& root, Diagnostics& diagnostics)
{
    std::map<std::string, Texts> made_of;
    for (const CheckedTable& table : root.all("geometry"))
        for (const auto& [key, operands] : operands_of(table))
            made_of[table.name].insert(made_of[table.name].end(), operands.begin(), operands.end());
    for (const CheckedTable& table : root.all("geometry")) {
        std::set<std::string> reached;
        Texts open = made_of[table.name];
        while (!open.empty()) {
            const std::string name = open.back();
            open.pop_back();
            if (reached.insert(name).second)
                open.insert(open.end(), made_of[name].begin(), made_of[name].end());
        }
        if (reached.contains(table.name))
            diagnostics.error(table.place, fmt::format("[geometry.{}] is made of itself", table.name),
                              "the geometries that it names lead back to it");
    }
}

void check_geometries(const CheckedTable& root, const Names& names, Diagnostics& diagnostics)
{
    for (const CheckedTable& table : root.all("geometry"))
        check_operands(table, names, diagnostics);
    for (const char* owner : {"body", "obstacle"})
        for (const CheckedTable& table : root.all(owner))
            for (const CheckedTable& geometry : table.all("geometry"))
                check_operands(geometry, names, diagnostics);
    check_cycles(root, diagnostics);
}

} // namespace

void check_scene(const CheckedTable& root, Diagnostics& diagnostics)
{
    const Names names(root);
    check_geometries(root, names, diagnostics);
    check_obstacles(root, names, diagnostics);
    for (const CheckedTable& contact : root.all("contact"))
        check_between(contact, names, diagnostics);
    check_regions(root, names, diagnostics);
    for (const CheckedTable& stage : root.all("stage"))
        for (const CheckedTable& water : stage.all("water"))
            check_name(water, "body", names.bodies, body_word, diagnostics);
}

} // namespace periporo
