// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/build_model.hpp"

#include "assembly/body_fill.hpp"
#include "assembly/geometries.hpp"
#include "assembly/held_points.hpp"
#include "case/refusal.hpp"
#include "contact/assignment.hpp"
#include "operator/bond_update.hpp"
#include "operator/refresh.hpp"
#include "plugins/fit_contact.hpp"
#include "water/overburden.hpp"
#include "water/pore_stress.hpp"
#include "water/pressure_field.hpp"
#include "water/standing_water.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace periporo {
namespace {

/// True when the boundaries leave the position in the model.
bool kept(const CaseDescription& description, const Vector3& x)
{
    return std::all_of(description.boundaries.begin(), description.boundaries.end(), [&](const auto& boundary) {
        const double beyond = x[boundary.plane.axis] - boundary.plane.offset;
        return beyond >= 0.0 && (boundary.kind != ImageKind::periodic || beyond < boundary.period);
    });
}

/// Position along a Z-order curve through cells of one spacing.
std::uint64_t curve_position(const Vector3& x, const Vector3& lower, double spacing)
{
    std::uint64_t code = 0;
    for (int c = 0; c < 3; ++c) {
        const auto cell = static_cast<std::uint64_t>(std::max(0.0, (x[c] - lower[c]) / spacing));
        for (int bit = 0; bit < 21; ++bit)
            code |= (cell >> bit & 1u) << (3 * bit + c);
    }
    return code;
}

/// The points of a body, and what a user should know of them.
PointCloud fill_with_points(BuiltModel& built, const CaseDescription& description, std::size_t index,
                            Geometries& geometries, const BuildProgress& progress)
{
    const BodyDescription& body = description.bodies[index];
    PointCloud cloud;
    double volume = 0.0;
    try {
        const std::shared_ptr<const Geometry> geometry = geometries.of_body(index);
        cloud = fill_body(*geometry, description.discretization.spacing, body.fill, [&](double fraction) {
            if (progress)
                progress(body.name, fraction);
        });
        volume = geometry->volume();
        for (const std::string& remark : geometry->remarks())
            built.remarks.push_back(fmt::format("body '{}': {}", body.name, remark));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw refusal(description, "body." + body.name + ".geometry",
                      fmt::format("body '{}': {}", body.name, error.what()));
    }
    const double filled = std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0);
    const double difference = filled / volume - 1.0;
    if (std::abs(difference) > 1e-9)
        built.remarks.push_back(fmt::format("body '{}': its points have {:.2f} per cent {} mass than its exact volume "
                                            "would",
                                            body.name, 100.0 * std::abs(difference),
                                            difference > 0.0 ? "more" : "less"));
    return cloud;
}

void add_body(BuiltModel& built, const CaseDescription& description, std::size_t index, const PluginRegistry& registry,
              Geometries& geometries, const BuildProgress& progress)
{
    const BodyDescription& body = description.bodies[index];
    const PointCloud cloud = fill_with_points(built, description, index, geometries, progress);
    const double filled = std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0);
    Points& points = built.model.state.points;
    const MaterialDescription& material = material_of(description, body);
    Vector3 centre = Vector3::Zero();
    for (std::size_t p = 0; p < cloud.positions.size(); ++p)
        centre += cloud.volumes[p] / filled * cloud.positions[p];
    std::vector<Vector3> cut;
    for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
        if (!kept(description, cloud.positions[p])) {
            cut.push_back(cloud.positions[p]);
            continue;
        }
        const std::size_t i = points.size();
        points.resize(i + 1);
        points.position[i] = points.initial_position[i] = cloud.positions[p];
        const Vector3 from_centre = cloud.positions[p] - centre;
        points.velocity[i] = body.velocity + body.angular_velocity.cross(from_centre) + body.strain_rate * from_centre;
        points.volume[i] = points.initial_volume[i] = cloud.volumes[p];
        points.body[i] = static_cast<std::uint32_t>(index);
        points.id[i] = static_cast<std::int64_t>(p);
    }
    if (cut.size() == cloud.positions.size())
        throw refusal(description, "body." + body.name + ".geometry",
                      fmt::format("body '{}': no point lies on the kept side of the symmetry planes and periodic pairs "
                                  "(the side of larger coordinates)",
                                  body.name));
    if (!cut.empty())
        built.remarks.push_back(fmt::format("body '{}': {} of {} points lie behind symmetry planes and are represented "
                                            "by images",
                                            body.name, cut.size(), cloud.positions.size()));
    built.cut_away.push_back(std::move(cut));
    built.model.state.bodies.push_back({body.name, make_material(description, body, registry),
                                        body.initial_stress.overconsolidation_ratio, material.porosity});
}

void add_obstacles(BuiltModel& built, const CaseDescription& description, Geometries& geometries, Refusals& refusals)
{
    for (const ObstacleDescription& obstacle : description.obstacles)
        refusals.attempt("obstacle." + obstacle.name + ".geometry", [&] {
            std::shared_ptr<const Geometry> geometry;
            try {
                geometry = geometries.make(obstacle.geometry);
            } catch (const std::bad_alloc&) {
                throw;
            } catch (const std::exception& error) {
                throw std::runtime_error(fmt::format("obstacle '{}': {}", obstacle.name, error.what()));
            }
            if (!geometry->has_distance())
                throw std::runtime_error(fmt::format("obstacle '{}': geometry '{}' cannot tell the distance from its "
                                                     "surface, which an obstacle needs",
                                                     obstacle.name, obstacle.geometry.name));
            for (const std::string& remark : geometry->remarks())
                built.remarks.push_back(fmt::format("obstacle '{}': {}", obstacle.name, remark));
            built.model.state.obstacles.push_back({obstacle.name, geometry});
        });
}

template <class Named>
std::optional<std::uint32_t> number_of(const std::vector<Named>& things, const std::string& name)
{
    for (std::uint32_t n = 0; n < things.size(); ++n)
        if (things[n].name == name)
            return n;
    return std::nullopt;
}

ContactAssignment assignment_of(const Model& model, const CaseDescription& description, std::size_t index,
                                const PluginRegistry& registry)
{
    const ContactDescription& contact = description.contacts[index];
    const std::shared_ptr<Contact> law = registry.make_contact(contact.law.name, contact.law.parameters);
    ContactAssignment assignment{law, {}, {}, {}};
    for (const std::string& name : contact.between) {
        if (const auto body = number_of(model.state.bodies, name))
            assignment.bodies.push_back(*body);
        else
            assignment.obstacle = number_of(model.state.obstacles, name);
    }
    if (!contact.surface.empty())
        assignment.surface_body = number_of(model.state.bodies, contact.surface);
    if (!at_rigid_surface(assignment) && assignment.bodies.size() == 1)
        throw refusal(description, fmt::format("contact.{}.between", index),
                      fmt::format("law '{}' has no surface of its own, and 'between' names one body", contact.law.name),
                      "name a second body or an obstacle, or the body twice for its free grains");
    fit_contact(*law, model.state.spacing, model.state.horizon, assignment.obstacle || assignment.surface_body);
    return assignment;
}

void order_along_curve(Points& points, double spacing)
{
    Vector3 lower = points.position.front();
    for (const Vector3& x : points.position)
        lower = lower.cwiseMin(x);
    std::vector<std::uint64_t> code(points.size());
    std::transform(points.position.begin(), points.position.end(), code.begin(),
                   [&](const Vector3& x) { return curve_position(x, lower, spacing); });
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return code[a] < code[b]; });
    const auto apply = [&](auto& values) {
        auto sorted = values;
        for (std::size_t i = 0; i < order.size(); ++i)
            sorted[i] = values[order[i]];
        values = std::move(sorted);
    };
    apply(points.position);
    apply(points.velocity);
    apply(points.initial_position);
    apply(points.volume);
    apply(points.initial_volume);
    apply(points.jacobian);
    apply(points.pore_pressure);
    apply(points.saturation);
    apply(points.body);
    apply(points.id);
}

/// Reads the water of every body and of every change, that of late stages too.
void check_water_fields(const CaseDescription& description, Refusals& refusals)
{
    const auto check = [&](const std::string& key, const std::string& body, const WaterDescription& water) {
        refusals.attempt(key, [&] {
            try {
                make_pressure_field(water, description.gravity);
            } catch (const std::exception& error) {
                throw std::runtime_error(fmt::format("water of body '{}': {}", body, error.what()));
            }
        });
    };
    for (const BodyDescription& body : description.bodies)
        check("body." + body.name + ".water.file", body.name, body.water);
    for (std::size_t s = 0; s < description.stages.size(); ++s)
        for (std::size_t w = 0; w < description.stages[s].water_changes.size(); ++w) {
            const WaterChangeDescription& change = description.stages[s].water_changes[w];
            check(fmt::format("stage.{}.water.{}.file", s, w), change.body, change.water);
        }
}

/// Says which bodies reach below the water table of another one and are out of the water themselves.
void remark_on_water_tables(BuiltModel& built)
{
    const Model& model = built.model;
    const auto wet = std::ranges::max_element(model.state.bodies, {}, &Body::water_level);
    if (!wet->has_standing_water())
        return;
    const StandingWater standing(model);
    std::vector<std::uint8_t> reaches(model.state.bodies.size(), 0);
    for (std::size_t i = 0; i < model.size(); ++i)
        if (!model.body_of(i).has_standing_water() &&
            model.state.points.position[i].dot(standing.up()) < wet->water_level)
            reaches[model.state.points.body[i]] = 1;
    for (std::size_t b = 0; b < reaches.size(); ++b)
        if (reaches[b] != 0)
            built.remarks.push_back(fmt::format("body '{}' reaches below the water table of body '{}', but no water "
                                                "stands around it: each body names its own water_table",
                                                model.state.bodies[b].name, wet->name));
}

} // namespace

std::shared_ptr<const Material> make_material(const CaseDescription& description, const BodyDescription& body,
                                              const PluginRegistry& registry)
{
    const PluginChoice& model = material_of(description, body).model;
    return registry.make_material(model.name, model.parameters);
}

BuiltModel build_model(const CaseDescription& description, const PluginRegistry& registry)
{
    Geometries geometries(description, registry);
    return build_model(description, registry, geometries);
}

BuiltModel build_model(const CaseDescription& description, const PluginRegistry& registry, Geometries& geometries,
                       const BuildProgress& progress)
{
    BuiltModel built;
    Model& model = built.model;
    model.state.spacing = description.discretization.spacing;
    model.state.horizon = description.discretization.horizon();
    model.state.gravity = description.gravity;
    Refusals refusals(description);
    refusals.attempt("material", [&] { built.water = Water(description, registry); });
    check_water_fields(description, refusals);
    for (std::size_t b = 0; b < description.bodies.size(); ++b)
        refusals.attempt("body." + description.bodies[b].name,
                         [&] { add_body(built, description, b, registry, geometries, progress); });
    add_obstacles(built, description, geometries, refusals);
    refusals.raise(); // what follows needs all bodies
    order_along_curve(model.state.points, model.state.spacing);
    built.water.begin(model);
    remark_on_water_tables(built);
    model.allocate();
    for (const HeldRegionDescription& region : description.held_regions)
        refusals.attempt(region.key, [&] {
            built.held_regions.push_back(points_of_region(model, region, geometries));
            built.remarks.push_back(describe_region(region, built.held_regions.back().size()));
        });
    for (std::size_t c = 0; c < description.contacts.size(); ++c)
        refusals.attempt(fmt::format("contact.{}", c),
                         [&] { built.contacts.push_back(assignment_of(model, description, c, registry)); });
    refusals.raise();
    for (const ContactAssignment& contact : built.contacts) {
        if (contact.surface_body)
            model.state.bodies[*contact.surface_body].ground = true;
        if (within_one_body(contact))
            model.state.bodies[contact.bodies[0]].joining_distance = 0.0;
    }
    return built;
}

void set_obstacles(Model& model, const CaseDescription& description, const StageDescription& stage)
{
    for (std::size_t o = 0; o < model.state.obstacles.size(); ++o) {
        const ObstacleDescription& obstacle = description.obstacles[o];
        const bool moves = obstacle.moves_in
                               ? std::ranges::find(*obstacle.moves_in, stage.name) != obstacle.moves_in->end()
                               : stage.kind == StageType::dynamic;
        model.state.obstacles[o].velocity = moves ? obstacle.velocity : Vector3(Vector3::Zero());
        model.state.obstacles[o].present = applies_in(obstacle.stages, stage);
    }
}

std::vector<Isometry> image_generators(const CaseDescription& description, const StageDescription& stage)
{
    std::vector<Isometry> generators;
    for (const BoundaryDescription& boundary : description.boundaries) {
        if (boundary.kind == ImageKind::periodic)
            generators.push_back(Isometry::shift(boundary.plane.axis, boundary.period));
        else
            generators.push_back(Isometry::reflection(boundary.plane.axis, boundary.plane.offset));
    }
    for (const PlaneDescription& roller : stage.rollers)
        if (roller.axis != cylinder_axis)
            generators.push_back(Isometry::reflection(roller.axis, roller.offset));
    return generators;
}

void initialize_materials(Model& model, const ForceState& force_state)
{
    StressWorkspace workspace;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const HeldBonds held = model.held(i);
        workspace.reserve(held.packs);
        if (model.ends.wet())
            gather_water(model.ends, i, held.neighbours, held.packs, workspace);
        MaterialBatch batch;
        batch.packs = held.packs;
        batch.bonds = held.state;
        batch.suction = workspace.suction.data();
        batch.saturation = workspace.saturation.data();
        release(*model.body_of(i).material, batch, model.body_of(i).overconsolidation_ratio);
    }
    collect_point_variables(model, force_state);
}

void set_initial_stress(Model& model, const ForceState& force_state, const CaseDescription& description)
{
    const double g = model.state.gravity.norm();
    const Vector3 up = g > 0.0 ? Vector3(-model.state.gravity / g) : Vector3::UnitZ();
    std::vector<Overburden> overburden;
    for (std::uint32_t body = 0; body < model.state.bodies.size(); ++body)
        overburden.emplace_back(model, body);
    const Points& points = model.state.points;
    const bool wet = model.ends.wet();
    for (std::size_t i = 0; i < model.size(); ++i) {
        const InitialStressDescription& initial = description.bodies[model.state.points.body[i]].initial_stress;
        if (initial.kind != InitialStressKind::geostatic)
            continue;
        const HeldBonds held = model.held(i);
        const Overburden& above = overburden[points.body[i]];
        for (std::size_t h = 0; h < held.count; ++h) {
            const BondEnd& other = model.ends[held.neighbours[h]];
            const Vector3 middle = 0.5 * (model.state.points.position[i] + other.x());
            const double depth = std::max(0.0, above.top() - middle.dot(up));
            const EndWater between = wet ? model.ends.water_between(i, held.neighbours[h]) : EndWater{};
            const double water = pore_stress(between.suction, between.saturation);
            const Overburden::Line load = above.around(depth, i);
            const double vertical = -load.unit_weight * depth - (load.offset + water);
            const double lateral = initial.lateral_coefficient * vertical;
            const Eigen::Matrix3d stress =
                lateral * Eigen::Matrix3d::Identity() + (vertical - lateral) * up * up.transpose();
            double* bond = held.bond(h);
            const double rows[6] = {stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(0, 2)};
            for (std::size_t r = 0; r < 6; ++r)
                bond[r * pack_width] = rows[r];
        }
    }
    initialize_materials(model, force_state);
}

} // namespace periporo
