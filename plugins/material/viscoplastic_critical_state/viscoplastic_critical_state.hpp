// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Viscoplastic critical-state model: modified Cam-clay ellipse, associated Perzyna flow, suction hardening.
#pragma once

#include "periporo/material_law.hpp"
#include "return_map.hpp"
#include "suction_hardening.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace periporo {

/// Yield function, in compression-positive p = -tr(sigma')/3 and q = sqrt(3/2)|dev sigma'|,
///     f = q^2/M^2 + (p + p_s)(p - pc_bar),   pc_bar = max(pc_min, exp(a) pc^b in units of 1 kPa)
/// with constant elastic moduli, flow  d eps_vp/dt = <f>/eta df/dsigma', and hardening d ln pc = d eps_v_p/(lambda -
/// kappa) in logarithmic strain. a and b are those of SuctionHardening; dry soil has pc_bar = pc. The update is
/// backward Euler and safe for eta -> 0. ln pc is kept without the floor: loosened grains that come together again must
/// first close up before they carry load.
class ViscoplasticCriticalState {
public:
    static constexpr std::size_t state_count = 3;
    enum StateIndex : std::size_t { log_preconsolidation = 0, shear_strain = 1, volumetric_strain = 2 };

    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> list = {
            Parameter::real("bulk_modulus", dimension::pressure, "Elastic bulk modulus K").above(0.0),
            Parameter::real("shear_modulus", dimension::pressure, "Elastic shear modulus G").above(0.0),
            Parameter::real("critical_state_slope", dimension::none, "Critical-state stress ratio M = q/p").above(0.0),
            Parameter::real("compression_index", dimension::none,
                            "Slope lambda of the virgin line, volumetric log-strain per ln p")
                .above(0.0),
            Parameter::real("swelling_index", dimension::none,
                            "Slope kappa of the swelling line, less than the compression index")
                .at_least(0.0),
            Parameter::real("viscosity", dimension::squared_yield_viscosity, "Viscosity eta of a yield function in Pa2")
                .at_least(0.0),
            Parameter::real("minimum_preconsolidation", dimension::pressure,
                            "Numerical floor of the preconsolidation pressure in the yield function")
                .above(0.0)
                .by_default(20.0),
            Parameter::real("tensile_strength", dimension::pressure,
                            "Isotropic tensile strength p_s that extends the ellipse")
                .at_least(0.0)
                .by_default(0.0)};
        for (Parameter& parameter : SuctionHardening::parameters())
            list.push_back(std::move(parameter));
        return list;
    }

    static std::vector<StateVariable> state_variables()
    {
        return {{"log_preconsolidation_pressure", "ln Pa",
                 "Natural logarithm of the preconsolidation pressure pc over 1 Pa, without the suction shift", 0.0,
                 false, true},
                {"equivalent_plastic_shear_strain", "-", "Accumulated sqrt(2/3)|dev eps_p|", 0.0, true},
                {"plastic_volumetric_strain", "-", "Plastic volumetric strain, compression positive", 0.0, true}};
    }

    /// @throws std::invalid_argument when kappa is not less than lambda, or some but not all bonding parameters are
    /// given.
    explicit ViscoplasticCriticalState(const Parameters& parameters)
        : shear_modulus_(parameters.real("shear_modulus")),
          inverse_squared_slope_(1.0 / square(parameters.real("critical_state_slope"))),
          plastic_index_(plastic_index(parameters)), viscosity_(parameters.real("viscosity")),
          return_(return_constants(parameters)),
          suction_(parameters, parameters.real("compression_index"), parameters.real("swelling_index"))
    {
    }

    double bulk_modulus() const { return return_.bulk_modulus; }
    double shear_modulus() const { return shear_modulus_; }

    template <class Real>
    LawResult<Real, state_count> update(const LawInput<Real, state_count>& old) const
    {
        LawResult<Real, state_count> result;
        result.stress = elastic_stress(old.stress, old.strain_increment, bulk_modulus(), shear_modulus_);
        result.state = old.state;

        const SuctionShift<Real> shift = suction_.shift(old.suction, old.saturation);
        const Real log_pressure = SuctionHardening::shifted(old.state[log_preconsolidation], shift);
        ReturnInput<Real> trial;
        trial.mean_stress = trace(result.stress) * (-1.0 / 3.0);
        const SymmetricTensor<Real> deviatoric = deviator(result.stress);
        const Real squared_shear = 1.5 * double_contraction(deviatoric, deviatoric); // q^2
        trial.squared_shear = squared_shear * inverse_squared_slope_;
        trial.log_preconsolidation = log_pressure;
        trial.preconsolidation = exponential(log_pressure);
        trial.hardening = shift.slope * (1.0 / plastic_index_);
        trial.viscosity_over_step = viscosity_ > 0.0 ? viscosity_ / old.time_step : 0.0;

        const Real centre_to_apex = 0.5 * (maximum(trial.preconsolidation, Real(return_.floor)) + tensile_strength());
        const Real from_centre = trial.mean_stress + tensile_strength() - centre_to_apex;
        const Real squared_stress = trial.squared_shear + from_centre * from_centre;
        const Mask<Real> usable = squared_stress <= Real(largest) &&
                                  absolute(log_pressure) <= Real(largest_logarithm) && trial.hardening > Real(0.0) &&
                                  Mask<Real>(old.time_step >= 0.0);
        // a stress on the surface to round-off is elastic; without time there is no viscous flow
        const bool flows = viscosity_ == 0.0 || old.time_step > 0.0;
        const Mask<Real> yields =
            usable && Mask<Real>(flows) && squared_stress > Real(centre_to_apex * centre_to_apex * (1.0 + 1e-12));
        if (!all(usable)) {
            result.failed = !usable;
            result.reason = "stress, strain increment, state or time step is not a finite number";
        }
        if (!any(yields))
            return result;

        ReturnMap<Real> solution(return_, trial);
        const Mask<Real> unsolved = solution.solve(yields);
        if (any(unsolved)) {
            result.failed = result.failed || unsolved;
            result.reason = "the return to the yield surface did not converge";
        }
        const SymmetricTensor<Real> plastic =
            deviatoric * solution.shear_factor - SymmetricTensor<Real>::isotropic(solution.mean_stress);
        result.stress = select(yields, plastic, result.stress);
        const Real strain = select(yields, solution.volumetric_strain, Real(0.0));
        const Real shear = 2.0 * inverse_squared_slope_ * solution.multiplier * solution.shear_factor;
        result.state[log_preconsolidation] += strain * (1.0 / plastic_index_);
        result.state[volumetric_strain] += strain;
        result.state[shear_strain] += select(yields, Real(shear * square_root(squared_shear)), Real(0.0));
        return result;
    }

    /// pc = OCR (p + q^2/(M^2 (p + p_s))) of the settled stress, in the sense of pc_bar, then freed of the suction
    /// shift. Where p + p_s is below the floor pc_min it counts as pc_min, and a stress in tension gets the floor.
    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>& settled,
                                                double overconsolidation_ratio) const
    {
        const Real mean = trace(settled.stress) * (-1.0 / 3.0);
        const SymmetricTensor<Real> deviatoric = deviator(settled.stress);
        const Real squared_shear = 1.5 * inverse_squared_slope_ * double_contraction(deviatoric, deviatoric);
        const Real pressure = maximum(Real(mean + tensile_strength()), Real(return_.floor));
        const Real on_surface = pressure - tensile_strength() + squared_shear / pressure;
        const Real wanted =
            select(mean > Real(-tensile_strength()), Real(overconsolidation_ratio * on_surface), Real(return_.floor));
        const Real log_pressure = logarithm(maximum(wanted, Real(return_.floor)));
        return {SuctionHardening::unshifted(log_pressure, suction_.shift(settled.suction, settled.saturation)),
                Real(0.0), Real(0.0)};
    }

private:
    // beyond these a square or an exponential would overflow: no soil, but a diverged run
    static constexpr double largest = 1e60;
    static constexpr double largest_logarithm = 1e5;

    static double square(double a) { return a * a; }

    static double plastic_index(const Parameters& parameters)
    {
        const double compression = parameters.real("compression_index");
        const double swelling = parameters.real("swelling_index");
        if (!(swelling < compression))
            throw std::invalid_argument("swelling_index (" + std::to_string(swelling) +
                                        ") must be less than compression_index (" + std::to_string(compression) + ")");
        return compression - swelling;
    }

    static ReturnConstants return_constants(const Parameters& parameters)
    {
        const double floor = parameters.real("minimum_preconsolidation");
        return {parameters.real("bulk_modulus"),
                6.0 * parameters.real("shear_modulus") / square(parameters.real("critical_state_slope")),
                parameters.real("tensile_strength"), floor, std::log(floor)};
    }

    double tensile_strength() const { return return_.tensile_strength; }

    double shear_modulus_;
    double inverse_squared_slope_; // 1/M^2
    double plastic_index_;         // lambda - kappa
    double viscosity_;             // eta [Pa3 s]
    ReturnConstants return_;
    SuctionHardening suction_;
};

} // namespace periporo
