// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The sums of a step over all contacts, to which every kind of contact adds.
#pragma once

#include "periporo/tensor.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace periporo {

/// Power of moving obstacles on points [W].
struct ObstaclePower {
    double reaction = 0.0; ///< of all forces on points, with the velocities of the obstacles
    double friction = 0.0; ///< the part of friction
    double damping = 0.0;  ///< the part of dashpots
};

/// A point that passed through an obstacle.
struct Crossing {
    std::size_t assignment;
    std::uint32_t point;
};

struct ContactSums {
    // of each point
    std::vector<Vector3> friction; ///< [N]
    std::vector<Vector3> damping;  ///< part of the normal forces that does not come from stored energy [N]
    std::vector<double> energy;    ///< stored [J]
    /// Force of each obstacle on all points, then that of the surfaces of laws [N].
    std::vector<Vector3> obstacle_reactions;
    ObstaclePower obstacle_power;
    std::vector<Crossing> crossings;
    double energy_of_crossings = 0.0; ///< stored one step ago by the points that have crossed since [J]

    /// Sets all sums to zero.
    void reset(std::size_t points, std::size_t obstacles)
    {
        friction.assign(points, Vector3::Zero());
        damping.assign(points, Vector3::Zero());
        energy.assign(points, 0.0);
        obstacle_reactions.assign(obstacles + 1, Vector3::Zero());
        obstacle_power = {};
        crossings.clear();
        energy_of_crossings = 0.0;
    }
};

/// The times that contacts need in a step.
struct ContactStep {
    double time_step = 0.0;       ///< within which friction may stop a slip, 0 for no friction [s]
    double approach_factor = 0.0; ///< of the approach speed that laws receive: 1, or 0 while a body settles
    double law_step = 0.0;        ///< that laws receive, see ContactPair::time_step [s]
};

} // namespace periporo
