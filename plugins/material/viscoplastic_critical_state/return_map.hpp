// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Backward-Euler return of a trial stress to the (overstressed) modified Cam-clay ellipse, on packs.
#pragma once

#include "periporo/pack.hpp"

namespace periporo {

/// What is the same for every point. With u = p - (pc_bar - p_s)/2 and a = (pc_bar + p_s)/2 the yield function is
/// f = q^2/M^2 + u^2 - a^2.
struct ReturnConstants {
    double bulk_modulus;     ///< K [Pa]
    double shear_relaxation; ///< 6 G/M^2 [Pa], as in q = q_trial/(1 + 6 G/M^2 dl)
    double tensile_strength; ///< p_s [Pa]
    double floor;            ///< pc_min [Pa], the least pc_bar in the yield function
    double log_floor;        ///< ln(pc_min/Pa)
};

/// A trial state.
template <class Real>
struct ReturnInput {
    Real mean_stress;           ///< trial p, compression positive [Pa]
    Real squared_shear;         ///< trial q^2/M^2 [Pa2]
    Real log_preconsolidation;  ///< ln(pc_bar/Pa) at the start of the step, without the floor
    Real preconsolidation;      ///< its exponential [Pa]
    Real hardening;             ///< h = d ln pc_bar/dx > 0, x the plastic volumetric strain, compression positive [-]
    double viscosity_over_step; ///< eta/dt [Pa3]
};

/// Solves R(dl) = q^2/M^2 + u^2 - a^2 - (eta/dt) dl = 0 with q = q_trial/(1 + 6 G/M^2 dl) for the multiplier dl, and
/// for the plastic volumetric strain x of the step the inner equation
///     g(x) = x (1 + 2 K dl) - dl (2 p_trial + p_s - pc_bar(x)) = 0,   pc_bar = max(pc_min, exp(ln pc_bar_n + h x)).
///
/// Outer: with pc_bar fixed, u = u_trial/(1 + 2 K dl), and R = 0 is the secular equation of the closest point on an
/// ellipse. As for trust regions (More and Sorensen 1983) Newton's method is applied to D^-1/2 - Y^-1/2 with
/// D = q^2/M^2 + u^2 and Y = a^2 + (eta/dt) dl, which is almost linear in dl however far away the trial stress is.
/// R > 0 at dl = 0 and R < 0 for large dl; a step that leaves the bracket is replaced by doubling or bisection.
/// Inner: g increases and is convex, so Newton's method cannot diverge; its steps towards larger pc_bar are kept short
/// so that no exponential overflows. Each lane stops for itself: its result does not depend on its neighbours.
template <class Real>
class ReturnMap {
public:
    /// The state at the end of the step; in lanes that do not yield, no plastic flow and no meaning of `mean_stress`.
    Real multiplier{0.0};        ///< dl [1/Pa]
    Real volumetric_strain{0.0}; ///< x [-]
    Real mean_stress{0.0};       ///< p [Pa]
    Real shear_factor{1.0};      ///< q/q_trial [-]

    /// @param trial must live as long as the map
    ReturnMap(const ReturnConstants& constants, const ReturnInput<Real>& trial)
        : c_(constants), trial_(trial), drive_(2.0 * trial.mean_stress + constants.tensile_strength)
    {
        set_preconsolidation(trial.preconsolidation);
    }

    /// Solves in the lanes that yield, where R(0) > 0. Returns the lanes that did not converge.
    Mask<Real> solve(const Mask<Real>& yields)
    {
        Mask<Real> open = yields;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            const Mask<Real> last = outer_step(open);
            const Mask<Real> found = inner_solve(open);
            open = open && !(last && found);
            if (!any(open))
                break;
        }
        const Real u = distance_from_centre();
        volumetric_strain = 2.0 * multiplier * u;
        mean_stress = u + 0.5 * (preconsolidation_ - c_.tensile_strength);
        return open;
    }

private:
    static constexpr int most_iterations = 200;
    /// Newton's last step starts within this distance of the root, relative to a^2, and lands within 1e-13 to 1e-11 of
    /// it for strain steps up to 0.01, within 1e-9 for any. Of a step of a running simulation, 1e-4 of strain, the
    /// third starts so near: it lands within 1e-14.
    static constexpr double near_surface = 3e-6;
    /// The same for ln pc_bar (absolute, and relative where it is large), whose last correction is added to second
    /// order, without another exponential.
    static constexpr double near_strain = 1e-8;
    static constexpr double longest_hardening = 2.0; // of ln pc_bar in one inner step
    static constexpr double unbounded = 1e300;

    Real distance_from_centre() const
    {
        return (trial_.mean_stress - 0.5 * (preconsolidation_ - c_.tensile_strength)) * volume_factor_;
    }

    void set_preconsolidation(const Real& unfloored)
    {
        unfloored_ = unfloored;
        preconsolidation_ = maximum(unfloored, Real(c_.floor));
        stiffening_ = select(unfloored > Real(c_.floor), Real(trial_.hardening * unfloored), Real(0.0));
    }

    // The two halves of an iteration are inlined by force so that the state stays in registers.

    /// Moves dl in the open lanes; returns the lanes in which this was the last move.
    [[gnu::always_inline]] Mask<Real> outer_step(const Mask<Real>& open)
    {
        const Real u = distance_from_centre();
        const Real a = 0.5 * (preconsolidation_ + c_.tensile_strength);
        const Real shear = trial_.squared_shear * shear_factor * shear_factor;
        const Real stress = shear + u * u;
        const Real strength = a * a + trial_.viscosity_over_step * multiplier;
        // -dD/d(dl) and dY/d(dl) along the solution of the inner equation, where dx/d(dl) = 2 u/(dg/dx)
        const Real loss = 2.0 * (shear * (c_.shear_relaxation * shear_factor) +
                                 u * u * ((2.0 * c_.bulk_modulus + stiffening_) * coupled_factor_));
        const Real gain = 2.0 * a * stiffening_ * u * coupled_factor_ + trial_.viscosity_over_step;
        // Newton's step 2 (r - 1) D/(loss + r^3 gain), r = sqrt(D/Y), times Y^2/Y^2: one root and one division
        const Real root = square_root(stress * strength);
        const Real squared_strength = strength * strength;
        const Real fixed = loss * squared_strength;
        // softening can turn the tangent of a distant point the wrong way: it may lengthen a step fourfold, not more
        const Real slope = maximum(Real(fixed + root * stress * gain), Real(0.25 * fixed));
        const Real excess = stress - strength; // R
        Real next = multiplier + 2.0 * excess * stress * squared_strength / ((root + strength) * slope);

        const Mask<Real> outside = excess > Real(0.0);
        lower_ = select(outside, multiplier, lower_);
        upper_ = select(outside, upper_, multiplier);
        const Mask<Real> inside = next >= lower_ && next <= upper_;
        const Mask<Real> near = absolute(excess) <= near_surface * strength;
        const Mask<Real> exhausted = upper_ - lower_ <= 1e-15 * upper_;
        if (!all(inside)) {
            const Real doubled = 2.0 * multiplier + 1.0 / c_.shear_relaxation;
            const Real halved = 0.5 * (lower_ + upper_);
            next = select(inside, next, select(upper_ < Real(unbounded), halved, doubled));
        }
        multiplier = select(open, next, multiplier);
        return (near && inside) || exhausted;
    }

    /// Finds x and pc_bar at the present dl in the open lanes; returns the lanes in which they are found.
    [[gnu::always_inline]] Mask<Real> inner_solve(const Mask<Real>& open)
    {
        const Real volume = 1.0 + 2.0 * c_.bulk_modulus * multiplier;
        const Real deviatoric = 1.0 + c_.shear_relaxation * multiplier;
        const Real coupled = volume + multiplier * stiffening_; // dg/dx
        const Real reciprocal = 1.0 / (volume * deviatoric * coupled);
        volume_factor_ = select(open, Real(reciprocal * (deviatoric * coupled)), volume_factor_);
        shear_factor = select(open, Real(reciprocal * (volume * coupled)), shear_factor);
        coupled_factor_ = reciprocal * (volume * deviatoric);

        // from the last x without an exponential; then one confirms it with the same tangent, as a rule
        Real correction = (multiplier * (drive_ - preconsolidation_) - strain_ * volume) * coupled_factor_;
        strain_ = select(open, strain_ + shortened(correction), strain_);
        Mask<Real> searching = open;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            const Real unfloored = hardened();
            const Real pressure = maximum(unfloored, Real(c_.floor));
            const Real residual = multiplier * (drive_ - pressure) - strain_ * volume;
            correction = residual * coupled_factor_;
            const Real change = trial_.hardening * correction;
            const Real round_off = near_strain + near_strain * absolute(Real(trial_.hardening * strain_));
            const Mask<Real> settled = searching && absolute(change) <= round_off;
            strain_ = select(settled, Real(strain_ + correction), strain_);
            set_preconsolidation(select(settled, Real(unfloored * (1.0 + change * (1.0 + 0.5 * change))),
                                        select(searching, unfloored, unfloored_)));
            searching = searching && !settled;
            if (!any(searching))
                break;
            const Real tangent = 1.0 / (volume + multiplier * stiffening_);
            coupled_factor_ = select(searching, tangent, coupled_factor_);
            strain_ = select(searching, strain_ + shortened(Real(residual * tangent)), strain_);
        }
        return !searching;
    }

    /// exp(ln pc_bar_n + h x). A step that hardens by less than 3 per cent, as most do, needs only a few terms of the
    /// series; the first left out is (1/32)^8/8!, below round-off.
    Real hardened() const
    {
        const Real y = trial_.hardening * strain_;
        const Real y2 = y * y;
        const Real series = (1.0 + y) + y2 * ((0.5 + y * (1.0 / 6.0)) + y2 * ((1.0 / 24.0 + y * (1.0 / 120.0)) +
                                                                              y2 * (1.0 / 720.0 + y * (1.0 / 5040.0))));
        const Real near_start = trial_.preconsolidation * series;
        const Mask<Real> small = absolute(y) <= Real(1.0 / 32.0);
        if (all(small))
            return near_start;
        return select(small, near_start, exponential(Real(trial_.log_preconsolidation + y)));
    }

    /// A step in x from which ln pc_bar, counted from the floor or above, grows by `longest_hardening` at most.
    Real shortened(const Real& correction) const
    {
        const Real growth = trial_.hardening * correction;
        if (!any(growth > Real(longest_hardening)))
            return correction;
        const Real exponent = trial_.log_preconsolidation + trial_.hardening * strain_;
        const Real room = longest_hardening + maximum(Real(c_.log_floor - exponent), Real(0.0));
        return select(growth > room, Real(room / trial_.hardening), correction);
    }

    ReturnConstants c_;
    const ReturnInput<Real>& trial_; // a copy would be a call of memcpy
    Real drive_;                     // 2 p_trial + p_s
    Real strain_{0.0};               // x
    Real unfloored_{0.0};            // exp(ln pc_bar_n + h x)
    Real preconsolidation_{0.0};     // pc_bar
    Real stiffening_{0.0};           // d pc_bar/dx
    Real volume_factor_{1.0};        // 1/(1 + 2 K dl)
    Real coupled_factor_{1.0};       // 1/(dg/dx)
    Real lower_{0.0};                // R > 0 here
    Real upper_{unbounded};          // R <= 0 here
};

} // namespace periporo
