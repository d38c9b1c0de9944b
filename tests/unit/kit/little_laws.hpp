// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A small sound law, and the same with one fault each.
#pragma once

#include "periporo/material_kit.hpp"

#include <ctime>
#include <limits>
#include <thread>
#include <type_traits>

namespace periporo::test {

enum class Fault {
    none,
    direction,            ///< knows the x axis
    pressure_dependence,  ///< a shear modulus of the pressure with a constant bulk modulus, which has no energy
    flow_against_stress,  ///< yielding adds to the shear stress
    soft_unloading,       ///< a smaller shear modulus on the way back than on the way out
    hidden_state,         ///< remembers the last strain outside its state variables
    shared_scratch,       ///< keeps what it computes in a member that other threads write too
    not_a_number,         ///< takes the root of a negative number and does not say so
    no_reason,            ///< fails without saying why
    unread_parameter,     ///< declares a parameter that it does not read
    undeclared_parameter, ///< reads a parameter that it does not declare
    unlimited_tension,    ///< bears any tension
    fading_by_call,       ///< loses shear stress by the call and not by strain or time
    coupled_lanes,        ///< yielding of one lane weakens all
    spreading_failure,    ///< one lane that fails makes all fail
    understated_modulus,  ///< reports half of its bulk modulus
    weak_initial_state,   ///< initialize finds a strength below the stress
    endless_search,       ///< takes long when strains are huge
    packs_differ,         ///< gives packs another answer than a double
    initial_packs_differ, ///< gives packs another initial state than a double
    unset_initial_state,  ///< leaves one variable of the initial state unset
    unset_state,          ///< leaves one state variable unset in an update
    miscounted            ///< lists one state variable too few
};

/// A cohesionless cone q <= M p without dilation, whose friction M hardens from 0.4 towards its limit:
/// dM = 100 (M_limit - M) d gamma_p. Elastic moduli are constant, and stress beyond p = 0 is cut to zero.
template <Fault fault>
class LittleLaw {
public:
    static constexpr std::size_t state_count = 2;

    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> list = {
            Parameter::real("bulk_modulus", dimension::pressure, "Bulk modulus K").above(0.0),
            Parameter::real("shear_modulus", dimension::pressure, "Shear modulus G").above(0.0),
            Parameter::real("friction", dimension::none, "Limit of the stress ratio q/p").above(0.0).by_default(1.2)};
        if (fault == Fault::unread_parameter)
            list.push_back(Parameter::text("colour", "Colour of the grains").by_default("grey"));
        return list;
    }

    static std::vector<StateVariable> state_variables()
    {
        std::vector<StateVariable> list = {
            {"friction", "-", "Stress ratio M at which the material yields", first_friction},
            {"shear_strain", "-", "Equivalent plastic shear strain", 0.0, true}};
        if (fault == Fault::miscounted)
            list.pop_back();
        return list;
    }

    explicit LittleLaw(const Parameters& parameters)
        : bulk_modulus_(parameters.real("bulk_modulus")), shear_modulus_(parameters.real("shear_modulus")),
          friction_(parameters.real("friction"))
    {
        if (fault == Fault::undeclared_parameter)
            static_cast<void>(parameters.has("porosity"));
    }

    double bulk_modulus() const { return bulk_modulus_ * (fault == Fault::understated_modulus ? 0.5 : 1.0); }
    double shear_modulus() const { return shear_modulus_; }

    template <class Real>
    LawResult<Real, 2> update(const LawInput<Real, 2>& old) const
    {
        LawResult<Real, 2> result;
        const SymmetricTensor<Real> trial = trial_stress(old);
        const Mask<Real> usable = norm(trial) + absolute(old.state[0]) + absolute(old.state[1]) <= Real(1e60);
        if (!all(usable)) {
            result.failed = !usable;
            if (fault == Fault::spreading_failure)
                result.failed = Mask<Real>(true);
            if (fault != Fault::no_reason)
                result.reason = "not a finite number";
        }
        Real pressure = trace(trial) * (-1.0 / 3.0);
        if (fault != Fault::unlimited_tension)
            pressure = maximum(pressure, Real(0.0));
        const SymmetricTensor<Real> shear = deviator(trial);
        const Real trial_shear = square_root(Real(1.5 * double_contraction(shear, shear)));
        const Real strength = old.state[0] * maximum(pressure, Real(0.0));
        const Mask<Real> yields = trial_shear > strength * (1.0 + 1e-12);
        const Real excess = select(yields, trial_shear - strength, Real(0.0));
        const double kept = fault == Fault::flow_against_stress ? 1.1 : 0.0;
        Real factor = select(yields, (strength + excess * kept) / maximum(trial_shear, Real(1e-200)), Real(1.0));
        if (fault == Fault::fading_by_call)
            factor *= Real(0.99);
        if (fault == Fault::coupled_lanes && any(yields) && !all(yields))
            factor *= Real(0.9);
        if (fault == Fault::packs_differ && !std::is_same_v<Real, double>)
            factor *= Real(0.999);
        result.stress = shear * factor - SymmetricTensor<Real>::isotropic(pressure);
        if (fault == Fault::not_a_number)
            result.stress *=
                square_root(Real(1.0 - 1e-3 * double_contraction(old.strain_increment, old.strain_increment)));
        const Real strain = excess * (1.0 / (3.0 * shear_modulus_));
        result.state[0] = old.state[0] + 100.0 * (friction_ - old.state[0]) * strain / (1.0 + 100.0 * strain);
        if (fault != Fault::unset_state)
            result.state[1] = old.state[1] + strain;
        return result;
    }

    template <class Real>
    std::array<Real, 2> initial_state(const LawInput<Real, 2>& settled, double overconsolidation_ratio) const
    {
        const Real pressure = trace(settled.stress) * (-1.0 / 3.0);
        const SymmetricTensor<Real> shear = deviator(settled.stress);
        const Real ratio = square_root(Real(1.5 * double_contraction(shear, shear))) / maximum(pressure, Real(1e-12));
        const Real mobilised = select(pressure > Real(0.0), overconsolidation_ratio * ratio, Real(0.0));
        Real friction = maximum(Real(first_friction), minimum(mobilised, Real(friction_)));
        if (fault == Fault::weak_initial_state)
            friction = Real(0.01);
        if (fault == Fault::initial_packs_differ && !std::is_same_v<Real, double>)
            friction *= Real(1.001);
        if (fault == Fault::unset_initial_state) {
            std::array<Real, 2> state;
            state[0] = friction;
            return state;
        }
        return {friction, Real(0.0)};
    }

private:
    static constexpr double first_friction = 0.4;

    template <class Real>
    SymmetricTensor<Real> trial_stress(const LawInput<Real, 2>& old) const
    {
        const SymmetricTensor<Real>& strain = old.strain_increment;
        const Real volume = trace(strain);
        SymmetricTensor<Real> trial = elastic_stress(old.stress, strain, bulk_modulus_, shear_modulus_);
        const auto soften_shear = [&](const Real& lost) { // by this part of 2 G
            trial -= deviator(strain) * Real(2.0 * shear_modulus_ * lost);
        };
        if (fault == Fault::direction)
            trial.xx -= 0.01 * shear_modulus_ * strain.xx;
        if (fault == Fault::pressure_dependence) {
            const Real pressure = maximum(Real(trace(old.stress) * (-1.0 / 3.0)), Real(0.0));
            soften_shear(5e4 / (pressure + 5e4));
        }
        if (fault == Fault::soft_unloading)
            soften_shear(select(double_contraction(deviator(old.stress), strain) < Real(0.0), Real(0.5), Real(0.0)));
        if (fault == Fault::hidden_state) {
            trial += SymmetricTensor<Real>::isotropic(Real(0.01 * bulk_modulus_ * scratch_));
            scratch_ = lane_of(volume, 0);
        }
        if (fault == Fault::shared_scratch) {
            scratch_ = lane_of(volume, 0);
            std::this_thread::yield();
            trial += SymmetricTensor<Real>::isotropic(Real(bulk_modulus_ * (scratch_ - lane_of(volume, 0))));
        }
        if (fault == Fault::endless_search && lane_of(volume, 0) > 0.5)
            for (const std::clock_t begin = std::clock(); std::clock() - begin < CLOCKS_PER_SEC / 20;) {
            }
        return trial;
    }

    double bulk_modulus_;
    double shear_modulus_;
    double friction_;
    mutable double scratch_ = 0.0; // used by two of the faults
};

template <Fault fault>
Parameters little_parameters()
{
    return kit::parameters_of(LittleLaw<fault>::parameters(), {{"bulk_modulus", 25e6}, {"shear_modulus", 15e6}});
}

/// A sound material; faults of the interface are put over it.
struct LittleMaterial : LawMaterial<LittleLaw<Fault::none>> {
    LittleMaterial() : LawMaterial(little_parameters<Fault::none>()) {}
};

/// The sentence that a check wrote, or an empty text.
inline std::string sentence_of(const std::string& check, const std::vector<std::string>& faults)
{
    for (const std::string& fault : faults)
        if (fault.starts_with(check + ":"))
            return fault;
    return {};
}

} // namespace periporo::test
