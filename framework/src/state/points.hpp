// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The material points of all bodies, as a structure of arrays.
#pragma once

#include "io/archive.hpp"
#include "periporo/tensor.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace periporo {

/// The volume of a point, its weight in all sums, does not grow beyond this multiple of its initial one. A body that
/// opens further has a gap between its grains, and a gap is not soil: it has no stiffness and no weight in a sum. J
/// itself goes on, so that the gap must close before the volume shrinks. Without the bound the stiffness of single
/// grains of a thin rim grows with J, and the stable step falls. Soil of porosity 0.2 that opens by a quarter has one
/// of 0.36, that of loose sand.
inline constexpr double largest_volume_ratio = 1.25;

/// V/V0 of a point: J, but never less than what its grains fill, 1 - phi0, and never more than largest_volume_ratio. A
/// material without pores (phi0 = 0) has no lower bound: its compression is that of the grains.
/// @param jacobian J [-]
/// @param porosity phi0 of the body [-]
inline double volume_ratio(double jacobian, double porosity)
{
    const double grains = porosity > 0.0 ? 1.0 - porosity : 0.0;
    return std::clamp(jacobian, grains, largest_volume_ratio);
}

/// Suction s >= 0 of a pore pressure, compression positive [Pa].
inline double suction_of(double pore_pressure)
{
    return std::max(0.0, -pore_pressure);
}

struct Points {
    std::vector<Vector3> position;         ///< x [m]
    std::vector<Vector3> velocity;         ///< v, at full steps [m/s]
    std::vector<Vector3> force;            ///< total force at the last evaluation [N]
    std::vector<Vector3> initial_position; ///< X at the start of the run [m]
    std::vector<double> volume;            ///< current V = V0 volume_ratio(J, phi0) [m3]
    std::vector<double> initial_volume;    ///< V0 [m3]
    std::vector<double> jacobian;          ///< J, from J' = J tr L and the occupied volume [-]
    std::vector<double> mass;              ///< of grains and water; changes with the water only [kg]
    std::vector<double> pore_pressure;     ///< p, compression positive; suction is -p above the water table [Pa]
    std::vector<double> saturation;        ///< S_r [-]
    std::vector<std::uint32_t> body;       ///< index of the body
    std::vector<std::int64_t> id;          ///< number given by the geometry, body by body

    /// What a checkpoint keeps: the other members follow from the case.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("position", self.position);
        visit("velocity", self.velocity);
        visit("force", self.force);
        visit("volume", self.volume);
        visit("jacobian", self.jacobian);
        visit("mass", self.mass);
        visit("pore_pressure", self.pore_pressure);
        visit("saturation", self.saturation);
    }

    std::size_t size() const { return position.size(); }
    double suction(std::size_t point) const { return suction_of(pore_pressure[point]); } ///< [Pa]

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
        pore_pressure.resize(n);
        saturation.resize(n);
        body.resize(n);
        id.resize(n);
    }
};

/// How the water of points and bodies changes in a stage.
struct WaterCourse {
    // of each point out of standing water, before and after the changes of the stage
    std::vector<double> pressure_before; ///< signed as Points::pore_pressure [Pa]
    std::vector<double> saturation_before;
    std::vector<double> pressure_after;
    std::vector<double> saturation_after;
    /// Largest share of the cell of a point that was under water, since the water of its body last changed [-].
    std::vector<double> soaked;
    // of each body
    std::vector<double> level_before; ///< of standing water, height along -gravity; minus infinity: none [m]
    std::vector<double> level_after;
    std::vector<double> lowest; ///< height of the bottom of the body when its change began [m]
    std::vector<double> done;   ///< share of the change that is done [-]

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("pressure_before", self.pressure_before);
        visit("saturation_before", self.saturation_before);
        visit("pressure_after", self.pressure_after);
        visit("saturation_after", self.saturation_after);
        visit("soaked", self.soaked);
        visit("level_before", any_reals(self.level_before));
        visit("level_after", any_reals(self.level_after));
        visit("lowest", any_reals(self.lowest));
        visit("done", self.done);
    }
};

} // namespace periporo
