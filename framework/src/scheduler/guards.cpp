// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/guards.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace periporo {
namespace {

/// Energy below which nothing has begun, as the fall of the whole mass over a part of the spacing: an error is not held
/// against less.
constexpr double beginning = 1e-3;
constexpr double generous = 10.0;

double least_turnover(const Model& model)
{
    double mass = 0.0;
    for (const double m : model.state.points.mass)
        mass += m;
    return beginning * mass * model.state.gravity.norm() * model.state.spacing;
}

std::size_t fastest_point(const Model& model)
{
    const std::vector<Vector3>& velocity = model.state.points.velocity;
    return static_cast<std::size_t>(
        std::ranges::max_element(velocity, {}, [](const Vector3& v) { return v.squaredNorm(); }) - velocity.begin());
}

std::string place(const Model& model, std::size_t point)
{
    const Vector3& x = model.state.points.position[point];
    return fmt::format("point {} of body '{}' at position ({:.5g}, {:.5g}, {:.5g}) m", model.state.points.id[point],
                       model.body_of(point).name, x.x(), x.y(), x.z());
}

std::string fastest(const Model& model)
{
    const std::size_t point = fastest_point(model);
    return fmt::format("the fastest is {} with {:.4g} m/s", place(model, point),
                       model.state.points.velocity[point].norm());
}

/// What a user can do about energy from nowhere.
std::string way_out(const CaseDescription& description)
{
    const std::string& state = description.operators.force_state;
    if (state == "volume_weighted" || state == "unstabilized")
        return fmt::format("force_state '{}' creates energy by itself: take 'energy_conjugate' or 'bond_projection', "
                           "or raise [run] energy_error_limit to see what it does",
                           state);
    return description.time.step ? "leave [time] step out, or make it smaller; if the error stays, look at what moves "
                                   "there; [run] energy_error_limit sets what is allowed"
                                 : "a smaller [time] safety shows whether the step is to blame; if the error stays, "
                                   "look at what moves there; [run] energy_error_limit sets what is allowed";
}

} // namespace

double lost_distance(const Model& model)
{
    return 1e3 * model.state.horizon;
}

std::string lost_point(const Model& model)
{
    const double far = lost_distance(model);
    for (std::size_t i = 0; i < model.size(); ++i) {
        const Vector3& x = model.state.points.position[i];
        const bool finite = x.allFinite() && model.state.points.velocity[i].allFinite();
        if (finite && (x - model.state.points.initial_position[i]).norm() < far)
            continue;
        return fmt::format("{} {}; a smaller [time] safety or a [time] step shows whether the step is to blame",
                           place(model, i),
                           finite ? "was lost, farther than 1000 horizons from where it began" : "is not finite");
    }
    return {};
}

std::string energy_of_motion_from_nowhere(const Model& model, const CaseDescription& description,
                                          const EnergyLedger& ledger, double error_before)
{
    const double given = ledger.given() + std::max(error_before, 0.0) + least_turnover(model);
    const double allowed = (2.0 + description.energy_error_limit) * given;
    if (ledger.kinetic <= allowed) // also false for no number, which lost_point() names
        return {};
    return fmt::format("the points move with {:.4g} J where only {:.4g} J were there to move them; {}; {}",
                       ledger.kinetic, given, fastest(model), way_out(description));
}

std::string energy_error_beyond_limit(const Model& model, const CaseDescription& description,
                                      const EnergyLedger& ledger, double error_before)
{
    const double error = ledger.error() - error_before;
    const double turned_over = std::max(ledger.turned_over, least_turnover(model));
    if (std::abs(error) <= description.energy_error_limit * turned_over)
        return {};
    return fmt::format("{:.4g} J {}, {:.3g} per cent of the {:.4g} J turned over, where {:.3g} per cent are allowed; "
                       "{}; {}",
                       std::abs(error), error > 0.0 ? "came from nowhere" : "were lost",
                       100.0 * std::abs(error) / turned_over, turned_over, 100.0 * description.energy_error_limit,
                       fastest(model), way_out(description));
}

std::string faster_than_driven(const Model& model, const CaseDescription& description, double acceleration)
{
    Vector3 lower = model.state.points.initial_position.front(), upper = lower;
    for (const Vector3& x : model.state.points.initial_position) {
        lower = lower.cwiseMin(x);
        upper = upper.cwiseMax(x);
    }
    const double size = (upper - lower).norm() + model.state.spacing;
    double speed = std::sqrt(2.0 * acceleration * size);
    for (const BodyDescription& body : description.bodies)
        speed = std::max(speed, body.velocity.norm() + size * (body.angular_velocity.norm() + body.strain_rate.norm()));
    for (const Obstacle& obstacle : model.state.obstacles)
        speed = std::max(speed, obstacle.velocity.norm());
    for (const HeldRegionDescription& region : description.held_regions)
        speed = std::max(speed, region.velocity.norm());
    const std::size_t point = fastest_point(model);
    if (model.state.points.velocity[point].norm() <= generous * speed)
        return {};
    return fmt::format(
        "{} moves with {:.4g} m/s, where nothing drives it to more than {:.4g} m/s: the motion grows "
        "instead of settling; a smaller [time] safety shows whether the step is to blame, and an elastic "
        "response of the stage whether the material is",
        place(model, point), model.state.points.velocity[point].norm(), speed);
}

} // namespace periporo
