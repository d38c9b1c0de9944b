// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Physical dimensions and quantities written as text, "25 MPa".
#pragma once

#include <string>
#include <string_view>

namespace periporo {

/// The dimension of a quantity as powers of kilogram, metre and second, and of radian, so that an angle is no
/// coefficient.
struct Dimension {
    int mass = 0;
    int length = 0;
    int time = 0;
    int angle = 0;

    friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension length{0, 1, 0};
inline constexpr Dimension area{0, 2, 0};
inline constexpr Dimension volume{0, 3, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension mass{1, 0, 0};
inline constexpr Dimension velocity{0, 1, -1};
inline constexpr Dimension angular_velocity{0, 0, -1, 1}; ///< rad/s
inline constexpr Dimension rate{0, 0, -1};                ///< 1/s
inline constexpr Dimension acceleration{0, 1, -2};
inline constexpr Dimension density{1, -3, 0};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension energy{1, 2, -2};
inline constexpr Dimension pressure{1, -1, -2};
inline constexpr Dimension spring{1, 0, -2};                   ///< N/m
inline constexpr Dimension pressure_per_length{1, -2, -2};     ///< Pa/m, the stiffness of an interface
inline constexpr Dimension dynamic_viscosity{1, -1, -1};       ///< Pa s
inline constexpr Dimension squared_yield_viscosity{3, -3, -5}; ///< Pa^3 s, the viscosity of a yield function in Pa^2
} // namespace dimension

/// The SI unit of a dimension as text, "Pa", "kg/m3", "Pa3 s"; "-" for a pure number.
std::string si_unit(const Dimension& dimension);

/// Units a user may write for a dimension, most usual first, for messages: "Pa, kPa, MPa, GPa".
std::string known_units(const Dimension& dimension);

/// Can a quantity of dimension `given` stand where `wanted` is asked for? They are equal, or an angle is given as a
/// pure number, in radian. A pure number is never given as an angle.
bool fits(const Dimension& given, const Dimension& wanted);

/// A number with its dimension, in SI.
struct Quantity {
    double value = 0.0;
    Dimension dimension;
};

/// Reads "25 MPa", "2.5 mm", "1e3 Pa^3 s", "9.81 m/s2", "30 deg" or a bare number (dimension none).
/// A unit is a product of prefixed symbols with integer powers, divided by `/`. Angles are in radian.
/// @throws std::invalid_argument with the part that was not understood and the nearest known unit.
Quantity parse_quantity(std::string_view text);

} // namespace periporo
