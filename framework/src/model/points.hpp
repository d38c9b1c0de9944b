// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The material points of all bodies, as a structure of arrays.
#pragma once

#include "periporo/tensor.hpp"

#include <cstdint>
#include <vector>

namespace periporo {

/// A point's volume, its weight in all sums, does not grow beyond this multiple of its initial one; what opens further
/// is a gap between grains and not soil. J itself goes on, so that the gap must close before the volume shrinks.
/// Without the bound single grains of a thin rim reached J = 7, their stiffness grew with it, and the stable step fell.
/// Soil of porosity 0.2 that opens by a quarter has one of 0.36, that of loose sand. With a bound of 2 the deposit of
/// the quickstart is the same and takes an eighth more steps.
inline constexpr double largest_volume_ratio = 1.25;

struct Points {
    std::vector<Vector3> position;         ///< x [m]
    std::vector<Vector3> velocity;         ///< v, at full steps [m/s]
    std::vector<Vector3> force;            ///< total force at the last evaluation [N]
    std::vector<Vector3> initial_position; ///< X at the start of the run [m]
    std::vector<double> volume;            ///< current V = V0 min(J, largest_volume_ratio) [m3]
    std::vector<double> initial_volume;    ///< V0 [m3]
    std::vector<double> jacobian;          ///< J, from J' = J tr L [-]
    std::vector<double> mass;              ///< of grains and water; changes with the water only [kg]
    std::vector<double> suction;           ///< s >= 0 [Pa]
    std::vector<double> saturation;        ///< S_r [-]
    std::vector<std::uint32_t> body;       ///< index of the body
    std::vector<std::int64_t> id;          ///< number given by the geometry, body by body

    std::size_t size() const { return position.size(); }

    void resize(std::size_t n)
    {
        position.resize(n, Vector3::Zero());
        velocity.resize(n, Vector3::Zero());
        force.resize(n, Vector3::Zero());
        initial_position.resize(n, Vector3::Zero());
        volume.resize(n);
        initial_volume.resize(n);
        jacobian.resize(n, 1.0);
        mass.resize(n);
        suction.resize(n);
        saturation.resize(n);
        body.resize(n);
        id.resize(n);
    }
};

/// Suction [Pa] and saturation [-] of each point before and after the changes of a stage.
struct WaterCourse {
    std::vector<double> suction_before, saturation_before, suction_after, saturation_after;
};

} // namespace periporo
