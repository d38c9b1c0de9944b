// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Drucker-Prager plasticity with dilatancy, a cut-off in tension, and the memory of how far the mass has come apart.
#pragma once

#include "../common/frictional_soil.hpp"
#include "matched_cone.hpp"

namespace periporo {

/// With p = -tr(sigma')/3 and q = sqrt(3/2)|dev sigma'|, two mechanisms on constant elastic moduli:
///   cone     f = q - k - M p <= 0, multiplier dl >= 0, flow of the potential q - M_psi p: shear strain dl and
///            dilation M_psi dl;
///   opening  p >= -p_t, volumetric strain o >= 0 by which the mass is apart, and o (p + p_t) = 0.
/// A mass that is apart carries p = -p_t until it has closed. With p* = p_trial - K o_old, the pressure it would have
/// if it were closed now, the step is
///     p = p* + K M_psi dl + K o,   q = q_trial - 3 G dl.
/// First the cone alone, o = 0: dl = <q_trial - k - M p*>/(3 G + K M M_psi). If that gives p >= -p_t it is the
/// solution; q = k + M p >= 0 then, as p_t <= k/M. Otherwise p = -p_t, dl = <q_trial - (k - M p_t)>/(3 G), q = q_trial
/// - 3 G dl, which is not negative, and o = (-p_t - p*)/K - M_psi dl.
///
/// This is complete. Let c be the cone alone with its p_c < -p_t. If dl_c > 0, then
///     3 G dl = q_trial - k + M p_t = 3 G dl_c + M (p_c + p_t) < 3 G dl_c,
/// and if dl_c = 0, then q_trial - k <= M p* = M p_c and dl = 0: in both dl <= dl_c, and so
///     K o = -p_t - p* - K M_psi dl >= -p_t - p_c > 0.
/// Nor is there another solution: the conditions are a linear complementarity problem in (dl, o) with the matrix
/// (3 G + K M M_psi, K M; K M_psi, K), whose principal minors are positive, 3 G K the last of them (Koiter 1953 for the
/// two mechanisms; Cottle, Pang and Stone 1992, theorem 3.3.7, for the one solution).
class DruckerPrager {
public:
    static constexpr std::size_t state_count = FrictionalSoil::state_count;
    using StateIndex = FrictionalSoil::StateIndex;

    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> list = FrictionalSoil::parameters();
        list.push_back(
            Parameter::text("match", "Where the cone has the strength and dilation of Mohr-Coulomb with these angles")
                .one_of({"compression", "extension", "plane_strain"})
                .by_default("compression"));
        return list;
    }

    static std::vector<StateVariable> state_variables() { return FrictionalSoil::state_variables(); }

    /// @throws std::invalid_argument as FrictionalSoil does.
    explicit DruckerPrager(const Parameters& parameters) : soil_(parameters), cone_(parameters.text("match"), soil_) {}

    double bulk_modulus() const { return soil_.bulk_modulus; }
    double shear_modulus() const { return soil_.shear_modulus; }
    const MatchedCone& cone() const { return cone_; }

    template <class Real>
    LawResult<Real, state_count> update(const LawInput<Real, state_count>& old) const
    {
        const FrictionalSoil::Trial<Real> trial = soil_.trial(old);
        const Real trial_shear = square_root(Real(1.5 * double_contraction(trial.deviator, trial.deviator)));
        const double tension = -soil_.tensile_strength;
        const double stiffening = bulk_modulus() * cone_.dilatancy; // of p by dl
        const Real excess =
            maximum(Real(trial_shear - cone_.strength - cone_.slope * trial.closed_pressure), Real(0.0));
        const Real cone_pressure =
            trial.closed_pressure + excess * (stiffening / (3.0 * shear_modulus() + cone_.slope * stiffening));
        const Real pressure = maximum(cone_pressure, Real(tension));

        // both solutions end at q = min(q_trial, k + M p); at the tip of the cone the sum may be negative by round-off
        const Real resistance = maximum(Real(cone_.strength + cone_.slope * pressure), Real(0.0));
        const Mask<Real> flows = trial_shear > resistance;
        const Real multiplier =
            select(flows, Real((trial_shear - resistance) * (1.0 / (3.0 * shear_modulus()))), Real(0.0));
        if (!any(flows || pressure != trial.pressure))
            return soil_.elastic_result(old, trial);
        const Real factor = select(flows, Real(resistance / trial_shear), Real(1.0));
        return soil_.result(old, trial,
                            {trial.deviator * factor, pressure, multiplier, Real(cone_.dilatancy * multiplier),
                             cone_pressure < Real(tension)});
    }

    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>&, double) const
    {
        return FrictionalSoil::initial_state<Real>();
    }

private:
    FrictionalSoil soil_;
    MatchedCone cone_;
};

} // namespace periporo
