// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the laws of a soil with friction, cohesion and dilatancy have in common: parameters, state variables, and how a
// step begins and ends.
#pragma once

#include "periporo/material_law.hpp"
#include "trial_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// Elastic moduli, the angles of friction and dilatancy, cohesion, and the cut-off p >= -p_t of the mean stress with
/// its memory: the volumetric strain o >= 0 by which the mass has come apart, with o (p + p_t) = 0.
struct FrictionalSoil {
    static constexpr std::size_t state_count = 3;
    enum StateIndex : std::size_t { opening = 0, shear_strain = 1, volumetric_strain = 2 };

    double bulk_modulus;     ///< K [Pa]
    double shear_modulus;    ///< G [Pa]
    double friction_angle;   ///< phi [rad]
    double dilatancy_angle;  ///< psi [rad]
    double cohesion;         ///< c [Pa]
    double tensile_strength; ///< p_t [Pa]

    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("bulk_modulus", dimension::pressure, "Elastic bulk modulus K").above(0.0),
                Parameter::real("shear_modulus", dimension::pressure, "Elastic shear modulus G").above(0.0),
                Parameter::real("friction_angle", dimension::angle, "Angle of internal friction phi")
                    .at_least(0.0)
                    .below(0.5 * std::numbers::pi),
                Parameter::real("dilatancy_angle", dimension::angle,
                                "Angle of dilatancy psi, at most the angle of friction")
                    .at_least(0.0)
                    .below(0.5 * std::numbers::pi),
                Parameter::real("cohesion", dimension::pressure, "Cohesion c").at_least(0.0),
                Parameter::real("tensile_strength", dimension::pressure,
                                "Largest mean stress in tension p_t, at most c cot(phi)")
                    .at_least(0.0)
                    .by_default(0.0)};
    }

    static std::vector<StateVariable> state_variables()
    {
        return {{"opening", "-", "Volumetric strain by which the mass has come apart, to be closed before it carries",
                 0.0, false, true},
                {"equivalent_plastic_shear_strain", "-", "Accumulated sqrt(2/3)|dev eps_p|", 0.0, true},
                {"plastic_volumetric_strain", "-", "Plastic volumetric strain, compression positive, opening included",
                 0.0, true}};
    }

    /// @throws std::invalid_argument when psi exceeds phi, where flow would create energy, or p_t the tip of the cone.
    explicit FrictionalSoil(const Parameters& parameters)
        : bulk_modulus(parameters.real("bulk_modulus")), shear_modulus(parameters.real("shear_modulus")),
          friction_angle(parameters.real("friction_angle")), dilatancy_angle(parameters.real("dilatancy_angle")),
          cohesion(parameters.real("cohesion")), tensile_strength(parameters.real("tensile_strength"))
    {
        if (dilatancy_angle > friction_angle)
            throw std::invalid_argument("dilatancy_angle (" + degrees(dilatancy_angle) +
                                        ") must not exceed friction_angle (" + degrees(friction_angle) + ")");
        if (friction_angle == 0.0)
            return; // no tip
        const double tip = cohesion * std::cos(friction_angle) / std::sin(friction_angle);
        if (tensile_strength > (1.0 + 1e-6) * tip) // a user may write the tip itself, to the digits of a file
            throw std::invalid_argument("tensile_strength (" + std::to_string(tensile_strength) +
                                        " Pa) must not exceed cohesion cot(phi) (" + std::to_string(tip) +
                                        " Pa), where friction ends");
        tensile_strength = std::min(tensile_strength, tip);
    }

    /// The elastic step.
    template <class Real>
    struct Trial {
        SymmetricTensor<Real> stress;   ///< tension-positive [Pa]
        SymmetricTensor<Real> deviator; ///< of the stress [Pa]
        Real pressure;                  ///< p, compression-positive [Pa]
        Real closed_pressure;           ///< p* = p - K o, which the mass would have if it were closed [Pa]
        Mask<Real> usable;
    };
    template <class Real>
    Trial<Real> trial(const LawInput<Real, state_count>& old) const
    {
        const SymmetricTensor<Real> stress =
            elastic_stress(old.stress, old.strain_increment, bulk_modulus, shear_modulus);
        const Real pressure = trace(stress) * (-1.0 / 3.0);
        // where the bonds of a point share one opening, their mean change can leave less than none
        const Real apart = maximum(old.state[opening], Real(0.0));
        return {stress, periporo::deviator(stress), pressure, pressure - bulk_modulus * apart,
                usable(stress, old.state, old.time_step)};
    }

    /// What a law returns a trial to.
    template <class Real>
    struct Returned {
        SymmetricTensor<Real> deviator; ///< of the stress [Pa]
        Real pressure;                  ///< p >= -p_t [Pa]
        Real shear_strain;              ///< sqrt(2/3)|dev eps_p| of the step, 0 where no friction is overcome
        Real dilation;                  ///< by friction in the step
        Mask<Real> opens;               ///< p is held at -p_t
    };

    /// The result of a step that is elastic in all lanes that are usable.
    template <class Real>
    static LawResult<Real, state_count> elastic_result(const LawInput<Real, state_count>& old, const Trial<Real>& trial)
    {
        LawResult<Real, state_count> result{trial.stress, old.state};
        if (!all(trial.usable)) {
            result.failed = !trial.usable;
            result.reason = not_finite;
        }
        return result;
    }

    /// The result of a step; lanes that `returned` leaves where they were keep every bit.
    template <class Real>
    LawResult<Real, state_count> result(const LawInput<Real, state_count>& old, const Trial<Real>& trial,
                                        const Returned<Real>& returned) const
    {
        LawResult<Real, state_count> result = elastic_result(old, trial);
        const Mask<Real> flows = trial.usable && returned.shear_strain > Real(0.0);
        const Mask<Real> returns = flows || (trial.usable && returned.pressure != trial.pressure);
        const double compliance = 1.0 / bulk_modulus;
        const Real apart = (returned.pressure - trial.closed_pressure) * compliance - returned.dilation;
        const Real new_opening = select(returned.opens, maximum(apart, Real(0.0)), Real(0.0));
        result.stress =
            select(returns, returned.deviator - SymmetricTensor<Real>::isotropic(returned.pressure), trial.stress);
        result.state[opening] = select(returns, new_opening, old.state[opening]);
        result.state[shear_strain] += select(flows, returned.shear_strain, Real(0.0));
        result.state[volumetric_strain] +=
            select(returns, Real((trial.pressure - returned.pressure) * compliance), Real(0.0));
        return result;
    }

    /// A settled mass is closed.
    template <class Real>
    static std::array<Real, state_count> initial_state()
    {
        return {Real(0.0), Real(0.0), Real(0.0)};
    }

private:
    static std::string degrees(double angle) { return std::to_string(angle * 180.0 / std::numbers::pi) + " deg"; }
};

} // namespace periporo
