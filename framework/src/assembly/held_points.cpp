// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/held_points.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <stdexcept>

namespace periporo {
namespace {

/// The conditions of a region in words.
std::string conditions_of(const HeldRegionDescription& region)
{
    std::vector<std::string> words;
    if (!region.body.empty())
        words.push_back(fmt::format("of body '{}'", region.body));
    if (region.below)
        words.push_back(fmt::format("at {} < {:.4g} m", "xyz"[region.below->axis], region.below->offset));
    if (!region.layer.empty())
        words.push_back(fmt::format("at {:.4g} m <= {} < {:.4g} m", region.layer[0].offset, "xyz"[region.layer[0].axis],
                                    region.layer[1].offset));
    if (!region.within.empty())
        words.push_back(fmt::format("within geometry '{}'", region.within));
    return fmt::format("{}", fmt::join(words, ", "));
}

} // namespace

bool applies_in(const std::vector<std::string>& stages, const StageDescription& stage)
{
    return stages.empty() || std::ranges::find(stages, stage.name) != stages.end();
}

std::string describe_region(const HeldRegionDescription& region, std::size_t points)
{
    const char* how = region.kind == HeldKind::fixed    ? "fixed"
                      : region.kind == HeldKind::roller ? "on rollers"
                                                        : "moved";
    return fmt::format("{} points are {}{}, those that begin {}", points, how,
                       region.stages.empty() ? "" : fmt::format(" in {}", fmt::join(region.stages, ", ")),
                       conditions_of(region));
}

std::vector<std::uint32_t> points_of_region(const Model& model, const HeldRegionDescription& region,
                                            Geometries& geometries)
{
    const std::shared_ptr<const Geometry> within = region.within.empty() ? nullptr : geometries.named(region.within);
    std::vector<std::uint32_t> points;
    for (std::uint32_t i = 0; i < model.size(); ++i) {
        const Vector3& x = model.state.points.initial_position[i];
        if ((region.body.empty() || model.body_of(i).name == region.body) &&
            (!region.below || x[region.below->axis] < region.below->offset) &&
            (region.layer.empty() ||
             (x[region.layer[0].axis] >= region.layer[0].offset && x[region.layer[1].axis] < region.layer[1].offset)) &&
            (within == nullptr || within->contains(x)))
            points.push_back(i);
    }
    const bool everything = points.size() == model.size() && region.kind == HeldKind::fixed && region.stages.empty();
    if (points.empty() || everything)
        throw std::runtime_error(
            fmt::format("boundary '{}': {} of the {} points begin {}; a held region needs some, and "
                        "one that is fixed for the whole run leaves others free",
                        name_of(region.kind), points.empty() ? "none" : "all", model.size(), conditions_of(region)));
    return points;
}

void check_rollers(const Model& model, const StageDescription& stage)
{
    for (const PlaneDescription& roller : stage.rollers) {
        if (roller.axis == cylinder_axis)
            continue;
        const auto beyond = [&](const Vector3& x) { return x[roller.axis] > roller.offset; };
        const auto count = std::ranges::count_if(model.state.points.position, beyond);
        if (count != 0 && static_cast<std::size_t>(count) != model.size())
            throw std::runtime_error(fmt::format(
                "stage '{0}': {1} of the {2} points lie beyond the roller {3} = {4:.4g} m, which is a mirror for "
                "all of the model; to hold one body write a [[boundary]] of type \"roller\" with body, "
                "layer, direction and stages = [\"{0}\"]",
                stage.name, count, model.size(), "xyz"[roller.axis], roller.offset));
    }
}

namespace {

/// The directions in which one point is held, orthogonal to each other, and who holds it there.
class HeldPoint {
public:
    /// Adds a direction. It may be one in which the point is held already.
    /// @param holder in words, "[[boundary]] 2 (moving)"
    /// @throws std::runtime_error when the point is held there at another speed
    void add(const Model& model, HeldDirection held, const std::string& holder)
    {
        constexpr double same = 1e-6; // part of a unit vector that is round-off, or a direction written with few digits
        const HeldDirection asked = held;
        for (const HeldDirection& other : directions_) {
            const double along = asked.direction.dot(other.direction);
            held.direction -= along * other.direction;
            held.speed -= along * other.speed;
        }
        const double left = held.direction.norm();
        if (left > same) {
            held.direction /= left;
            held.speed /= left;
            directions_.push_back(held);
            holders_.push_back(holder);
            return;
        }
        double fastest = std::abs(asked.speed);
        for (const HeldDirection& other : directions_)
            fastest = std::max(fastest, std::abs(other.speed));
        if (std::abs(held.speed) <= same * fastest)
            return;
        const Vector3& d = asked.direction;
        throw std::runtime_error(fmt::format("point {} of body '{}' is held twice along ({:.3g}, {:.3g}, {:.3g}): at "
                                             "{:.4g} m/s by {}, and at {:.4g} m/s by "
                                             "{}; let them hold other points, or hold in other stages",
                                             model.state.points.id[asked.point], model.body_of(asked.point).name, d.x(),
                                             d.y(), d.z(), asked.speed, holder, asked.speed - held.speed,
                                             fmt::join(holders_, " and ")));
    }
    const std::vector<HeldDirection>& directions() const { return directions_; }

private:
    std::vector<HeldDirection> directions_; // 3 at most
    std::vector<std::string> holders_;
};

/// What is held, point by point.
class HeldPoints {
public:
    explicit HeldPoints(const Model& model) : model_(model) {}

    void add(const HeldDirection& held, const std::string& holder) { points_[held.point].add(model_, held, holder); }
    std::vector<HeldDirection> directions() const
    {
        std::vector<HeldDirection> all;
        for (const auto& [point, held] : points_)
            all.insert(all.end(), held.directions().begin(), held.directions().end());
        return all;
    }

private:
    const Model& model_;
    std::map<std::uint32_t, HeldPoint> points_;
};

} // namespace

std::vector<HeldDirection> held_directions(const Model& model, const CaseDescription& description,
                                           const std::vector<std::vector<std::uint32_t>>& regions,
                                           const StageDescription& stage)
{
    HeldPoints held(model);
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const HeldRegionDescription& region = description.held_regions[r];
        if (!applies_in(region.stages, stage))
            continue;
        const std::string holder = fmt::format("{} ({})", region.key, name_of(region.kind));
        for (const std::uint32_t i : regions[r]) {
            if (region.kind == HeldKind::roller) {
                held.add({i, region.direction}, holder);
                continue;
            }
            for (Eigen::Index c = 0; c < 3; ++c)
                held.add({i, Vector3::Unit(c), region.velocity[c]}, holder);
        }
    }
    for (const PlaneDescription& roller : stage.rollers) {
        if (roller.axis != cylinder_axis)
            continue;
        for (std::uint32_t i = 0; i < model.size(); ++i) {
            const Vector3& x = model.state.points.initial_position[i];
            const Vector3 radial(x.x(), x.y(), 0.0);
            if (radial.norm() > roller.offset - model.state.spacing)
                held.add({i, radial.normalized()},
                         fmt::format("the roller r = {:.4g} m of stage '{}'", roller.offset, stage.name));
        }
    }
    return held.directions();
}

} // namespace periporo
