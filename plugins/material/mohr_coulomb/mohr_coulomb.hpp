// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mohr-Coulomb plasticity with exact corners, dilatancy, a cut-off in tension, and the memory of how far the mass has
// come apart.
#pragma once

#include "../common/frictional_soil.hpp"
#include "principal_axes.hpp"
#include "pyramid_return.hpp"

namespace periporo {

/// Constant elastic moduli, the six planes of PyramidReturn, and
///   opening  p >= -p_t, volumetric strain o >= 0 by which the mass is apart, and o (p + p_t) = 0.
/// A mass that is apart carries p = -p_t until it has closed. With p* = p_trial - K o_old, the pressure it would have
/// if it were closed now, the step is first the return to the pyramid alone, from p*; if that ends with p >= -p_t it is
/// the solution. Otherwise p = -p_t, the deviator returns at that p to the hexagon that the pyramid leaves there, and
/// with the sum S of the multipliers o = (-p_t - p*)/K - 2 sin(psi) S. A hexagon has no tip, and p_t <= c cot(phi) cuts
/// off that of the pyramid, or meets it.
///
/// This is complete. Let S(p) be the sum of the multipliers of the return at held p. The hexagon grows in
/// proportion to c cos(phi) + p sin(phi), and the share of a corner in either of its two flow directions is positive
/// and by symmetry the same, so S falls with p, and the volume
///     V(p) = (p - p*)/K - 2 sin(psi) S(p)
/// that the mass must be apart to have p rises strictly. The return to the pyramid alone ends at p_c with V(p_c) = 0.
/// If p_c < -p_t, then o = V(-p_t) > V(p_c) = 0; if not, o > 0 at p = -p_t would need V(-p_t) > V(p_c), against its
/// rise.
///
/// The cut-off acts on p and not on the largest principal stress: only a limit of p can have a memory in volume,
/// which is what density is, without the opening doing work against the lateral stresses.
class MohrCoulomb {
public:
    static constexpr std::size_t state_count = FrictionalSoil::state_count;
    using StateIndex = FrictionalSoil::StateIndex;

    static std::vector<Parameter> parameters() { return FrictionalSoil::parameters(); }
    static std::vector<StateVariable> state_variables() { return FrictionalSoil::state_variables(); }

    /// @throws std::invalid_argument as FrictionalSoil does.
    explicit MohrCoulomb(const Parameters& parameters)
        : soil_(parameters), sin_friction_(std::sin(soil_.friction_angle)),
          sin_dilatancy_(std::sin(soil_.dilatancy_angle)),
          shear_strength_(soil_.cohesion * std::cos(soil_.friction_angle)),
          closed_(soil_.bulk_modulus, soil_.shear_modulus, sin_friction_, sin_dilatancy_, shear_strength_),
          at_held_pressure_(0.0, soil_.shear_modulus, sin_friction_, sin_dilatancy_, shear_strength_)
    {
    }

    double bulk_modulus() const { return soil_.bulk_modulus; }
    double shear_modulus() const { return soil_.shear_modulus; }

    template <class Real>
    LawResult<Real, state_count> update(const LawInput<Real, state_count>& old) const
    {
        const FrictionalSoil::Trial<Real> trial = soil_.trial(old);
        if (!any(!surely_elastic(trial)))
            return soil_.elastic_result(old, trial);

        const PrincipalAxes<Real> axes(trial.deviator);
        PrincipalStress<Real> stress = closed_(axes.values, trial.closed_pressure);
        const Mask<Real> opens = stress.pressure < Real(-soil_.tensile_strength);
        if (any(opens)) {
            const auto held = at_held_pressure_(axes.values, Real(-soil_.tensile_strength));
            for (std::size_t i = 0; i < 3; ++i)
                stress.deviator[i] = select(opens, held.deviator[i], stress.deviator[i]);
            stress.pressure = select(opens, held.pressure, stress.pressure);
            stress.multiplier = select(opens, held.multiplier, stress.multiplier);
        }
        return soil_.result(old, trial,
                            {axes.tensor(stress.deviator), stress.pressure, plastic_shear(axes.values, stress.deviator),
                             Real(2.0 * sin_dilatancy_ * stress.multiplier), opens});
    }

    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>&, double) const
    {
        return FrictionalSoil::initial_state<Real>();
    }

private:
    /// Closed, above the cut-off, and inside the cone that is inscribed in the pyramid (Drucker and Prager 1952): known
    /// without principal stresses.
    template <class Real>
    Mask<Real> surely_elastic(const FrictionalSoil::Trial<Real>& trial) const
    {
        const double ratio = 3.0 / std::sqrt(3.0 + sin_friction_ * sin_friction_);
        const Real radius = ratio * (shear_strength_ + sin_friction_ * trial.pressure);
        return trial.closed_pressure == trial.pressure && trial.pressure >= Real(-soil_.tensile_strength) &&
               radius > Real(0.0) && 1.5 * double_contraction(trial.deviator, trial.deviator) < radius * radius;
    }

    /// sqrt(2/3)|dev eps_p| of a step, from the deviators before and after the return.
    template <class Real>
    Real plastic_shear(const std::array<Real, 3>& trial, const std::array<Real, 3>& returned) const
    {
        Real squares{0.0};
        for (std::size_t i = 0; i < 3; ++i)
            squares += (trial[i] - returned[i]) * (trial[i] - returned[i]);
        return square_root(Real(squares * (2.0 / 3.0))) * (0.5 / shear_modulus());
    }

    FrictionalSoil soil_;
    double sin_friction_;
    double sin_dilatancy_;
    double shear_strength_; // c cos(phi)
    PyramidReturn closed_;
    PyramidReturn at_held_pressure_;
};

} // namespace periporo
