// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of contact plugins. A plugin says how strong the normal reaction is; the framework finds the contacts,
// applies Newton's third law, regularised Coulomb friction, the stable step and the energy ledger.
#pragma once

#include "periporo/plugin.hpp"
#include "periporo/vector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace periporo {

/// One contact between two points, or between a point and a surface, as the law sees it.
struct ContactPair {
    double distance;       ///< between the points, or signed above the surface [m]
    double approach_speed; ///< -d(distance)/dt [m/s]
    double volume_a;       ///< of the point [m3]
    double volume_b;       ///< of the other point, or what moves with a deformable surface; 0 for a rigid one
    double mass_a;         ///< [kg]
    double mass_b;         ///< 0 for a rigid surface
    /// Leapfrog step in which the force acts while `approach_speed` is that of the middle of the last one; 0 when the
    /// speed is that of the instant [s]
    double time_step = 0.0;
};

/// The mass that moves against the spring of a contact: m_a m_b/(m_a + m_b), or m_a at a rigid surface [kg].
inline double reduced_mass(const ContactPair& pair)
{
    return pair.mass_b > 0.0 ? pair.mass_a * pair.mass_b / (pair.mass_a + pair.mass_b) : pair.mass_a;
}

/// What the law answers.
struct ContactResponse {
    double force = 0.0;         ///< normal force, positive when it pushes apart [N]; friction needs a positive one
    double stiffness = 0.0;     ///< -d(force)/d(distance), for the stable step [N/m]
    double energy = 0.0;        ///< stored, recoverable [J]
    double damping_force = 0.0; ///< the part of `force` that does not come from stored energy [N]
};

/// Damping ratio zeta of a spring and dashpot that never pulls and whose collisions have the coefficient of restitution
/// e. A pair parts when its force is gone, omega t = 2 acos(zeta)/(1 - zeta^2)^(1/2) after it met, at e = exp(-zeta
/// omega t) of its speed; beyond zeta = 1 with acosh(zeta)/(zeta^2 - 1)^(1/2) (Schwager and Poeschel 2007, Granular
/// Matter 9, 465-469). 0 for e = 1. No dashpot stops a collision dead: the most is zeta = 2, which leaves e = 0.048.
inline double damping_ratio(double restitution)
{
    if (restitution >= 1.0)
        return 0.0;
    const auto logarithm_lost = [](double zeta) {
        const double b = std::sqrt(std::abs(1.0 - zeta) * (1.0 + zeta));
        const double angle = zeta < 1.0 ? std::acos(zeta) : std::acosh(zeta);
        return b > 0.0 ? 2.0 * zeta * angle / b : 2.0;
    };
    const double wanted = -std::log(std::max(restitution, 0.0));
    double low = 0.0;
    double high = 2.0;
    for (int halving = 0; halving < 60; ++halving) { // the loss grows with zeta
        const double middle = 0.5 * (low + high);
        (logarithm_lost(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// The dashpot c' that gives an oscillator in leapfrog steps the damping ratio, and so the restitution, of a dashpot c
/// in continuous time; c itself without a step [N s/m]. The steps take the force k x + c' v with v of the last
/// mid-step, and
///
///     x(n+1) - (2 - k dt^2/m - c' dt/m) x(n) + (1 - c' dt/m) x(n-1) = 0
///
/// has the solution of a damped oscillation with the phase theta a step, where 1 - c' dt/m = exp(-2 b), b = zeta theta.
/// From the middle coefficient k dt^2/m = exp(-b) theta^2 up to a relative theta^2/12, so that b solves b = beta
/// exp(b/2) with beta = c dt/(2 m), to third order b = beta + beta^2/2 + 3 beta^3/8. A contact at rest keeps k x.
///
/// A pair that touched within the last step, with the overlap o now, has not had its dashpot yet: the impulse of c from
/// the first touch on is the integral of c do, c o/(power + 1), and that of the next half step makes a factor 1/(1 +
/// b).
/// @param damping c at the present overlap [N s/m]
/// @param power of the overlap that c grows with [-]
inline double dashpot_in_steps(double damping, double overlap, const ContactPair& pair, double power = 0.0)
{
    if (!(pair.time_step > 0.0))
        return damping;
    const double mass = reduced_mass(pair);
    const double beta = 0.5 * damping * pair.time_step / mass;
    const double b = beta * (1.0 + beta * (0.5 + 0.375 * beta));
    const double travelled = pair.approach_speed * pair.time_step;
    constexpr double rounding = 1e-6; // a touch at the end of the step before is one of this step
    const bool touched_now = travelled > 0.0 && overlap <= (1.0 + rounding) * travelled;
    const double left = touched_now ? std::max(0.0, 1.0 - 2.0 * b * overlap / ((power + 1.0) * travelled)) / (1.0 + b)
                                    : std::exp(-2.0 * b); // of the speed after a step
    return (1.0 - left) * mass / pair.time_step;
}

/// A linear spring k under an overlap, with a dashpot 2 zeta (k m)^(1/2) beside it; it never pulls, so that a strongly
/// damped pair parts before its overlap is gone. Nothing without overlap.
inline ContactResponse spring_and_dashpot(double overlap, double stiffness, double ratio, const ContactPair& pair)
{
    if (overlap <= 0.0)
        return {};
    const double spring = stiffness * overlap;
    const double dashpot = dashpot_in_steps(2.0 * ratio * std::sqrt(stiffness * reduced_mass(pair)), overlap, pair);
    const double force = std::max(0.0, spring + dashpot * pair.approach_speed);
    return {force, stiffness, 0.5 * spring * overlap, force - spring};
}

/// A rigid surface that a contact plugin brings along.
class RigidSurface {
public:
    virtual ~RigidSurface() = default;
    /// Signed distance of a point, positive on the free side [m]; `normal` becomes the unit normal to the free side.
    virtual double distance(const Vector3& position, Vector3& normal) const = 0;
};

/// What is met by the points of a body.
enum class ContactPartner {
    points, ///< points of another body, or grains of the same: `distance` is that between two points
    surface ///< a rigid obstacle, or the smoothed surface of a deformable body: `distance` is signed, above the surface
};

/// What a contact law may scale with.
struct ContactScale {
    double spacing = 0.0; ///< dx [m]
    double horizon = 0.0; ///< delta [m]
    ContactPartner partner = ContactPartner::points;
};

class Contact {
public:
    virtual ~Contact() = default;

    /// Called once before any other call.
    virtual void scale(const ContactScale& scale) = 0;
    /// No reaction at or beyond this distance [m].
    virtual double cutoff() const = 0;
    /// Coulomb coefficient of friction [-].
    virtual double friction() const = 0;
    /// Evaluates a block of contacts; both spans have the same length.
    virtual void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const = 0;
    /// The rigid surface the points of the bodies touch, or null for a law between points.
    virtual const RigidSurface* surface() const { return nullptr; }
};

} // namespace periporo
