// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Moves checked values to where they belong.
#include "drive/build_path.hpp"

#include "case/table_values.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {
namespace {

SymmetricTensor<double> initial_stress_of(const Parameters& initial)
{
    if (const std::optional<double> pressure = optional_real(initial, "pressure"))
        return SymmetricTensor<double>::isotropic(-*pressure);
    const std::vector<double>& c = initial.real_list("stress");
    return {c[0], c[1], c[2], c[3], c[4], c[5]};
}

StageTarget target_of(const Parameters& stage, const std::string& stress, const std::string& strain)
{
    if (const std::optional<double> value = optional_real(stage, stress))
        return {*value, true};
    return {stage.real(strain), false};
}

SimpleShearStage simple_shear_of(const Parameters& stage)
{
    return {target_of(stage, "shear_stress", "shear_strain"), stage.text("vertical") == "constant_height"};
}

TrueTriaxialStage true_triaxial_of(const Parameters& stage)
{
    TrueTriaxialStage kind;
    kind.stress_controlled = stage.has("pressures");
    const std::vector<double>& targets = stage.real_list(kind.stress_controlled ? "pressures" : "compressions");
    std::copy(targets.begin(), targets.end(), kind.targets.begin());
    return kind;
}

MixedStage mixed_of(const CheckedTable& stage)
{
    MixedStage kind;
    kind.suction = optional_real(stage.own, "suction");
    kind.saturation = optional_real(stage.own, "saturation");
    kind.simple_shear = stage.own.text("motion") == "simple_shear";
    const std::vector<std::string> held = optional_texts(stage.own, "held_stress");
    for (std::size_t c = 0; c < 6; ++c) {
        const std::string name = symmetric_component_names[c];
        kind.stress[c] = optional_real(stage.one("stress").own, name);
        kind.strain[c] = optional_real(stage.one("strain").own, name).value_or(0.0);
        kind.stress_held[c] = contains(held, name);
    }
    return kind;
}

StageKind kind_of(const CheckedTable& table, const std::string& type)
{
    const Parameters& stage = table.own;
    if (type == "isotropic")
        return IsotropicStage{target_of(stage, "pressure", "volumetric_compression")};
    if (type == "oedometric")
        return OedometricStage{target_of(stage, "axial_pressure", "axial_compression")};
    if (type == "triaxial_drained")
        return DrainedTriaxialStage{target_of(stage, "deviator_stress", "axial_compression")};
    if (type == "triaxial_undrained")
        return UndrainedTriaxialStage{stage.real("axial_compression")};
    if (type == "simple_shear")
        return simple_shear_of(stage);
    if (type == "true_triaxial")
        return true_triaxial_of(stage);
    if (type == "suction")
        return SuctionStage{optional_real(stage, "suction"), optional_real(stage, "saturation"),
                            stage.text("held") == "total_stress"};
    return mixed_of(table);
}

/// Magnitude of the strain that a `strain_rate` is about.
double leading_strain(const StageKind& kind)
{
    const auto magnitude = [](const auto& stage) -> double {
        if constexpr (requires { stage.target; })
            return std::abs(stage.target.value);
        else if constexpr (requires { stage.axial_compression; })
            return std::abs(stage.axial_compression);
        else
            return 0.0; // the rules give no rate to the others
    };
    return std::visit(magnitude, kind);
}

PathStage stage_of(const CheckedTable& table)
{
    PathStage stage;
    const Parameters& values = table.own;
    if (values.has("name"))
        stage.name = values.text("name");
    stage.type = values.text("type");
    stage.kind = kind_of(table, stage.type);
    stage.steps = values.integer("steps");
    stage.cycles = values.integer("cycles");
    stage.two_way = values.boolean("two_way");
    stage.halvings = values.integer("halvings");
    stage.duration =
        values.has("duration") ? values.real("duration") : leading_strain(stage.kind) / values.real("strain_rate");
    return stage;
}

} // namespace

PathDescription build_path(const CheckedTable& root)
{
    PathDescription path;
    path.title = root.own.text("title");
    const CheckedTable& material = root.one("material");
    path.material_name = material.name;
    path.model = plugin_choice(material, "model");
    for (const CheckedTable& curve : material.all("retention"))
        path.retention = plugin_choice(curve, "curve");
    path.grain_density = optional_real(material.own, "grain_density");
    path.porosity = optional_real(material.own, "porosity");
    const CheckedTable& initial = root.one("initial");
    path.stress = initial_stress_of(initial.own);
    path.overconsolidation_ratio = initial.own.real("overconsolidation_ratio");
    path.suction = optional_real(initial.own, "suction");
    path.saturation = optional_real(initial.own, "saturation");
    const CheckedTable& state = initial.one("state");
    for (const Parameter& record : state.records)
        if (state.own.has(record.name))
            path.state[record.name] = state.own.real(record.name);
    for (const std::string& folder : optional_texts(root.one("plugins").own, "paths"))
        path.plugin_paths.emplace_back(folder);
    for (const CheckedTable& stage : root.all("stage"))
        path.stages.push_back(stage_of(stage));
    return path;
}

} // namespace periporo
