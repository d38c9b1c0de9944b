// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The bond-projection force state: one velocity gradient per point, corrected along each bond.
#pragma once

#include "operator/force_state.hpp"

namespace periporo {

/// Breitzman and Dayal 2018, Behzadinasab and Foster 2020, in the current configuration. With n = zeta/|zeta|,
///     K_i = sum_j omega V_j n (x) n;  L_i = [sum_j omega V_j (v_j - v_i) (x) zeta/|zeta|^2] K_i^-1
///     L_ij = Lbar + [(v_j - v_i) - Lbar zeta] (x) zeta/|zeta|^2,  Lbar = (L_i + L_j)/2
/// The force is conjugate to the stress power sum_i V_i sum_j (omega V_j/w0_i) sigma_ij : L_ij with
/// w0_i = sum_j omega V_j over active bonds. With S_ij = omega (1/w0_i + 1/w0_j),
///     A_i = 1/2 sum_j V_j S_ij sigma_ij (1 - n (x) n)
///     T_ij = 1/2 S_ij sigma_ij zeta/|zeta|^2 + omega A_i K_i^-1 zeta/|zeta|^2
/// A point with det K_i/(tr K_i/3)^3 < least_shape_quality has no gradient; bonds with such an end
/// are inactive, and so are bonds shorter than shortest_bond spacings: the stiffness that the projection
/// adds along a bond grows with 1/|zeta|^2, and the direction of two points on top of each other means nothing.
class BondProjectionForceState : public ForceState {
public:
    using ForceState::ForceState;

    using ForceState::evaluate;
    void evaluate(const OperatorInput& input, const Evaluation& evaluation, BondStates& bonds,
                  OperatorWorkspace& workspace, OperatorResult& result) const override;
    void bond_weights(const Model& model, std::size_t point, std::span<double> weights) const override;
    StressSite stress_site() const override { return StressSite::pairs; }
};

} // namespace periporo
