// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/gravity_checks.hpp"

#include "assembly/held_points.hpp"
#include "case/refusal.hpp"
#include "contact/rigid_contact_surface.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace periporo {
namespace {

constexpr std::size_t most_looked_at = 500; ///< points of a body; a surface that only others meet is very small
constexpr double small_component = 1e-6;    ///< of the unit vector along gravity, below which a plane does not bear

/// Whether each body is held against gravity.
class WeightBearing {
public:
    WeightBearing(const BuiltModel& built, const CaseDescription& description, const StageDescription& stage)
        : built_(built), description_(description), down_(description.gravity.normalized()),
          held_(built.model.state.bodies.size(), false)
    {
        for (std::size_t b = 0; b < held_.size(); ++b)
            held_[b] = built.model.state.bodies[b].has_standing_water(); // buoyancy
        find_planes(stage);
        find_held_regions(stage);
        for (const ContactAssignment& contact : built.contacts)
            if (at_rigid_surface(contact) && is_there(contact, stage))
                for (const std::uint32_t body : contact.bodies)
                    held_[body] = held_[body] || falls_towards(contact, body);
        pass_on();
    }

    bool holds(std::size_t body) const { return held_[body]; }

private:
    /// Does a plane across this axis, or a motion held along it, bear a part of the weight?
    bool bears(int axis) const { return std::abs(down_[axis]) > small_component; }

    void find_planes(const StageDescription& stage)
    {
        const auto of_cylinder = [&] { return bears(0) || bears(1); };
        const auto holds = [&](const PlaneDescription& plane) {
            return plane.axis == cylinder_axis ? of_cylinder() : bears(plane.axis);
        };
        bool some = std::ranges::any_of(stage.rollers, holds);
        for (const BoundaryDescription& boundary : description_.boundaries)
            some = some || (boundary.kind == ImageKind::symmetry && holds(boundary.plane));
        if (some)
            held_.assign(held_.size(), true);
    }

    void find_held_regions(const StageDescription& stage)
    {
        for (std::size_t r = 0; r < description_.held_regions.size(); ++r) {
            const HeldRegionDescription& region = description_.held_regions[r];
            const bool bears_weight =
                region.kind != HeldKind::roller || std::abs(region.direction.dot(down_)) > small_component;
            if (!bears_weight || !applies_in(region.stages, stage))
                continue;
            for (const std::uint32_t i : built_.held_regions[r])
                held_[built_.model.state.points.body[i]] = true;
        }
    }

    bool is_there(const ContactAssignment& contact, const StageDescription& stage) const
    {
        return !contact.obstacle || applies_in(description_.obstacles[*contact.obstacle].stages, stage);
    }

    /// Does some point of the body come nearer to the surface when it falls?
    bool falls_towards(const ContactAssignment& contact, std::uint32_t body) const
    {
        const Model& model = built_.model;
        const RigidContactSurface surface(model, contact);
        const std::size_t stride = 1 + model.size() / most_looked_at;
        for (std::size_t i = 0; i < model.size(); ++i) {
            if (model.state.points.body[i] != body || i % stride != 0)
                continue;
            Vector3 normal;
            const double distance = surface.distance(model.state.points.position[i], normal);
            const double fall = std::max(std::abs(distance), model.state.spacing);
            for (const double part : {0.5, 1.0, 2.0, 4.0})
                if (surface.distance(model.state.points.position[i] + part * fall * down_, normal) <
                    distance - 1e-3 * fall)
                    return true;
        }
        return false;
    }

    /// A body that touches a held one is held.
    void pass_on()
    {
        for (bool changed = true; changed;) {
            changed = false;
            for (const ContactAssignment& contact : built_.contacts) {
                const bool some = !at_rigid_surface(contact) &&
                                  std::ranges::any_of(contact.bodies, [&](std::uint32_t b) { return held_[b]; });
                for (const std::uint32_t body : contact.bodies)
                    if (some && !held_[body])
                        changed = held_[body] = true;
            }
        }
    }

    const BuiltModel& built_;
    const CaseDescription& description_;
    Vector3 down_;
    std::vector<bool> held_;
};

/// Is a body given a surface, and does nothing lead it there but gravity?
bool is_left_to_gravity(const BuiltModel& built, const CaseDescription& description, std::size_t body)
{
    const BodyDescription& moved = description.bodies[body];
    const bool driven =
        !moved.velocity.isZero() || !moved.angular_velocity.isZero() || !moved.strain_rate.isZero() ||
        std::ranges::any_of(description.obstacles, [](const auto& it) { return !it.velocity.isZero(); });
    return !driven && std::ranges::any_of(built.contacts, [&](const ContactAssignment& contact) {
        return at_rigid_surface(contact) && names(contact, static_cast<std::uint32_t>(body));
    });
}

} // namespace

void check_gravity(const BuiltModel& built, const CaseDescription& description, std::vector<std::string>& suspicions)
{
    if (description.gravity.isZero())
        return;
    std::vector<bool> told(built.model.state.bodies.size(), false);
    for (std::size_t s = 0; s < description.stages.size(); ++s) {
        const StageDescription& stage = description.stages[s];
        const WeightBearing bearing(built, description, stage);
        for (std::size_t b = 0; b < built.model.state.bodies.size(); ++b) {
            if (bearing.holds(b) || told[b])
                continue;
            const std::string what = fmt::format("nothing holds body '{}' against gravity in stage '{}'",
                                                 built.model.state.bodies[b].name, stage.name);
            const std::string way_out = "give a contact with a surface that it falls on, hold some of its points, or "
                                        "turn 'gravity'";
            if (stage.kind == StageType::quasi_static)
                throw refusal(description, fmt::format("stage.{}", s), what + ": it never comes to rest", way_out);
            if (is_left_to_gravity(built, description, b))
                throw refusal(description,
                              description.places.contains("gravity")
                                  ? "gravity"
                                  : "body." + built.model.state.bodies[b].name + ".geometry",
                              what + ", and it falls away from the surfaces that it is given", way_out);
            suspicions.push_back(suspicion(description, fmt::format("stage.{}", s), what + ": it falls freely"));
            told[b] = true;
        }
    }
}

} // namespace periporo
