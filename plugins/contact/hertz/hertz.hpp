// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of elastic spheres after Hertz.
#pragma once

#include "../common/damped_contact.hpp"

namespace periporo {

/// F = 4/3 E* R*^(1/2) o^(3/2) under the overlap o = d_c - d, of spheres that have the volumes of the points, R^3 = 3
/// V/(4 pi): between points R* = R_a R_b/(R_a + R_b), at a surface R* = R_a. Both sides have the same E and nu, E* =
/// E/(2 (1 - nu^2)), unless the surface is rigid, E* = E/(1 - nu^2) (Hertz 1882; Johnson, Contact Mechanics, 1985, eq.
/// 4.23).
///
/// Beside it a dashpot 5^(1/2) zeta (m K)^(1/2) o^(1/4) do/dt, with K = F/o^(3/2) and the reduced mass m (Tsuji et al.
/// 1992), which gives a restitution that does not depend on the speed: over y = o^(5/4) in the place of o, speed falls
/// as that of a linear oscillator with the damping ratio zeta, from touch to zero force (Antypov and Elliott 2011, EPL
/// 94, 50004), so zeta(e) is the closed relation of damping_ratio().
///
/// Overlaps deeper than d_c, where a point lies behind the surface, go on along the tangent, so that the stiffness at
/// distance 0, which the stable step is made for, is the largest.
class Hertz : public DampedContact<Hertz> {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{
            Parameter::real("young_modulus", dimension::pressure,
                            "E of the spheres, and of the other side unless it is rigid")
                .above(0.0),
            Parameter::real("poisson_ratio", dimension::none, "nu, likewise").above(-1.0).at_most(0.5)};
        append_records(records);
        return records;
    }

    explicit Hertz(const Parameters& parameters) : DampedContact(parameters)
    {
        const double nu = parameters.real("poisson_ratio");
        plane_strain_modulus_ = parameters.real("young_modulus") / ((1.0 - nu) * (1.0 + nu));
    }

    void scale(const ContactScale& scale) override
    {
        DampedContact::scale(scale);
        partner_ = scale.partner;
    }

    ContactResponse response(const ContactPair& pair) const
    {
        const double overlap = touch() - pair.distance;
        if (overlap <= 0.0)
            return {};
        const double k = 4.0 / 3.0 * effective_modulus(pair) * std::sqrt(effective_radius(pair)); // [N/m^(3/2)]
        const double curved = std::min(overlap, touch());
        const double straight = overlap - curved;
        const double root = std::sqrt(curved);
        const double slope = 1.5 * k * root;
        const double bend = k * curved * root; // the force where the tangent begins
        const double elastic = bend + slope * straight;
        const double energy = 0.4 * bend * curved + (bend + 0.5 * slope * straight) * straight;
        const double dashpot = std::sqrt(5.0) * ratio() * std::sqrt(reduced_mass(pair) * k * root);
        const double force =
            std::max(0.0, elastic + dashpot_in_steps(dashpot, overlap, pair, 0.25) * pair.approach_speed);
        return {force, slope, energy, force - elastic};
    }

private:
    double effective_modulus(const ContactPair& pair) const
    {
        return pair.mass_b > 0.0 ? 0.5 * plane_strain_modulus_ : plane_strain_modulus_;
    }

    double effective_radius(const ContactPair& pair) const
    {
        const double a = radius(pair.volume_a);
        if (partner_ == ContactPartner::surface)
            return a;
        const double b = radius(pair.volume_b);
        return a * b / (a + b);
    }

    static double radius(double volume) { return std::cbrt(0.75 / std::numbers::pi * volume); }

    double plane_strain_modulus_; // E/(1 - nu^2) [Pa]
    ContactPartner partner_ = ContactPartner::points;
};

} // namespace periporo
