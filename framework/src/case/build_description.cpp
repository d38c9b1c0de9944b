// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Moves checked values to where they belong.
#include "case/build_description.hpp"

#include "case/plane.hpp"
#include "case/table_values.hpp"

#include <algorithm>
#include <fmt/format.h>

#include <optional>

namespace periporo {
namespace {

Vector3 vector_of(const std::vector<double>& list)
{
    return {list.at(0), list.at(1), list.at(2)};
}

/// From xx, yy, zz, xy, yz, xz.
Eigen::Matrix3d symmetric_matrix_of(const std::vector<double>& list)
{
    Eigen::Matrix3d matrix;
    matrix << list.at(0), list.at(3), list.at(5), list.at(3), list.at(1), list.at(4), list.at(5), list.at(4),
        list.at(2);
    return matrix;
}

DiscretizationDescription discretization_of(const CheckedTable& table)
{
    return {table.own.real("spacing"), table.own.real("horizon"), choice_of<RefreshRule>(table.own.text("refresh")),
            table.own.real("skin")};
}

MaterialDescription material_of(const CheckedTable& table)
{
    std::optional<PluginChoice> retention;
    for (const CheckedTable& curve : table.all("retention"))
        retention = plugin_choice(curve, "curve");
    return {table.name, plugin_choice(table, "model"), retention, table.own.real("grain_density"),
            table.own.real("porosity")};
}

WaterDescription water_of(const CheckedTable& table)
{
    WaterDescription water;
    water.kind = choice_of<WaterKind>(table.own.text("type"));
    if (water.kind == WaterKind::dry)
        return water;
    water.saturation = optional_real(table.own, "saturation");
    if (water.kind == WaterKind::uniform) {
        water.suction = table.own.real("suction");
    } else if (water.kind == WaterKind::hydrostatic) {
        water.water_table = parse_plane(table.own.text("water_table"));
        water.largest = optional_real(table.own, "largest_suction");
    } else {
        water.file = table.own.text("file");
    }
    return water;
}

InitialStressDescription initial_stress_of(const CheckedTable& table)
{
    InitialStressDescription stress;
    stress.kind = choice_of<InitialStressKind>(table.own.text("type"));
    if (stress.kind == InitialStressKind::geostatic) {
        stress.lateral_coefficient = table.own.real("K0");
        stress.overconsolidation_ratio = table.own.real("overconsolidation_ratio");
    }
    return stress;
}

FillDescription fill_of(const CheckedTable& table)
{
    FillDescription fill;
    fill.kind = choice_of<FillKind>(table.own.text("type"));
    fill.align = choice_of<LatticeAxes>(table.own.text("align"));
    if (fill.kind == FillKind::jittered)
        fill.amplitude = table.own.real("amplitude");
    if (fill.kind != FillKind::lattice)
        fill.seed = table.own.integer("seed");
    if (fill.kind == FillKind::relaxed)
        fill.iterations = table.own.integer("iterations");
    return fill;
}

BodyDescription body_of(const CheckedTable& table)
{
    BodyDescription body;
    body.name = table.name;
    body.geometry = plugin_choice(table.one("geometry"), "generator");
    body.material = table.own.text("material");
    body.water = water_of(table.one("water"));
    body.velocity = vector_of(table.own.real_list("velocity"));
    body.angular_velocity = vector_of(table.own.real_list("angular_velocity"));
    body.strain_rate = symmetric_matrix_of(table.own.real_list("strain_rate"));
    body.initial_stress = initial_stress_of(table.one("initial_stress"));
    body.fill = fill_of(table.one("fill"));
    return body;
}

std::string optional_text(const Parameters& values, const std::string& name)
{
    return values.has(name) ? values.text(name) : std::string();
}

bool makes_images(const CheckedTable& boundary)
{
    const std::vector<std::string> kinds = choice_names<ImageKind>();
    return std::ranges::find(kinds, boundary.own.text("type")) != kinds.end();
}

BoundaryDescription boundary_of(const CheckedTable& table)
{
    BoundaryDescription boundary;
    boundary.kind = choice_of<ImageKind>(table.own.text("type"));
    boundary.plane = parse_plane(table.own.text("plane"));
    if (boundary.kind == ImageKind::periodic)
        boundary.period = table.own.real("period");
    return boundary;
}

HeldRegionDescription held_region_of(const CheckedTable& table)
{
    HeldRegionDescription region;
    region.kind = choice_of<HeldKind>(table.own.text("type"));
    if (table.own.has("plane"))
        region.below = parse_plane(table.own.text("plane"));
    for (const std::string& plane : optional_texts(table.own, "layer"))
        region.layer.push_back(parse_plane(plane));
    region.within = optional_text(table.own, "within");
    region.body = optional_text(table.own, "body");
    region.stages = optional_texts(table.own, "stages");
    if (region.kind == HeldKind::roller)
        region.direction = vector_of(table.own.real_list("direction")).normalized();
    if (region.kind == HeldKind::moving)
        region.velocity = vector_of(table.own.real_list("velocity"));
    return region;
}

ObstacleDescription obstacle_of(const CheckedTable& table)
{
    ObstacleDescription obstacle;
    obstacle.name = table.name;
    obstacle.geometry = plugin_choice(table.one("geometry"), "generator");
    obstacle.velocity = vector_of(table.own.real_list("velocity"));
    if (table.own.has("moves_in"))
        obstacle.moves_in = table.own.text_list("moves_in");
    obstacle.stages = optional_texts(table.own, "stages");
    return obstacle;
}

/// Unbalanced force over gravity, on the mean over a window, of what is at rest. Columns of `cases/` that have come to
/// rest have less than 0.009, with a last grain still rolling, and 1e-5 and less after it; in the last window of their
/// motion 0.02 to 0.2.
constexpr double balance_at_rest = 0.01;

StageDescription stage_of(const CheckedTable& table)
{
    StageDescription stage;
    stage.name = table.own.text("name");
    stage.kind = choice_of<StageType>(table.own.text("type"));
    const Parameters& until = table.one("until").own;
    if (stage.kind == StageType::quasi_static) {
        for (const std::string& plane : optional_texts(table.own, "rollers"))
            stage.rollers.push_back(parse_plane(plane));
        stage.residual = until.real("residual");
        stage.damping = table.own.real("damping");
        stage.maximum_steps = table.own.integer("maximum_steps");
        stage.response = choice_of<MaterialResponse>(table.own.text("response"));
    } else {
        stage.duration = table.own.real("duration");
        stage.rest_speed = optional_real(until, "rest_speed");
        stage.residual = optional_real(until, "residual").value_or(balance_at_rest);
    }
    for (const CheckedTable& water : table.all("water"))
        stage.water_changes.push_back(
            {water.own.text("body"), water_of(water), optional_real(water.own, "over").value_or(stage.duration)});
    return stage;
}

OutputDescription output_of(const CheckedTable& table)
{
    OutputDescription output;
    output.writer = plugin_choice(table, "writer");
    output.every = optional_real(table.own, "every").value_or(0.0);
    if (table.own.has("times"))
        output.times = table.own.real_list("times");
    return output;
}

ComparisonDescription comparison_of(const CheckedTable& table)
{
    return {table.own.text("law"), table.own.real("radius"), table.own.real("height")};
}

} // namespace

CaseDescription build_description(const CheckedTable& root)
{
    CaseDescription description;
    description.title = root.own.text("title");
    description.gravity = vector_of(root.own.real_list("gravity"));
    description.discretization = discretization_of(root.one("discretization"));
    const Parameters& operators = root.one("operator").own;
    description.operators = {operators.text("force_state"), operators.text("influence")};
    const Parameters& time = root.one("time").own;
    description.time = {time.real("safety"), optional_real(time, "step")};
    for (const CheckedTable& table : root.all("material"))
        description.materials.push_back(material_of(table));
    for (const CheckedTable& table : root.all("body"))
        description.bodies.push_back(body_of(table));
    for (const CheckedTable& table : root.all("geometry"))
        description.geometries.push_back({table.name, plugin_choice(table, "generator")});
    for (const CheckedTable& table : root.all("obstacle"))
        description.obstacles.push_back(obstacle_of(table));
    for (std::size_t b = 0; b < root.all("boundary").size(); ++b) {
        const CheckedTable& table = root.all("boundary")[b];
        const std::string key = fmt::format("boundary.{}", b);
        if (makes_images(table)) {
            description.boundaries.push_back(boundary_of(table));
            description.boundaries.back().key = key;
        } else {
            description.held_regions.push_back(held_region_of(table));
            description.held_regions.back().key = key;
        }
    }
    for (const CheckedTable& table : root.all("contact"))
        description.contacts.push_back({plugin_choice(table, "law"), table.own.text_list("between"),
                                        optional_text(table.own, "surface"), table.own.text("crossing") == "stop"});
    for (const CheckedTable& table : root.all("stage"))
        description.stages.push_back(stage_of(table));
    for (const CheckedTable& table : root.all("output"))
        description.outputs.push_back(output_of(table));
    for (const CheckedTable& table : root.all("comparison"))
        description.comparison = comparison_of(table);
    const Parameters& run = root.one("run").own;
    description.checkpoint_every = run.real("checkpoint_every");
    description.history_every = run.real("history_every");
    description.energy_error_limit = run.real("energy_error_limit");
    for (const std::string& path : optional_texts(root.one("plugins").own, "paths"))
        description.plugin_paths.emplace_back(path);
    return description;
}

} // namespace periporo
