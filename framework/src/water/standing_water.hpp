// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Water at rest below a water table: its pressure, and its lift on the points of a body.
//
// The table is a plane through space, so water stands outside of the soil too, and its pressure p_ext = rho_w g depth
// loads the surface of the body. In the operator this load and the pore pressure cancel: div(-p_ext 1) = -grad p_ext is
// a body force rho_w g upwards, inside of the body and at its surface alike. No surface needs to be known.
#pragma once

#include "model/model.hpp"
#include "water/mixture.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace periporo {

class StandingWater {
public:
    explicit StandingWater(const Model& model)
        : model_(model), gravity_(model.state.gravity.norm()),
          up_(gravity_ > 0.0 ? Vector3(-model.state.gravity / gravity_) : Vector3::UnitZ())
    {
    }

    /// Does water stand around some body?
    bool anywhere() const { return std::ranges::any_of(model_.state.bodies, &Body::has_standing_water); }
    const Vector3& up() const { return up_; }
    /// rho_w g [N/m3].
    double unit_weight() const { return water_density * gravity_; }

    /// Height of a point above the surface of the water around its body [m]; infinite when none stands there.
    double height_of(std::size_t point) const
    {
        return model_.state.points.position[point].dot(up_) - model_.body_of(point).water_level;
    }
    /// The part under water of a cell one spacing high, whose middle is at `height` above the surface [-]. The lift of
    /// a point that sinks into the water grows evenly from nothing to the whole, as that of a cube of the lattice does.
    double share_below(double height) const { return std::clamp(0.5 - height / model_.state.spacing, 0.0, 1.0); }
    /// rho_w g V of the part under water [N].
    double buoyancy_of(std::size_t point) const
    {
        return unit_weight() * model_.state.points.volume[point] * share_below(height_of(point));
    }

private:
    const Model& model_;
    double gravity_; ///< [m/s2]
    Vector3 up_;
};

/// Adds the buoyancy of all points to their forces.
/// @param buoyancy of each point at the evaluation before, empty if there was none; renewed [N]
/// @returns its mean power over the step at the velocities at hand: with those of the middle of the step, times dt, the
/// work that velocity Verlet gives the points, exactly [W]
double add_buoyancy(const Model& model, std::vector<double>& buoyancy, std::vector<Vector3>& force);

} // namespace periporo
