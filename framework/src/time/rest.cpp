// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "time/rest.hpp"

#include <algorithm>
#include <cmath>

namespace periporo {

bool RestCriterion::follow(const Model& model, double time, double acceleration_scale)
{
    if (state_.position.empty()) {
        if (time >= rule_.from) {
            state_.position = model.state.points.position;
            state_.begun = time;
        }
        return false;
    }
    if (time - state_.begun < rule_.window)
        return false;
    return judge(end_window(model, time, acceleration_scale), time);
}

WindowMotion RestCriterion::end_window(const Model& model, double time, double acceleration_scale)
{
    struct Sums {
        double mass = 0.0, squared_mass = 0.0, velocity = 0.0, change = 0.0;
    };
    std::vector<Sums> bodies(model.state.bodies.size()); // once a window
    const Points& points = model.state.points;
    const double length = time - state_.begun;
    const bool first = state_.velocity.empty();
    state_.velocity.resize(points.size(), Vector3::Zero());
    for (std::size_t i = 0; i < points.size(); ++i) {
        Sums& body = bodies[points.body[i]];
        const double mass = points.mass[i];
        const Vector3 velocity = (points.position[i] - state_.position[i]) / length;
        body.mass += mass;
        body.squared_mass += mass * mass;
        body.velocity += mass * velocity.squaredNorm();
        body.change += mass * mass * (velocity - state_.velocity[i]).squaredNorm();
        state_.velocity[i] = velocity;
    }
    const double between = 0.5 * (state_.length + length); // of the middles of the windows
    WindowMotion most;
    for (const Sums& body : bodies) {
        if (!(body.mass > 0.0))
            continue;
        most.drift = std::max(most.drift, std::sqrt(body.velocity / body.mass));
        if (body.change > 0.0)
            most.unbalanced =
                std::max(most.unbalanced, std::sqrt(body.change / body.squared_mass) / (between * acceleration_scale));
    }
    if (first)
        most.unbalanced = INFINITY;
    state_.position = points.position;
    state_.begun = time;
    state_.length = length;
    return most;
}

bool RestCriterion::judge(const WindowMotion& motion, double time)
{
    const bool growing = motion.drift > state_.last;
    state_.last = motion.drift;
    state_.peak = std::max(state_.peak, motion.drift);
    const bool believed =
        std::isfinite(rule_.believed_from) ? time > rule_.believed_from : state_.peak > 2.0 * rule_.speed;
    const bool died_away = motion.drift <= 0.5 * state_.peak || motion.drift < standing * rule_.speed;
    return believed && died_away && !growing && motion.drift < rule_.speed && motion.unbalanced < rule_.residual;
}

} // namespace periporo
