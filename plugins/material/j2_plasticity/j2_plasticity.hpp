// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Von Mises plasticity with isotropic hardening and Bingham viscosity.
#pragma once

#include "../common/trial_stress.hpp"
#include "isotropic_hardening.hpp"
#include "periporo/material_law.hpp"

namespace periporo {

/// Constant elastic moduli; yield where q = sqrt(3/2)|dev sigma'| exceeds sigma_y(e) of IsotropicHardening; flow along
/// dev sigma', without change of volume, at the rate de/dt = sqrt(2/3)|dev d eps_p/dt| that
///     q = sigma_y(e) + 3 eta de/dt
/// asks for. In simple shear that is the Bingham fluid tau = sigma_y/sqrt(3) + eta d gamma/dt. The mean stress is
/// elastic and without limit: this material bears tension. The update is radial return, backward Euler.
class J2Plasticity {
public:
    static constexpr std::size_t state_count = 2;
    static constexpr bool closes = false; // a solid
    enum StateIndex : std::size_t { hardening_strain = 0, shear_strain = 1 };

    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> list = {
            Parameter::real("bulk_modulus", dimension::pressure, "Elastic bulk modulus K").above(0.0),
            Parameter::real("shear_modulus", dimension::pressure, "Elastic shear modulus G").above(0.0)};
        for (Parameter& parameter : IsotropicHardening::parameters())
            list.push_back(std::move(parameter));
        list.push_back(Parameter::real("viscosity", dimension::dynamic_viscosity,
                                       "Viscosity eta of the flow above the yield stress, shear stress per shear rate")
                           .at_least(0.0)
                           .by_default(0.0));
        return list;
    }

    static std::vector<StateVariable> state_variables()
    {
        // Hardening is no direction's own and outlives the release; the strain that pictures show starts anew there.
        return {{"hardening_strain", "-", "Equivalent plastic strain that has hardened or softened the material", 0.0,
                 false, true},
                {"equivalent_plastic_shear_strain", "-", "Accumulated sqrt(2/3)|dev eps_p|", 0.0, true}};
    }

    /// @throws std::invalid_argument as IsotropicHardening does.
    explicit J2Plasticity(const Parameters& parameters)
        : bulk_modulus_(parameters.real("bulk_modulus")), shear_modulus_(parameters.real("shear_modulus")),
          relaxation_time_(parameters.real("viscosity") / shear_modulus_), hardening_(parameters, shear_modulus_)
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

        const Real strain = maximum(old.state[hardening_strain], Real(0.0));
        const SymmetricTensor<Real> deviatoric = deviator(trial);
        const Real trial_shear = square_root(Real(1.5 * double_contraction(deviatoric, deviatoric)));
        const Real strength = hardening_.yield_stress(strain);
        const Real excess = trial_shear - strength;
        // a stress on the surface to round-off is elastic
        const Mask<Real> yields = usable_lanes && excess > 1e-12 * strength;
        if (!any(yields))
            return result;

        const double share = flow_share(old.time_step);
        const auto increment = hardening_.plastic_increment(excess, strain, share, yields);
        if (any(increment.unsolved)) {
            result.failed = result.failed || increment.unsolved;
            result.reason = "the return to the yield surface did not converge";
        }
        // q = q_trial - 3 G de, written as what it is by R = 0: free of cancellation however far away the trial is
        const Real shear =
            share * hardening_.yield_stress(Real(strain + increment.strain)) + (1.0 - share) * trial_shear;
        const SymmetricTensor<Real> returned =
            deviatoric * Real(shear / trial_shear) + SymmetricTensor<Real>::isotropic(trace(trial) * (1.0 / 3.0));
        result.stress = select(yields, returned, trial);
        result.state[hardening_strain] = select(yields, Real(strain + increment.strain), old.state[hardening_strain]);
        result.state[shear_strain] += select(yields, increment.strain, Real(0.0));
        return result;
    }

    /// Hardening is what it was, the strain of pictures zero.
    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>& settled, double) const
    {
        return {settled.state[hardening_strain], Real(0.0)};
    }

private:
    /// With de/dt = (q - sigma_y)/(3 eta), 3 G de = dt/(dt + eta/G) (q_trial - sigma_y): all of the overstress without
    /// viscosity, none of it without time.
    double flow_share(double time_step) const
    {
        return relaxation_time_ > 0.0 ? time_step / (time_step + relaxation_time_) : 1.0;
    }

    double bulk_modulus_;
    double shear_modulus_;
    double relaxation_time_; // eta/G [s]
    IsotropicHardening hardening_;
};

} // namespace periporo
