// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks between the keys of a path. Values that were wrong themselves are absent here and are passed over.
#include "drive/path_checks.hpp"

#include "case/table_values.hpp"
#include "periporo/tensor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace periporo {
namespace {

bool gives(const CheckedTable& table, const std::string& key)
{
    return table.places.contains(key);
}

/// Demands one of these keys of a table that knows them, and not more.
void check_only_one(const CheckedTable& table, const std::vector<std::string>& keys, Diagnostics& diagnostics)
{
    std::vector<std::string> given;
    std::copy_if(keys.begin(), keys.end(), std::back_inserter(given),
                 [&](const std::string& key) { return gives(table, key); });
    if (given.empty())
        diagnostics.error(table.place, fmt::format("{} needs '{}'", table.label, fmt::join(keys, "' or '")));
    for (std::size_t i = 1; i < given.size(); ++i)
        diagnostics.error(table.place_of(given[i]), fmt::format("'{}' is given beside '{}'", given[i], given.front()),
                          "give one of the two");
}

void check_rate(const CheckedTable& stage, const std::string& stress_target, const std::string& strain_target,
                Diagnostics& diagnostics)
{
    check_only_one(stage, {"duration", "strain_rate"}, diagnostics);
    if (!gives(stage, "strain_rate"))
        return;
    if (gives(stage, stress_target))
        diagnostics.error(stage.place_of("strain_rate"),
                          fmt::format("'strain_rate' needs a strain as the target, not '{}'", stress_target),
                          "give 'duration'");
    if (const auto* strain = value_of<double>(stage, strain_target); strain != nullptr && *strain == 0.0)
        diagnostics.error(stage.place_of("strain_rate"),
                          fmt::format("with '{}' = 0 a rate gives no duration", strain_target), "give 'duration'");
}

void check_target(const CheckedTable& stage, const std::string& type, bool curve, Diagnostics& diagnostics)
{
    struct Targets {
        const char* type;
        const char* stress; // or empty
        const char* strain;
    };
    static constexpr Targets all[] = {{"isotropic", "pressure", "volumetric_compression"},
                                      {"oedometric", "axial_pressure", "axial_compression"},
                                      {"triaxial_drained", "deviator_stress", "axial_compression"},
                                      {"triaxial_undrained", "", "axial_compression"},
                                      {"simple_shear", "shear_stress", "shear_strain"}};
    for (const Targets& targets : all)
        if (type == targets.type) {
            if (*targets.stress != '\0')
                check_only_one(stage, {targets.strain, targets.stress}, diagnostics);
            check_rate(stage, targets.stress, targets.strain, diagnostics);
        }
    if (type == "true_triaxial")
        check_only_one(stage, {"pressures", "compressions"}, diagnostics);
    if (type == "suction" && !gives(stage, "suction") && (curve || !gives(stage, "saturation")))
        diagnostics.error(stage.place,
                          fmt::format("{} needs 'suction'{}", stage.label, curve ? "" : ", 'saturation' or both"));
}

void check_cycles(const CheckedTable& stage, Diagnostics& diagnostics)
{
    const auto* two_way = value_of<bool>(stage, "two_way");
    const auto* cycles = value_of<std::int64_t>(stage, "cycles");
    if (two_way == nullptr || !*two_way)
        return;
    if (cycles != nullptr && *cycles == 0)
        diagnostics.error(stage.place_of("two_way"), "'two_way' is for cycles, and there are none",
                          "give 'cycles' of 1 or more");
    if (gives(stage, "suction") || gives(stage, "saturation"))
        diagnostics.error(stage.place_of("two_way"), "water cannot swing to the opposite side of where it was",
                          "leave 'two_way' out");
}

/// Every component is controlled once.
void check_components(const CheckedTable& stage, Diagnostics& diagnostics)
{
    if (stage.all("stress").empty() || stage.all("strain").empty())
        return;
    const auto* held = value_of<std::vector<std::string>>(stage, "held_stress");
    for (const std::string component : symmetric_component_names) {
        const bool stress = gives(stage.one("stress"), component);
        const bool strain = gives(stage.one("strain"), component);
        if (stress && strain)
            diagnostics.error(stage.one("strain").place_of(component),
                              fmt::format("the component {} has a stress and a strain", component),
                              "one follows from the other: give one of them");
        const auto count = held == nullptr ? 0 : std::count(held->begin(), held->end(), component);
        if (count > 0 && (stress || strain || count > 1))
            diagnostics.error(stage.place_of("held_stress"),
                              fmt::format("the component {} is held and has {} too", component,
                                          stress   ? "a stress"
                                          : strain ? "a strain"
                                                   : "been named before"),
                              "name a component once");
    }
}

/// Every increment is a row of path.csv, and all are kept until the end.
void check_increments(const CheckedTable& root, Diagnostics& diagnostics)
{
    constexpr double most_increments = 1e7; // some gigabytes
    double increments = 0.0;
    for (const CheckedTable& stage : root.all("stage")) {
        const auto* steps = value_of<std::int64_t>(stage, "steps");
        const auto* cycles = value_of<std::int64_t>(stage, "cycles");
        const auto* two_way = value_of<bool>(stage, "two_way");
        if (steps == nullptr || cycles == nullptr || two_way == nullptr)
            continue;
        const double ways = std::max(1.0, (*two_way ? 4.0 : 2.0) * static_cast<double>(*cycles));
        increments += ways * static_cast<double>(*steps);
        if (increments > most_increments)
            return diagnostics.error(stage.place_of("steps"),
                                     fmt::format("up to this stage there are {:.3g} increments, more than {:.3g}",
                                                 increments, most_increments),
                                     "give fewer 'steps' or 'cycles'");
    }
}

/// Suction and saturation as they are after a table that may set them.
struct Water {
    bool curve = false; ///< does one say what the saturation is?
    double suction = 0.0;
    double saturation = 0.0;

    void follow(const CheckedTable& table, Diagnostics& diagnostics)
    {
        if (curve) {
            if (gives(table, "saturation"))
                diagnostics.error(table.place_of("saturation"),
                                  "the retention curve of the material says what the saturation is",
                                  "leave out one of the two");
            return;
        }
        bool changed = false;
        for (auto [key, value] : {std::pair("suction", &suction), std::pair("saturation", &saturation)})
            if (const auto* given = value_of<double>(table, key)) {
                *value = *given;
                changed = changed || gives(table, key);
            }
        if (changed && suction > 0.0 && saturation == 0.0)
            diagnostics.error(gives(table, "suction") ? table.place_of("suction") : table.place_of("saturation"),
                              "there is a suction but a degree of saturation of 0: without water there is no suction",
                              "give 'saturation' > 0, or no suction for a dry soil");
    }
};

} // namespace

void check_path(const CheckedTable& root, Diagnostics& diagnostics)
{
    for (std::size_t i = 1; i < root.all("material").size(); ++i)
        diagnostics.error(root.all("material")[i].place, "a path is of one material, and this is another",
                          "keep one [material.NAME]");
    check_increments(root, diagnostics);
    Water water;
    for (const CheckedTable& material : root.all("material"))
        for (const CheckedTable& curve : material.all("retention")) {
            water.curve = true;
            if (!gives(material, "porosity"))
                diagnostics.error(curve.place, fmt::format("{} needs the porosity of the soil", curve.label),
                                  fmt::format("give 'porosity' in {}", material.label));
        }
    for (const CheckedTable& initial : root.all("initial")) {
        check_only_one(initial, {"pressure", "stress"}, diagnostics);
        water.follow(initial, diagnostics);
    }
    for (const CheckedTable& stage : root.all("stage")) {
        if (const auto* type = value_of<std::string>(stage, "type"))
            check_target(stage, *type, water.curve, diagnostics);
        check_cycles(stage, diagnostics);
        check_components(stage, diagnostics);
        const Water before = water;
        water.follow(stage, diagnostics);
        if (const auto* cycles = value_of<std::int64_t>(stage, "cycles"); cycles != nullptr && *cycles > 0)
            water = before; // back to where it was
    }
}

} // namespace periporo
