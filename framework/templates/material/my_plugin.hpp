// my plugin: elastic up to a yield stress, beyond it a viscous flow in shear (Bingham).
//
// Make it yours: parameters(), state_variables(), update(), then the tests and the case. Neighbours, rotation of
// stresses, packs, output and restart are the framework's.
#pragma once

#include <periporo/material_law.hpp>

#include <array>
#include <vector>

namespace lab {

using namespace periporo;

/// With the deviator stress q = sqrt(3/2)|dev sigma'| the material flows where q exceeds the yield stress q_y, with
///     q = q_y + 3 eta d eps_s/dt
/// for the equivalent plastic shear strain eps_s. In simple shear that is Bingham's tau = tau_y + eta d gamma/dt with
/// tau_y = q_y/sqrt(3). Changes of volume are elastic.
class MyPlugin {
public:
    /// State variables, in the order of state_variables().
    enum StateIndex : std::size_t { plastic_shear_strain = 0 };
    static constexpr std::size_t state_count = 1;

    /// What a case gives. Values arrive checked and in SI units; `periporo inspect my_plugin` prints this list.
    static std::vector<Parameter> parameters()
    {
        return {
            Parameter::real("bulk_modulus", dimension::pressure, "Elastic bulk modulus K").above(0.0),
            Parameter::real("shear_modulus", dimension::pressure, "Elastic shear modulus G").above(0.0),
            Parameter::real("yield_stress", dimension::pressure, "Deviator stress q_y at which flow begins").above(0.0),
            Parameter::real("viscosity", dimension::dynamic_viscosity,
                            "Viscosity eta of the flow; 0 for one that does not depend on the rate")
                .at_least(0.0)};
    }

    /// Name, unit, meaning, initial value, and whether it starts anew after the geostatic stage. The framework takes
    /// means over neighbours: choose a variable whose mean has a meaning.
    static std::vector<StateVariable> state_variables()
    {
        return {{"equivalent_plastic_shear_strain", "-", "Accumulated sqrt(2/3)|dev eps_p|", 0.0, true}};
    }

    /// Throw std::invalid_argument here when values do not go together: `periporo check` shows the message.
    explicit MyPlugin(const Parameters& parameters)
        : bulk_modulus_(parameters.real("bulk_modulus")), shear_modulus_(parameters.real("shear_modulus")),
          yield_stress_(parameters.real("yield_stress")), viscosity_(parameters.real("viscosity"))
    {
    }

    /// The stiffest answer of the law; the time step follows from it.
    double bulk_modulus() const { return bulk_modulus_; }
    double shear_modulus() const { return shear_modulus_; }

    /// One step of one point: old state in, new state out, tension-positive stress. `Real` is double or a pack of
    /// doubles, one for each of some points; so a choice is written select(mask, a, b), which evaluates both sides, and
    /// an `if` asks any(mask) or all(mask).
    template <class Real>
    LawResult<Real, state_count> update(const LawInput<Real, state_count>& old) const
    {
        LawResult<Real, state_count> result;
        result.state = old.state;
        result.stress = elastic_stress(old.stress, old.strain_increment, bulk_modulus_, shear_modulus_);

        const SymmetricTensor<Real> shear = deviator(result.stress);
        const Real trial = square_root(Real(1.5 * double_contraction(shear, shear))); // q, were the step elastic

        // A comparison with a number that is none is false, so this fails for it too. Say so instead of going on.
        const Mask<Real> sound = absolute(trace(result.stress)) <= Real(largest_stress) &&
                                 trial <= Real(largest_stress) && Mask<Real>(old.time_step >= 0.0);
        if (!all(sound)) {
            result.failed = !sound;
            result.reason = "stress, strain increment or time step is not a finite number";
        }
        const Mask<Real> yields = trial > Real(yield_stress_);
        if (!any(yields))
            return result;

        // Backward Euler: q = q_trial - 3 G x and q = q_y + 3 eta x/dt for the plastic shear strain x of the step.
        const double resistance = viscosity_ > 0.0 ? viscosity_ / old.time_step : 0.0; // no flow without time
        const Real strain = (trial - yield_stress_) * (1.0 / (3.0 * (shear_modulus_ + resistance)));
        const Real reduction = select(yields, Real(3.0 * shear_modulus_ * strain / trial), Real(0.0));
        result.stress -= shear * reduction;
        result.state[plastic_shear_strain] += select(yields, strain, Real(0.0));
        return result;
    }

    /// The state that belongs to a settled stress, after the geostatic stage.
    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>&, double) const
    {
        return {Real(0.0)};
    }

private:
    static constexpr double largest_stress = 1e60; // [Pa] no material, but a run that has diverged

    double bulk_modulus_;
    double shear_modulus_;
    double yield_stress_;
    double viscosity_;
};

} // namespace lab
