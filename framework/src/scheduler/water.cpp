// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/water.hpp"

#include "scheduler/build_model.hpp"
#include "scheduler/suction_field.hpp"
#include "time/ordered_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <utility>

namespace periporo {
namespace {

std::unique_ptr<SuctionField> field_of(const CaseDescription& description, const std::string& body,
                                       const WaterDescription& water)
{
    try {
        return make_suction_field(water, description.gravity);
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("water of body '{}': {}", body, error.what()));
    }
}

bool is_dry(double suction, double saturation)
{
    return suction == 0.0 && saturation == 0.0;
}

} // namespace

Water::Water(const CaseDescription& description, const PluginRegistry& registry) : description_(&description)
{
    for (const BodyDescription& body : description.bodies) {
        const MaterialDescription& material = material_of(description, body);
        const std::optional<PluginChoice>& curve = material.retention;
        bodies_.push_back({&material, nullptr, 0.0});
        if (!curve)
            continue;
        bodies_.back().curve = registry.make_retention(curve->name, curve->parameters);
        follows_porosity_ = follows_porosity_ || bodies_.back().curve->depends_on_porosity();
    }
}

double Water::saturation(std::size_t body, const WaterDescription& water, double suction, double porosity) const
{
    if (water.type == "dry")
        return 0.0;
    return bodies_[body].curve ? bodies_[body].curve->saturation(suction, porosity) : water.saturation.value();
}

void Water::begin_body(Model& model, std::size_t body, std::size_t first) const
{
    const WaterDescription& water = description_->bodies[body].water;
    const auto field = field_of(*description_, description_->bodies[body].name, water);
    for (std::size_t i = first; i < model.points.size(); ++i) {
        model.points.suction[i] = field->at(model.points.position[i]);
        model.points.saturation[i] = saturation(body, water, model.points.suction[i], porosity_of(model, i));
    }
}

void Water::begin_stage(const Model& model, const StageDescription& stage)
{
    const Points& points = model.points;
    course_ = {points.suction, points.saturation, points.suction, points.saturation};
    set_durations(stage);
    for (const WaterChangeDescription& change : stage.water_changes) {
        const auto field = field_of(*description_, change.body, change.water);
        for (std::size_t i = 0; i < model.size(); ++i) {
            const std::size_t body = points.body[i];
            if (description_->bodies[body].name != change.body)
                continue;
            course_.suction_after[i] = field->at(points.position[i]);
            course_.saturation_after[i] =
                saturation(body, change.water, course_.suction_after[i], porosity_of(model, i));
        }
    }
}

void Water::set_durations(const StageDescription& stage)
{
    longest_ = 0.0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        bodies_[b].over = 0.0;
        for (const WaterChangeDescription& change : stage.water_changes)
            if (change.body == description_->bodies[b].name)
                bodies_[b].over = change.over;
        longest_ = std::max(longest_, bodies_[b].over);
    }
    settled_ = stage.water_changes.empty();
}

void Water::restore(WaterCourse course, const StageDescription& stage)
{
    course_ = std::move(course);
    set_durations(stage);
}

double Water::BodyWater::way(double time) const
{
    return over > 0.0 ? std::min(1.0, time / over) : 1.0;
}

double Water::saturation_on_the_way(const BodyWater& body, std::size_t point, double way, double porosity) const
{
    const double before = course_.saturation_before[point], after = course_.saturation_after[point];
    const bool was_dry = is_dry(course_.suction_before[point], before);
    const bool gets_dry = is_dry(course_.suction_after[point], after);
    if ((was_dry && gets_dry) || (was_dry && way == 0.0) || (gets_dry && way == 1.0))
        return 0.0;
    if (!body.curve)
        return std::lerp(before, after, way);
    return body.curve->saturation(std::lerp(course_.suction_before[point], course_.suction_after[point], way),
                                  porosity);
}

ArrivedEnergy Water::follow(Model& model, double time)
{
    if (settled_ && !(follows_porosity_ && model.wet))
        return {};
    const bool changes = !settled_;
    settled_ = time >= longest_;
    Points& points = model.points;
    const auto [kinetic, gravity] = ordered_sums<2>(points.size(), [&](std::size_t i, std::array<double, 2>& sum) {
        const BodyWater& body = bodies_[points.body[i]];
        const double way = body.way(time);
        points.suction[i] = std::lerp(course_.suction_before[i], course_.suction_after[i], way);
        points.saturation[i] = saturation_on_the_way(body, i, way, porosity_of(model, i));
        if (!changes)
            return;
        const MaterialDescription& material = *body.material;
        const double mass = mixture_density(material, saturation_on_the_way(body, i, way, material.porosity)) *
                            points.initial_volume[i];
        const double arrived = mass - std::exchange(points.mass[i], mass);
        sum[0] += 0.5 * arrived * points.velocity[i].squaredNorm();
        sum[1] -= arrived * model.gravity.dot(points.position[i]);
    });
    return {kinetic, gravity};
}

double porosity_of(const Model& model, std::size_t point)
{
    const double ratio = model.points.volume[point] / model.points.initial_volume[point];
    return std::max(0.0, 1.0 - (1.0 - model.body_of(point).porosity) / ratio);
}

} // namespace periporo
