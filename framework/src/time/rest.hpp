// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// When a model is at rest: its motion has died away and its forces balance, both on the mean over windows of time.
#pragma once

#include "model/model.hpp"

#include <vector>

namespace periporo {

/// Motion over a window of time, of the body that has most of it. It follows from positions at the ends of windows: a
/// vibration about a place, though it is fast and its forces are large, leaves little of either.
struct WindowMotion {
    double drift = 0.0; ///< root of the mean square displacement, weighted with mass, over the time [m/s]
    /// Mean force over that of gravity, root sums over the points of the body: mass times the change of mean velocity
    /// from window to window [-].
    double unbalanced = 0.0;
};

/// What rest means in a stage.
struct RestRule {
    double speed = 0.0;    ///< drift below which a body may be at rest [m/s]
    double residual = 0.0; ///< limit of the unbalanced force [-]
    double window = 0.0;   ///< [s]
    double from = 0.0;     ///< time at which nothing changes any more and the first window begins [s]
    /// Time up to which what stands may only seem to [s]. Infinite: until a motion of more than twice `speed` was seen.
    double believed_from = 0.0;
};

class RestCriterion {
public:
    /// Drift below this part of the speed is rest without a motion before it: of what stands and only twitched.
    static constexpr double standing = 0.1;

    /// What lives from step to step.
    struct State {
        std::vector<Vector3> position; ///< of the points at the start of the window; none before the first [m]
        std::vector<Vector3> velocity; ///< mean of the points in the window before; none before the second [m/s]
        double begun = 0.0;            ///< time of the start [s]
        double length = 0.0;           ///< of the window before [s]
        double peak = 0.0;             ///< largest drift of a window [m/s]
        double last = 0.0;             ///< drift of the window before [m/s]

        template <class Self, class Visit>
        static void members(Self& self, Visit& visit, std::size_t points)
        {
            visit("position", empty_or(self.position, points));
            visit("velocity", empty_or(self.velocity, points));
            visit("begun", self.begun);
            visit("length", self.length);
            visit("peak", self.peak);
            visit("last", self.last);
        }
    };

    RestCriterion(const RestRule& rule, State& state) : rule_(rule), state_(state) {}

    /// To be called after every step; true when the model is at rest.
    /// @param acceleration_scale of the force that `unbalanced` is relative to [m/s2]
    bool follow(const Model& model, double time, double acceleration_scale);

    /// Judges the window that ends now. The model is at rest when its drift is below the speed, below half of the
    /// largest that was seen (or has never got going), has not grown since the window before, and its forces balance.
    /// What creeps at an even or growing speed has not come to rest, however slowly it does.
    bool judge(const WindowMotion& motion, double time);

private:
    /// Motion of the window that ends now; the next one begins.
    WindowMotion end_window(const Model& model, double time, double acceleration_scale);

    RestRule rule_;
    State& state_;
};

} // namespace periporo
