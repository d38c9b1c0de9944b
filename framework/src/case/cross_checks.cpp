// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks between the tables of a case.
#include "case/cross_checks.hpp"

#include "case/scene_checks.hpp"
#include "case/table_values.hpp"
#include "case/water_checks.hpp"
#include "plugins/fit_contact.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <set>

namespace periporo {
namespace {

void check_materials_of_bodies(const CheckedTable& root, Diagnostics& diagnostics)
{
    const std::vector<std::string> materials = names_of(root.all("material"));
    std::set<std::string> used;
    for (const CheckedTable& body : root.all("body")) {
        const auto* material = value_of<std::string>(body, "material");
        if (material == nullptr)
            continue;
        used.insert(*material);
        if (!contains(materials, *material))
            diagnostics.error(body.place_of("material"), fmt::format("there is no [material.{}]", *material),
                              naming_hint(*material, materials, "materials of the case"));
    }
    for (const CheckedTable& material : root.all("material"))
        if (!used.contains(material.name))
            diagnostics.warning(material.place, fmt::format("no body is made of material '{}'", material.name));
}

/// The residual of a dynamic stage is a part of the rule of rest.
void check_rest(const CheckedTable& stage, Diagnostics& diagnostics)
{
    const auto* type = value_of<std::string>(stage, "type");
    if (type == nullptr || *type != "dynamic" || stage.all("until").empty())
        return;
    const CheckedTable& until = stage.one("until");
    if (until.places.contains("residual") && !until.places.contains("rest_speed"))
        diagnostics.error(until.place_of("residual"), "a dynamic stage does not end by its residual alone",
                          "give 'rest_speed' too: a stage ends when motion has died away and forces balance");
}

void check_stages(const CheckedTable& root, Diagnostics& diagnostics)
{
    std::set<std::string> names;
    for (const CheckedTable& stage : root.all("stage")) {
        check_rest(stage, diagnostics);
        const auto* name = value_of<std::string>(stage, "name");
        if (name != nullptr && name->empty())
            diagnostics.error(stage.place_of("name"), "a stage needs a name that is not empty");
        else if (name != nullptr && !names.insert(*name).second)
            diagnostics.error(stage.place_of("name"), fmt::format("a stage '{}' came before", *name),
                              "names of stages must differ: results and overrides use them");
    }
}

void check_initial_stresses(const CheckedTable& root, Diagnostics& diagnostics)
{
    const auto* gravity = value_of<std::vector<double>>(root, "gravity");
    if (gravity == nullptr || std::any_of(gravity->begin(), gravity->end(), [](double g) { return g != 0.0; }))
        return;
    for (const CheckedTable& body : root.all("body"))
        for (const CheckedTable& stress : body.all("initial_stress"))
            if (const auto* type = value_of<std::string>(stress, "type"); type != nullptr && *type == "geostatic")
                diagnostics.error(stress.place_of("type"), "a geostatic initial stress needs gravity",
                                  "give 'gravity', or type = \"zero\"");
}

double duration_of(const CheckedTable& root)
{
    double duration = 0.0;
    for (const CheckedTable& stage : root.all("stage"))
        if (const auto* seconds = value_of<double>(stage, "duration"))
            duration += *seconds;
    return duration;
}

void check_outputs(const CheckedTable& root, Diagnostics& diagnostics)
{
    constexpr double most_snapshots = 1e6;
    const double duration = duration_of(root);
    std::set<std::string> writers;
    for (const CheckedTable& output : root.all("output")) {
        if (!output.places.contains("every") && !output.places.contains("times"))
            diagnostics.error(output.place, "an [[output]] needs 'every' or 'times'", "every = \"20 ms\"");
        const auto* every = value_of<double>(output, "every");
        if (every != nullptr && duration / *every > most_snapshots)
            diagnostics.error(output.place_of("every"),
                              fmt::format("{:.3g} snapshots in {:.4g} s, more than {:.0f}", duration / *every, duration,
                                          most_snapshots),
                              "make 'every' longer");
        const auto* writer = value_of<std::string>(output, "writer");
        if (writer != nullptr && !writers.insert(*writer).second)
            diagnostics.error(
                output.place_of("writer"),
                fmt::format("an [[output]] of writer '{}' came before, and both write the same files", *writer),
                "keep one of them; 'times' adds single snapshots to those of 'every'");
    }
}

void check_horizon(const CheckedTable& root, Diagnostics& diagnostics)
{
    for (const CheckedTable& discretization : root.all("discretization")) {
        const auto* horizon = value_of<double>(discretization, "horizon");
        if (horizon == nullptr)
            continue;
        // Squared distances on a cubic lattice are whole numbers.
        const double squared = *horizon * *horizon;
        if (std::abs(squared - std::round(squared)) < 1e-9)
            diagnostics.warning(
                discretization.place_of("horizon"),
                fmt::format("at horizon = {:g} neighbours of a cubic lattice lie exactly on the horizon "
                            "and come and go with round-off; 3.015 is safe",
                            *horizon));
    }
}

std::optional<std::string> refusal(const PluginRegistry& registry, PluginKind kind, const std::string& name,
                                   const Parameters& parameters)
{
    try {
        switch (kind) {
        case PluginKind::geometry:
            registry.make_geometry(name, parameters);
            break;
        case PluginKind::material:
            registry.make_material(name, parameters);
            break;
        case PluginKind::contact:
            registry.make_contact(name, parameters);
            break;
        case PluginKind::retention:
            registry.make_retention(name, parameters);
            break;
        case PluginKind::output:
            registry.make_output(name, parameters);
            break;
        }
    } catch (const std::exception& fault) {
        return fault.what();
    }
    return std::nullopt;
}

void try_plugins_of(const std::vector<CheckedTable>& tables, const TableRules& rules, const PluginRegistry& registry,
                    Diagnostics& diagnostics)
{
    for (const CheckedTable& table : tables) {
        if (rules.plugin) {
            // A copy: what the trial asks for does not count as consumed.
            const Parameters trial = table.plugin;
            const std::string& name = std::get<std::string>(table.own.values().at(rules.selector));
            if (const std::optional<std::string> reason = refusal(registry, *rules.plugin, name, trial))
                diagnostics.error(table.place, *reason,
                                  fmt::format("{} '{}' refuses its parameters", kind_name(*rules.plugin), name));
        }
        for (const NestedRules& nested : table.nested)
            try_plugins_of(table.all(nested.name), nested.rules, registry, diagnostics);
    }
}

/// The law, or null when its plugin refuses the parameters.
std::shared_ptr<Contact> made(const PluginRegistry& registry, const std::string& name, const Parameters& parameters)
{
    try {
        return registry.make_contact(name, parameters);
    } catch (const std::exception&) {
        return nullptr;
    }
}

/// Partners and keys that a law would not heed.
/// @param own_surface does the law bring one along?
void check_partners(const CheckedTable& contact, const std::string& law, bool own_surface,
                    const std::vector<std::string>& obstacles, Diagnostics& diagnostics)
{
    const auto& between = *value_of<std::vector<std::string>>(contact, "between");
    const auto is_obstacle = [&](const std::string& name) { return contains(obstacles, name); };
    const bool some_obstacle = std::ranges::any_of(between, is_obstacle);
    if (own_surface && !some_obstacle && between.size() == 2) {
        const bool one_body = between.front() == between.back();
        diagnostics.error(
            contact.place_of("between"),
            one_body ? fmt::format("law '{}' brings a surface of its own and does nothing between free grains of body "
                                   "'{}'",
                                   law, between.front())
                     : fmt::format("law '{}' brings a surface of its own: by it the bodies '{}' and '{}' do not touch "
                                   "each other",
                                   law, between.front(), between.back()),
            fmt::format("between = [\"{}\"] meets the surface; bodies and free grains meet by a law between points, "
                        "like \"short_range\"",
                        between.front()));
    }
    // A resolved case names the default too.
    if (*value_of<std::string>(contact, "crossing") == "warn" && !some_obstacle)
        diagnostics.error(contact.place_of("crossing"),
                          "'crossing' says what happens at an obstacle, and this contact has none",
                          "leave 'crossing' out");
}

/// What one contact does a second time counts twice: stiffness, friction and dashpot.
void check_repeated_contacts(const CheckedTable& root, Diagnostics& diagnostics)
{
    const auto pair_of = [](const CheckedTable& contact) {
        std::vector<std::string> pair = *value_of<std::vector<std::string>>(contact, "between");
        std::ranges::sort(pair);
        return pair;
    };
    const auto surface_of = [](const CheckedTable& contact) {
        const auto* surface = value_of<std::string>(contact, "surface");
        return surface == nullptr ? std::string() : *surface;
    };
    const std::vector<CheckedTable>& contacts = root.all("contact");
    for (auto contact = contacts.begin(); contact != contacts.end(); ++contact)
        for (auto before = contacts.begin(); before != contact; ++before) {
            const bool same_law = *value_of<std::string>(*before, "law") == *value_of<std::string>(*contact, "law");
            // One body may meet several surfaces of a law's own.
            const bool same_place = pair_of(*contact).size() == 2 ? surface_of(*before) == surface_of(*contact)
                                                                  : before->plugin.values() == contact->plugin.values();
            if (!same_law || !same_place || pair_of(*before) != pair_of(*contact))
                continue;
            diagnostics.error(contact->place_of("between"),
                              fmt::format("a [[contact]] of law '{}' between {} came before: its forces would count "
                                          "twice",
                                          *value_of<std::string>(*contact, "law"),
                                          fmt::join(pair_of(*contact), " and ")),
                              "keep one of them");
            break;
        }
}

} // namespace

void check_together(const CheckedTable& root, Diagnostics& diagnostics)
{
    check_materials_of_bodies(root, diagnostics);
    check_water(root, diagnostics);
    check_scene(root, diagnostics);
    check_stages(root, diagnostics);
    check_initial_stresses(root, diagnostics);
    check_outputs(root, diagnostics);
    check_horizon(root, diagnostics);
}

void try_plugins(const CheckedTable& root, const PluginRegistry& registry, Diagnostics& diagnostics)
{
    for (const NestedRules& nested : root.nested)
        try_plugins_of(root.all(nested.name), nested.rules, registry, diagnostics);
}

void try_contacts(const CheckedTable& root, const PluginRegistry& registry, Diagnostics& diagnostics)
{
    const CheckedTable& discretization = root.one("discretization");
    const double spacing = *value_of<double>(discretization, "spacing");
    const double horizon = *value_of<double>(discretization, "horizon") * spacing;
    const std::vector<std::string> obstacles = names_of(root.all("obstacle"));
    for (const CheckedTable& contact : root.all("contact")) {
        const auto& between = *value_of<std::vector<std::string>>(contact, "between");
        const bool surfaces =
            contact.places.contains("surface") ||
            std::ranges::any_of(between, [&](const std::string& name) { return contains(obstacles, name); });
        const Parameters trial = contact.plugin;
        const std::string& name = *value_of<std::string>(contact, "law");
        const std::shared_ptr<Contact> law = made(registry, name, trial);
        if (law == nullptr)
            continue;
        try {
            fit_contact(*law, spacing, horizon, surfaces);
        } catch (const std::exception& fault) {
            diagnostics.error(contact.place, fault.what(), fmt::format("contact '{}' cannot act here", name));
        }
        check_partners(contact, name, law->surface() != nullptr, obstacles, diagnostics);
    }
    check_repeated_contacts(root, diagnostics);
}

} // namespace periporo
