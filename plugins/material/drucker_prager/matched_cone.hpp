// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The circular cone that agrees with the pyramid of Mohr-Coulomb in one kind of test.
#pragma once

#include "../common/frictional_soil.hpp"

#include <cmath>
#include <string>

namespace periporo {

/// Yield function q - (k + M p), plastic potential q - M_psi p.
struct MatchedCone {
    double slope;     ///< M [-]
    double strength;  ///< k [Pa]
    double dilatancy; ///< M_psi [-]

    /// M = F sin(phi), k = F c cos(phi) and M_psi = F_psi sin(psi), with F as below and F_psi that F for phi = psi:
    ///     compression   F = 6/(3 - sin phi)     strength and dilation of triaxial compression
    ///     extension     F = 6/(3 + sin phi)     of triaxial extension
    ///     plane_strain  F = 3 sqrt(3 + sin^2 psi)/(3 + sin phi sin psi)
    /// The first two pass through the outer and the inner edges of the pyramid (Chen and Mizuno 1990). The
    /// third has the strength and dilation of the pyramid where flow in plane strain is steady: there the plastic
    /// strain out of plane is zero, so the deviator s_z = -(2/9) q M_psi, which leaves in the plane the radius q/sqrt(3
    /// + sin^2 psi) of Mohr's circle and the pressure p - q M_psi/9, to be put into radius = pressure sin(phi)
    /// + c cos(phi). For psi = phi it is the cone inscribed in the pyramid (Drucker and Prager 1952).
    /// @param match "compression", "extension" or "plane_strain"
    MatchedCone(const std::string& match, const FrictionalSoil& soil)
    {
        const double sin_friction = std::sin(soil.friction_angle);
        const double sin_dilatancy = std::sin(soil.dilatancy_angle);
        const double ratio = factor(match, sin_friction, sin_dilatancy);
        slope = ratio * sin_friction;
        strength = ratio * soil.cohesion * std::cos(soil.friction_angle);
        dilatancy = factor(match, sin_dilatancy, sin_dilatancy) * sin_dilatancy;
    }

private:
    static double factor(const std::string& match, double sin_friction, double sin_dilatancy)
    {
        if (match == "compression")
            return 6.0 / (3.0 - sin_friction);
        if (match == "extension")
            return 6.0 / (3.0 + sin_friction);
        return 3.0 * std::sqrt(3.0 + sin_dilatancy * sin_dilatancy) / (3.0 + sin_friction * sin_dilatancy);
    }
};

} // namespace periporo
