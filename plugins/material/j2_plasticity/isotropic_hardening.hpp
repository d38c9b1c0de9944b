// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The yield stress as a function of plastic strain, and the plastic strain that brings a trial stress back to it.
#pragma once

#include "periporo/pack.hpp"
#include "periporo/parameters.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace periporo {

/// Linear hardening plus saturation (Voce 1948), in the equivalent plastic strain e >= 0:
///     sigma_y(e) = yield_stress + H e + (saturation_stress - yield_stress)(1 - exp(-saturation_rate e))
/// A saturation stress below the yield stress softens.
class IsotropicHardening {
public:
    static std::vector<Parameter> parameters()
    {
        return {
            Parameter::real("yield_stress", dimension::pressure, "Yield stress in uniaxial tension or compression")
                .at_least(0.0),
            Parameter::real("hardening_modulus", dimension::pressure,
                            "Linear hardening H, yield stress per equivalent plastic strain")
                .at_least(0.0)
                .by_default(0.0),
            Parameter::real("saturation_stress", dimension::pressure,
                            "What the yield stress grows or softens to, linear hardening apart; with the rate, or not "
                            "at all")
                .at_least(0.0)
                .optional(),
            Parameter::real("saturation_rate", dimension::none,
                            "1 over the plastic strain that covers 63 per cent of the way")
                .above(0.0)
                .optional()};
    }

    /// @param shear_modulus G [Pa]
    /// @throws std::invalid_argument when only one of saturation stress and rate is given, or when the material softens
    /// faster than it unloads, 3 G per plastic strain: a point would then snap back at held strain.
    IsotropicHardening(const Parameters& parameters, double shear_modulus)
        : elastic_slope_(3.0 * shear_modulus), yield_stress_(parameters.real("yield_stress")),
          modulus_(parameters.real("hardening_modulus"))
    {
        const bool stress = parameters.has("saturation_stress");
        if (stress != parameters.has("saturation_rate"))
            throw std::invalid_argument("saturation_stress and saturation_rate belong together: give both, or none for "
                                        "linear hardening alone");
        if (!stress)
            return;
        saturation_ = parameters.real("saturation_stress") - yield_stress_;
        rate_ = parameters.real("saturation_rate");
        if (!(elastic_slope_ + modulus_ + saturation_ * rate_ > 0.0))
            throw std::invalid_argument("(yield_stress - saturation_stress) saturation_rate, the initial softening, "
                                        "must be less than 3 shear_modulus + hardening_modulus: lower the rate");
    }

    /// sigma_y(e) [Pa] at e >= 0 [-].
    template <class Real>
    Real yield_stress(const Real& strain) const
    {
        Real stress = yield_stress_ + modulus_ * strain;
        if (saturation_ != 0.0)
            stress += saturation_ * (1.0 - exponential(Real(-rate_ * strain)));
        return stress;
    }

    /// A solution by plastic_increment() and the lanes that have none.
    template <class Real>
    struct Increment {
        Real strain;
        Mask<Real> unsolved;
    };

    /// In the lanes of `yields` the root d > 0 of
    ///     R(d) = share (q_trial - sigma_y(e + d)) - 3 G d = 0
    /// @param excess q_trial - sigma_y(e) > 0 [Pa]
    /// @param strain e [-]
    /// @param share of the overstress that flow takes in the step, 0 to 1
    ///
    /// Without saturation R is linear. Else R falls all the way from R(0) > 0 to below zero at the end of the bracket.
    /// Hardening makes R convex, and Newton's method from 0 climbs to the root without passing it; softening makes it
    /// concave, and Newton's method, cut back to the bracket, comes down to the root from the right. Each lane stops
    /// for itself: its result does not depend on its neighbours.
    template <class Real>
    Increment<Real> plastic_increment(const Real& excess, const Real& strain, double share,
                                      const Mask<Real>& yields) const
    {
        if (saturation_ == 0.0)
            return {excess * (share / (elastic_slope_ + share * modulus_)), Mask<Real>(false)};
        const Real left = saturation_ * exponential(Real(-rate_ * strain)); // of the saturation, negative if it softens
        const Real end = (share / elastic_slope_) * (excess + maximum(Real(-left), Real(0.0)));
        // the terms of R are rounded to some units in the last place of these
        const Real round_off = 1e-14 * share * (excess + absolute(left));
        Real increment{0.0};
        Mask<Real> open = yields;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            const Real fading = left * exponential(Real(-rate_ * increment));
            const Real residual =
                share * (excess - modulus_ * increment - (left - fading)) - elastic_slope_ * increment;
            open = open && absolute(residual) > round_off;
            if (!any(open))
                break;
            const Real slope = elastic_slope_ + share * (modulus_ + rate_ * fading);
            const Real next = minimum(Real(increment + residual / slope), end);
            increment = select(open, next, increment);
        }
        return {increment, open};
    }

private:
    /// Climbing, every iteration lets the saturation fade by a factor e or more. Coming down to a root that is nearly
    /// double, every iteration halves the distance. Either takes some 40 from one end of the numbers to the other.
    static constexpr int most_iterations = 100;

    double elastic_slope_; // 3 G
    double yield_stress_;
    double modulus_;          // H
    double saturation_ = 0.0; // saturation stress less yield stress
    double rate_ = 0.0;
};

} // namespace periporo
