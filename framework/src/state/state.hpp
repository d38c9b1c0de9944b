// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A simulation at an instant: bodies, obstacles, points, and the states at the points.
#pragma once

#include "state/body.hpp"
#include "state/obstacle.hpp"
#include "state/points.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace periporo {

/// Mean stress and state variables of points: six components xx yy zz xy yz xz [Pa], then the variables of the
/// material. Each point has room for those of the material that has most.
struct PointStates {
    std::vector<double> values;
    std::size_t stride = 0; ///< numbers of a point

    double* operator[](std::size_t point) { return values.data() + point * stride; }
    const double* operator[](std::size_t point) const { return values.data() + point * stride; }
};

struct State {
    double spacing = 0.0;              ///< dx [m]
    double horizon = 0.0;              ///< delta [m]
    Vector3 gravity = Vector3::Zero(); ///< [m/s2]
    std::vector<Body> bodies;
    std::vector<Obstacle> obstacles;
    Points points;
    PointStates point_states; ///< at the last refresh; a detached point keeps its state variables here

    std::size_t size() const { return points.size(); }
    const Body& body_of(std::size_t point) const { return bodies[points.body[point]]; }
    std::size_t rows(std::size_t point) const { return body_of(point).rows(); }

    /// Sets the states of all points to no stress and the initial variables of their materials.
    void reset_point_states();

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit.part("points", self.points);
        visit("point_states", any_reals(self.point_states.values));
        for (std::size_t o = 0; o < self.obstacles.size(); ++o)
            visit("obstacle/" + std::to_string(o) + "/shift", self.obstacles[o].shift);
    }
};

} // namespace periporo
