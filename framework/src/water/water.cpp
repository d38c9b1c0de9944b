// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The course of pore pressure, saturation and mass.
#include "water/water.hpp"

#include "state/ordered_sum.hpp"
#include "water/pressure_field.hpp"
#include "water/standing_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace periporo {
namespace {

constexpr double no_water = -std::numeric_limits<double>::infinity(); ///< level where none stands [m]

std::unique_ptr<PressureField> field_of(const CaseDescription& description, const std::string& body,
                                        const WaterDescription& water)
{
    try {
        return make_pressure_field(water, description.gravity);
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("water of body '{}': {}", body, error.what()));
    }
}

/// Height of the water table of a body [m].
double level_of(const WaterDescription& water, const Vector3& up)
{
    return water.kind == WaterKind::hydrostatic ? up[water.water_table.axis] * water.water_table.offset : no_water;
}

bool is_dry(double pressure, double saturation)
{
    return pressure == 0.0 && saturation == 0.0;
}

} // namespace

Water::Water(const CaseDescription& description, const PluginRegistry& registry) : description_(&description)
{
    for (const BodyDescription& body : description.bodies) {
        const MaterialDescription& material = material_of(description, body);
        const std::optional<PluginChoice>& curve = material.retention;
        bodies_.push_back({&material, nullptr});
        if (!curve)
            continue;
        bodies_.back().curve = registry.make_retention(curve->name, curve->parameters);
        follows_porosity_ = follows_porosity_ || bodies_.back().curve->depends_on_porosity();
    }
}

double Water::given_saturation(std::size_t body, const WaterDescription& water, double pressure, double porosity) const
{
    if (water.kind == WaterKind::dry)
        return 0.0;
    return bodies_[body].curve ? bodies_[body].curve->saturation(suction_of(pressure), porosity)
                               : water.saturation.value();
}

void Water::begin(Model& model)
{
    Points& points = model.state.points;
    const StandingWater standing(model);
    std::vector<std::unique_ptr<PressureField>> fields;
    std::vector<double> levels;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const BodyDescription& body = description_->bodies[b];
        fields.push_back(field_of(*description_, body.name, body.water));
        levels.push_back(level_of(body.water, standing.up()));
        model.state.bodies[b].water_level = levels.back();
    }
    std::vector<double> pressure(model.size()), saturation(model.size()), soaked(model.size());
    for (std::size_t i = 0; i < model.size(); ++i) {
        const std::size_t body = points.body[i];
        pressure[i] = fields[body]->at(points.position[i]);
        saturation[i] = given_saturation(body, description_->bodies[body].water, pressure[i], porosity_of(model, i));
        soaked[i] = standing.share_below(standing.height_of(i));
    }
    course_ = {pressure,   saturation, pressure,
               saturation, soaked,     levels,
               levels,     levels,     std::vector<double>(bodies_.size(), 1.0)};
    for (std::size_t i = 0; i < model.size(); ++i) {
        fill(model, i, standing);
        points.mass[i] = mass_of(model, i);
    }
}

void Water::begin_stage(const Model& model, const StageDescription& stage)
{
    const Points& points = model.state.points;
    WaterCourse now = course_;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        now.level_before[b] = now.level_after[b] = level(b);
    for (std::size_t i = 0; i < model.size(); ++i) {
        now.pressure_before[i] =
            std::lerp(course_.pressure_before[i], course_.pressure_after[i], course_.done[points.body[i]]);
        now.saturation_before[i] = own_saturation(i, points.body[i], porosity_of(model, i));
    }
    now.pressure_after = now.pressure_before;
    now.saturation_after = now.saturation_before;
    course_ = std::move(now);
    set_durations(stage);
    settled_ = stage.water_changes.empty();
    for (const WaterChangeDescription& change : stage.water_changes)
        for (std::size_t b = 0; b < bodies_.size(); ++b)
            if (description_->bodies[b].name == change.body)
                begin_change(model, b, change.water);
}

void Water::begin_change(const Model& model, std::size_t body, const WaterDescription& water)
{
    const Points& points = model.state.points;
    const StandingWater standing(model);
    const auto field = field_of(*description_, description_->bodies[body].name, water);
    course_.level_after[body] = level_of(water, standing.up());
    course_.lowest[body] = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (points.body[i] != body)
            continue;
        course_.lowest[body] =
            std::min(course_.lowest[body], points.position[i].dot(standing.up()) - 0.5 * model.state.spacing);
        // The change starts from the water that the point has, also where it took that from standing water.
        const double share = standing.share_below(standing.height_of(i));
        const double soaked = std::exchange(course_.soaked[i], share);
        course_.pressure_before[i] = std::lerp(course_.pressure_before[i], points.pore_pressure[i], soaked);
        if (soaked > share)
            course_.saturation_before[i] =
                std::lerp(course_.saturation_before[i], 1.0, (soaked - share) / (1.0 - share));
        course_.pressure_after[i] = field->at(points.position[i]);
        course_.saturation_after[i] = given_saturation(body, water, course_.pressure_after[i], porosity_of(model, i));
    }
}

void Water::set_durations(const StageDescription& stage)
{
    longest_ = 0.0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        bodies_[b].over = 0.0;
        bodies_[b].changes = false;
        for (const WaterChangeDescription& change : stage.water_changes)
            if (change.body == description_->bodies[b].name) {
                bodies_[b].over = change.over;
                bodies_[b].changes = true;
            }
        longest_ = std::max(longest_, bodies_[b].over);
    }
}

void Water::resume(Model& model, const StageDescription& stage)
{
    set_durations(stage);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        model.state.bodies[b].water_level = level(b);
}

double Water::BodyWater::done(double time) const
{
    return over > 0.0 ? std::min(1.0, time / over) : 1.0;
}

double Water::level(std::size_t body) const
{
    const double done = course_.done[body];
    double before = course_.level_before[body], after = course_.level_after[body];
    if (before == after || done >= 1.0)
        return after;
    // Water that comes or goes altogether fills the body from its bottom, or leaves it there.
    if (before == no_water)
        before = std::min(after, course_.lowest[body]);
    else if (after == no_water)
        after = std::min(before, course_.lowest[body]);
    return std::lerp(before, after, done);
}

double Water::own_saturation(std::size_t point, std::size_t body, double porosity) const
{
    const double done = course_.done[body];
    const double before = course_.saturation_before[point], after = course_.saturation_after[point];
    const bool was_dry = is_dry(course_.pressure_before[point], before);
    const bool gets_dry = is_dry(course_.pressure_after[point], after);
    if ((was_dry && gets_dry) || (was_dry && done == 0.0) || (gets_dry && done == 1.0))
        return 0.0;
    const Retention* curve = bodies_[body].curve.get();
    if (curve == nullptr)
        return std::lerp(before, after, done);
    return curve->saturation(suction_of(std::lerp(course_.pressure_before[point], course_.pressure_after[point], done)),
                             porosity);
}

ArrivedEnergy Water::follow(Model& model, double time, double time_step)
{
    const bool stands = StandingWater(model).anywhere();
    if (settled_ && !(follows_porosity_ && model.ends.wet()) && !stands)
        return {};
    const bool weighs = !settled_ || stands;
    settled_ = time >= longest_;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        course_.done[b] = bodies_[b].done(time);
        model.state.bodies[b].water_level = level(b);
    }
    Points& points = model.state.points;
    const StandingWater standing(model);
    const auto [kinetic, gravity] = ordered_sums<2>(points.size(), [&](std::size_t i, std::array<double, 2>& sum) {
        const double share = standing.share_below(standing.height_of(i));
        course_.soaked[i] = bodies_[points.body[i]].changes ? share : std::max(course_.soaked[i], share);
        fill(model, i, standing);
        if (!weighs)
            return;
        const double mass = mass_of(model, i);
        const double arrived = mass - std::exchange(points.mass[i], mass);
        sum[0] += 0.5 * arrived * points.velocity[i].squaredNorm();
        const Vector3 mid_velocity = points.velocity[i] + 0.5 * time_step / mass * points.force[i];
        sum[1] -= arrived * model.state.gravity.dot(points.position[i] + 0.5 * time_step * mid_velocity);
    });
    return {kinetic, gravity};
}

void Water::fill(Model& model, std::size_t point, const StandingWater& standing)
{
    Points& points = model.state.points;
    const std::size_t body = points.body[point];
    const double own =
        std::min(0.0, std::lerp(course_.pressure_before[point], course_.pressure_after[point], course_.done[body]));
    const double soaked = course_.soaked[point];
    points.pore_pressure[point] = own;
    points.saturation[point] = own_saturation(point, body, porosity_of(model, point));
    if (soaked == 0.0)
        return;
    // What was under water has no more suction than water at rest at its height, and full pores.
    const double at_rest = -standing.unit_weight() * standing.height_of(point);
    points.pore_pressure[point] =
        std::max(0.0, at_rest) + std::lerp(own, std::max(own, std::min(0.0, at_rest)), soaked);
    points.saturation[point] = std::lerp(points.saturation[point], 1.0, soaked);
}

double Water::mass_of(const Model& model, std::size_t point) const
{
    const Points& points = model.state.points;
    const std::size_t body = points.body[point];
    const MaterialDescription& material = *bodies_[body].material;
    const double saturation = own_saturation(point, body, material.porosity);
    const double mass = mixture_density(material, saturation) * points.initial_volume[point];
    if (course_.soaked[point] == 0.0)
        return mass;
    const double grains = (1.0 - material.porosity) * points.initial_volume[point];
    const double held = saturation * material.porosity * points.initial_volume[point];
    return mass + course_.soaked[point] * water_density * (std::max(grains, points.volume[point]) - grains - held);
}

} // namespace periporo
