// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Plain point correspondence: one velocity gradient per point and no stabilization. The negative control.
#pragma once

#include "operator/force_state.hpp"

namespace periporo {

/// The original correspondence formulation (Silling et al. 2007) in the current configuration:
///     K_i = sum_j omega V_j zeta (x) zeta;  L_i = [sum_j omega V_j (v_j - v_i) (x) zeta] K_i^-1
///     T_ij = omega sigma_i K_i^-1 zeta_ij
/// conjugate to the stress power sum_i V_i sigma_i : L_i. sigma_i is the mean of the stress that the bonds of the point
/// carry; all of them see L_i. Inside a lattice L_i does not see a motion that alternates from point to point: such
/// modes cost no energy and grow. It is here to show what the other force states are for.
class PointCorrespondenceForceState : public ForceState {
public:
    using ForceState::ForceState;

    using ForceState::evaluate;
    void evaluate(const OperatorInput& input, const Evaluation& evaluation, BondStates& bonds,
                  OperatorWorkspace& workspace, OperatorResult& result) const override;
    void bond_weights(const Model& model, std::size_t point, std::span<double> weights) const override;
};

} // namespace periporo
