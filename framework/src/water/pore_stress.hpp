// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stress that water adds to that of the skeleton.
#pragma once

namespace periporo {

/// Isotropic stress, tension positive, that pore water adds to the effective stress: -(S_r p - p_ext) with the pore
/// pressure p and the pressure p_ext of the water that stands around the body [Pa]. Above the water table p = -s and
/// p_ext = 0, which gives S_r s (Bishop's effective stress). Below it S_r = 1 and p = p_ext, which gives zero: the
/// gradient of p_ext acts on the points as buoyancy instead. Both are S_r s, since the suction below the table is zero.
template <class Real>
Real pore_stress(const Real& suction, const Real& saturation)
{
    return suction * saturation;
}

} // namespace periporo
