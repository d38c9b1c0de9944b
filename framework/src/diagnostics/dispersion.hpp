// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Plane elastic waves on a periodic lattice: how fast the operator lets them run.
#pragma once

#include "operator/force_state.hpp"
#include "periporo/material.hpp"

#include <array>
#include <memory>
#include <vector>

namespace periporo {

/// A cubic lattice that continues for ever.
struct LatticeMedium {
    std::shared_ptr<const Material> material;
    double density = 0.0; ///< [kg/m3]
    double spacing = 0.0; ///< dx [m]
    double horizon = 0.0; ///< delta [m]
};

/// `cells` cells in each direction, periodic; a direction of one cell carries no variation.
Model periodic_lattice(const LatticeMedium& medium, const std::array<int, 3>& cells, const ForceState& force_state);

/// Angular frequency [rad/s] of the mode e cos(k.x) on a periodic lattice, from its Rayleigh quotient: exact when the
/// mode is an eigenvector, as it is for waves along axes and diagonals polarised along or across them, and at all
/// corners of the zone. A negative quotient gives -sqrt(|omega^2|): the mode would grow.
/// @param wave_vector k [1/m], an integer multiple of 2 pi/period in each direction
double mode_frequency(Model& lattice, const ForceState& force_state, const Vector3& wave_vector,
                      const Vector3& polarisation);

enum class WaveDirection { axis, face_diagonal, space_diagonal }; ///< [100], [110], [111]
enum class WaveType { pressure, shear };

/// A point of a dispersion curve.
struct PhaseSpeed {
    WaveDirection direction;
    WaveType type;
    double wave_number;    ///< |k| dx [-]
    double relative_speed; ///< omega/(|k| c) with c = sqrt((K + 4G/3)/rho) or sqrt(G/rho) [-]
};

/// Curves along the three directions for both types of waves, `cells` points each up to the corner of the zone that
/// lies in the direction: components of k dx from pi/cells to pi.
std::vector<PhaseSpeed> dispersion(const LatticeMedium& medium, const ForceState& force_state, int cells);

} // namespace periporo
