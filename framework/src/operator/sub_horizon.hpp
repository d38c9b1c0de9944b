// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Force states whose bonds have a velocity gradient of their own, taken over their sub-horizon.
#pragma once

#include "operator/force_state.hpp"

namespace periporo {

/// Kinematics on a bond b = (i,j): with H_b = H_i and H_j,
///     K_b = sum_{k in H_b} omega_ik V_k zeta_ik (x) zeta_ik
///     L_b = [sum_{k in H_b} omega_ik V_k (v_k - v_i) (x) zeta_ik] K_b^-1
/// (Menon and Song 2021). A bond whose sub-horizon is thinner than least_relative_thickness is inactive.
class SubHorizonForceState : public ForceState {
public:
    enum class Kind {
        /// The gradient agrees with the bond along itself, L_b' = L_b + (v_j - v_i - L_b zeta) (x) zeta/|zeta|^2, with
        /// |zeta| at least `shortest_bond` spacings in the denominator, and the forces are conjugate to the stress
        /// power sum_i V_i sum_b w_b sigma_b : L_b' with w_b = omega_b V(H_b)/sum_b' omega_b' V(H_b').
        energy_conjugate,
        /// The gradient is L_b: T_ik = omega_ik [sum_{b of i, k in H_b} w_b sigma_b K_b^-1] zeta_ik, conjugate to
        /// sum_i V_i sum_b w_b sigma_b : L_b. Points of soil that flows pair up with it.
        energy_conjugate_mean,
        /// T_ij = phi_b omega_ij sigma_b K_b^-1 zeta_ij with phi_b = V(H_b)/V(H_i), as published. Not consistent: the
        /// sum of V T (x) zeta over a family is about 0.83 times the stress at delta = 3 dx.
        volume_weighted
    };

    SubHorizonForceState(Influence influence, Kind kind) : ForceState(influence), kind_(kind) {}

    using ForceState::evaluate;
    void evaluate(const OperatorInput& input, const Evaluation& evaluation, BondStates& bonds,
                  OperatorWorkspace& workspace, OperatorResult& result) const override;
    void bond_weights(const Model& model, std::size_t point, std::span<double> weights) const override;
    bool uses_sub_horizons() const override { return true; }

private:
    Kind kind_;
};

} // namespace periporo
