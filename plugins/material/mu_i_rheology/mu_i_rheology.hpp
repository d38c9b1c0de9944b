// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Dense granular flow by the mu(I) law with elasticity, and the memory of how far the mass has come apart.
#pragma once

#include "../common/trial_stress.hpp"
#include "periporo/material_law.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace periporo {

/// With compression-positive p = -tr(sigma')/3, tau = sqrt(s:s/2) of the deviator s, and the plastic shear rate
/// gamma_dot = sqrt(2)|d eps_p/dt| (that of simple shear, dv_x/dy), flow is along s, keeps the volume, and obeys
///     tau = mu(I) p,  mu(I) = mu_s + (mu_2 - mu_s)/(1 + I_0/I),  I = gamma_dot d/sqrt(p/rho_s)
/// (Jop, Forterre and Pouliquen 2006); below mu_s p the material is elastic with constant moduli (Dunatunga and Kamrin
/// 2015). It bears no tension: volumetric strain beyond p = 0 opens it, and it carries nothing until the opening has
/// closed again. The update is backward Euler, solved in closed form; it never fails for finite input.
class MuIRheology {
public:
    static constexpr std::size_t state_count = 2;
    enum StateIndex : std::size_t { opening = 0, shear_strain = 1 };

    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("bulk_modulus", dimension::pressure, "Elastic bulk modulus K").above(0.0),
                Parameter::real("shear_modulus", dimension::pressure, "Elastic shear modulus G").above(0.0),
                Parameter::real("static_friction", dimension::none, "Friction mu_s = tau/p of the slowest flow")
                    .at_least(0.0),
                Parameter::real("limiting_friction", dimension::none,
                                "Friction mu_2 of the fastest flow, not less than the static one")
                    .at_least(0.0),
                Parameter::real("reference_inertial_number", dimension::none,
                                "Inertial number I_0 at which friction is half way between the two")
                    .above(0.0),
                Parameter::real("grain_diameter", dimension::length, "Mean diameter d of the grains").above(0.0),
                Parameter::real("solid_density", dimension::density, "Density rho_s of the solid of the grains")
                    .above(0.0)};
    }

    static std::vector<StateVariable> state_variables()
    {
        return {{"opening", "-", "Volumetric strain by which the mass has come apart, to be closed before it carries",
                 0.0, false, true},
                {"equivalent_plastic_shear_strain", "-", "Accumulated sqrt(2/3)|dev eps_p|", 0.0, true}};
    }

    /// @throws std::invalid_argument when mu_2 is less than mu_s.
    explicit MuIRheology(const Parameters& parameters)
        : bulk_modulus_(parameters.real("bulk_modulus")), shear_modulus_(parameters.real("shear_modulus")),
          static_friction_(parameters.real("static_friction")), friction_range_(friction_range(parameters)),
          fluidity_(parameters.real("reference_inertial_number") /
                    (parameters.real("grain_diameter") * std::sqrt(parameters.real("solid_density"))))
    {
    }

    double bulk_modulus() const { return bulk_modulus_; }
    double shear_modulus() const { return shear_modulus_; }

    template <class Real>
    LawResult<Real, state_count> update(const LawInput<Real, state_count>& old) const
    {
        LawResult<Real, state_count> result;
        const SymmetricTensor<Real> trial =
            elastic_stress(old.stress, old.strain_increment, bulk_modulus_, shear_modulus_);
        result.stress = trial;
        result.state = old.state;
        const Mask<Real> usable_lanes = usable(trial, old.state, old.time_step);
        if (!all(usable_lanes)) {
            result.failed = !usable_lanes;
            result.reason = not_finite;
        }

        const Real trial_pressure = trace(trial) * (-1.0 / 3.0);
        // where the bonds of a point share one opening, their mean change can leave less than none
        const Real contact = trial_pressure - bulk_modulus_ * maximum(old.state[opening], Real(0.0));
        const Real pressure = maximum(contact, Real(0.0));
        const SymmetricTensor<Real> deviatoric = deviator(trial);
        const Real trial_shear = square_root(Real(0.5 * double_contraction(deviatoric, deviatoric)));
        const Real resistance = static_friction_ * pressure;
        // a stress on the surface to round-off is elastic
        const Mask<Real> flows = usable_lanes && trial_shear - resistance > 1e-12 * resistance;
        const Mask<Real> returns = flows || (usable_lanes && pressure != trial_pressure);
        if (!any(returns))
            return result;

        const Real shear = select(
            flows, Real(resistance + overstress(Real(trial_shear - resistance), pressure, old.time_step)), trial_shear);
        const Real factor = select(flows, Real(shear / trial_shear), Real(1.0));
        result.stress = select(returns, deviatoric * factor - SymmetricTensor<Real>::isotropic(pressure), trial);
        result.state[opening] = select(returns, Real((pressure - contact) * (1.0 / bulk_modulus_)), old.state[opening]);
        // |dev eps_p| is the shear strain (tau_trial - tau)/G over sqrt(2)
        result.state[shear_strain] +=
            select(flows, Real((trial_shear - shear) * (1.0 / (std::sqrt(3.0) * shear_modulus_))), Real(0.0));
        return result;
    }

    /// A settled mass is closed.
    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>&, double) const
    {
        return {Real(0.0), Real(0.0)};
    }

private:
    static double friction_range(const Parameters& parameters)
    {
        const double least = parameters.real("static_friction");
        const double most = parameters.real("limiting_friction");
        if (!(most >= least))
            throw std::invalid_argument("limiting_friction (" + std::to_string(most) +
                                        ") must not be less than static_friction (" + std::to_string(least) + ")");
        return most - least;
    }

    /// x = tau - mu_s p at the end of the step, t = tau_trial - mu_s p > 0 at its start. The law solved for its rate is
    /// gamma_dot = xi sqrt(p) x/(m - x) with m = (mu_2 - mu_s) p and xi = I_0/(d sqrt(rho_s)); the step is
    /// tau = tau_trial - G dt gamma_dot; so with alpha = xi G dt sqrt(p)
    ///     (t - x)(m - x) = alpha x,
    /// of which the smaller root lies between 0 and both t and m. Its discriminant (t + m + alpha)^2 - 4 t m is summed
    /// from terms that are not negative. Without time x is the lesser of t and m.
    template <class Real>
    Real overstress(const Real& trial, const Real& pressure, double time_step) const
    {
        const Real most = friction_range_ * pressure;
        const Real alpha = (fluidity_ * shear_modulus_ * time_step) * square_root(pressure);
        const Real sum = trial + most;
        const Real difference = trial - most;
        const Real root = square_root(Real(difference * difference + alpha * (alpha + 2.0 * sum)));
        return 2.0 * trial * most / (sum + alpha + root);
    }

    double bulk_modulus_;
    double shear_modulus_;
    double static_friction_; // mu_s
    double friction_range_;  // mu_2 - mu_s
    double fluidity_;        // xi [1/(s sqrt(Pa))]
};

} // namespace periporo
