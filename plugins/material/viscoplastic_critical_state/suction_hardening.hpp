// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How suction hardens an unsaturated soil: the bonding variable and the shift of the preconsolidation pressure.
#pragma once

#include "periporo/pack.hpp"
#include "periporo/parameters.hpp"

#include <numbers>
#include <optional>
#include <stdexcept>

namespace periporo {

/// The line ln(pc_bar/p_ref) = offset + slope ln(pc/p_ref) that suction draws between the preconsolidation pressure of
/// the soil, pc, and the one its yield surface shows, pc_bar. Dry and saturated soil have exactly offset 0 and slope 1.
template <class Real>
struct SuctionShift {
    Real offset{0.0}; ///< a [-]
    Real slope{1.0};  ///< b [-]
};

/// Bonding of grains by menisci (Gallipoli et al. 2003; Borja 2004):
///     xi = f(s) (1 - S_r),  f(s) = 1 + (s/p_atm)/(10.7 + 2.4 s/p_atm),  c = 1 - c1 (1 - exp(c2 xi)) >= 1
///     b = (lambda - kappa)/(lambda c - kappa),  a = N (c - 1)/(lambda c - kappa)
/// Only the shift of the yield surface is here; that suction also raises the effective stress is the framework's part.
class SuctionHardening {
public:
    /// The pressure at which the specific volume N is given [Pa].
    static constexpr double reference_pressure = 1000.0;

    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("atmospheric_pressure", dimension::pressure, "Pressure that scales suction in bonding")
                    .above(0.0)
                    .by_default(101325.0),
                Parameter::real("bonding_c1", dimension::none,
                                "Bonding coefficient c1; with c2 and the reference specific volume, or not at all")
                    .at_least(0.0)
                    .optional(),
                Parameter::real("bonding_c2", dimension::none, "Bonding exponent c2").at_least(0.0).optional(),
                Parameter::real("reference_specific_volume", dimension::none,
                                "Specific volume N on the virgin line of the saturated soil at 1 kPa")
                    .above(1.0)
                    .optional()};
    }

    /// @throws std::invalid_argument when some, but not all, of c1, c2 and N are given.
    SuctionHardening(const Parameters& parameters, double compression_index, double swelling_index)
        : atmospheric_pressure_(parameters.real("atmospheric_pressure")), compression_index_(compression_index),
          swelling_index_(swelling_index)
    {
        const bool c1 = parameters.has("bonding_c1");
        const bool c2 = parameters.has("bonding_c2");
        const bool volume = parameters.has("reference_specific_volume");
        if (c1 != c2 || c1 != volume)
            throw std::invalid_argument("bonding_c1, bonding_c2 and reference_specific_volume belong together: give "
                                        "all three, or none for a soil that suction does not harden");
        if (c1)
            bonding_ = Bonding{parameters.real("bonding_c1"), parameters.real("bonding_c2"),
                               parameters.real("reference_specific_volume")};
    }

    /// The shift at a suction s [Pa] and a degree of saturation S_r [-]. Dry soil (s = 0 and S_r = 0) has no menisci.
    template <class Real>
    SuctionShift<Real> shift(const Real& suction, const Real& saturation) const
    {
        SuctionShift<Real> result;
        const Mask<Real> dry = suction == Real(0.0) && saturation == Real(0.0);
        if (!bonding_ || all(dry))
            return result;
        const Real relative_suction = suction * (1.0 / atmospheric_pressure_);
        const Real one_bond = 1.0 + relative_suction / (10.7 + 2.4 * relative_suction);
        const Real bonds = select(dry, Real(0.0), Real(one_bond * (1.0 - saturation)));
        const Real excess = bonding_->c1 * (exponential(Real(bonding_->c2 * bonds)) - 1.0); // c - 1
        const Real plastic_index = compression_index_ - swelling_index_;
        const Real reciprocal = 1.0 / (plastic_index + compression_index_ * excess); // of lambda c - kappa
        result.offset = bonding_->reference_specific_volume * excess * reciprocal;
        result.slope = select(excess == Real(0.0), Real(1.0), Real(plastic_index * reciprocal));
        return result;
    }

    /// ln(pc_bar/Pa) of ln(pc/Pa).
    template <class Real>
    static Real shifted(const Real& log_pressure, const SuctionShift<Real>& shift)
    {
        // written so that no shift leaves every bit in place
        return log_pressure + (shift.offset + (shift.slope - 1.0) * (log_pressure - log_reference_pressure));
    }

    /// ln(pc/Pa) of ln(pc_bar/Pa).
    template <class Real>
    static Real unshifted(const Real& log_pressure, const SuctionShift<Real>& shift)
    {
        return log_pressure -
               (shift.offset + (shift.slope - 1.0) * (log_pressure - log_reference_pressure)) / shift.slope;
    }

private:
    static constexpr double log_reference_pressure = 3.0 * std::numbers::ln10;

    struct Bonding {
        double c1;
        double c2;
        double reference_specific_volume;
    };

    double atmospheric_pressure_;
    double compression_index_;
    double swelling_index_;
    std::optional<Bonding> bonding_;
};

} // namespace periporo
