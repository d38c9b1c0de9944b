// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the velocity gradient of bonds to their new stress: objectivity and the call of the material. Shared by all
// force states.
#pragma once

#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "operator/masked_sums.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace periporo {

inline Pack load_pack(const double* row)
{
    return Pack(row, std::experimental::vector_aligned);
}
inline void store_pack(const Pack& pack, double* row)
{
    pack.copy_to(row, std::experimental::vector_aligned);
}

/// Six rows of a pack as a symmetric tensor, and back.
inline SymmetricTensor<Pack> load_symmetric(const double* rows)
{
    const auto row = [rows](std::size_t c) { return load_pack(rows + c * pack_width); };
    return {row(0), row(1), row(2), row(3), row(4), row(5)};
}
inline void store_symmetric(const SymmetricTensor<Pack>& t, double* rows)
{
    std::size_t c = 0;
    for (const Pack* component : {&t.xx, &t.yy, &t.zz, &t.xy, &t.yz, &t.xz})
        store_pack(*component, rows + pack_width * c++);
}

/// Gradient with respect to the mid-step positions from the one with respect to the end positions,
/// L_mid = L (1 - dt L/2)^-1, exact for affine motion since x_mid = x_end - dt v/2.
template <class Real>
Tensor<Real> at_mid_step(const Tensor<Real>& gradient, double time_step)
{
    const Real half = -0.5 * time_step;
    Tensor<Real> m = gradient * half;
    m.xx += 1.0, m.yy += 1.0, m.zz += 1.0;
    return gradient * inverse(m);
}

/// Rotation of the step, (1 - dt W/2)^-1 (1 + dt W/2) with W = skew L (Hughes and Winget 1980). For the skew
/// A = dt W/2 with axial vector a this is 1 + 2 (A + A A)/(1 + |a|^2).
template <class Real>
Tensor<Real> step_rotation(const Tensor<Real>& gradient, double time_step)
{
    const Real quarter = 0.25 * time_step;
    const Real x = quarter * (gradient.zy - gradient.yz);
    const Real y = quarter * (gradient.xz - gradient.zx);
    const Real z = quarter * (gradient.yx - gradient.xy);
    const Real f = 2.0 / (1.0 + x * x + y * y + z * z);
    return {1.0 - f * (y * y + z * z), f * (x * y - z),           f * (x * z + y),
            f * (x * y + z),           1.0 - f * (x * x + z * z), f * (y * z - x),
            f * (x * z - y),           f * (y * z + x),           1.0 - f * (x * x + y * y)};
}

/// Buffers of one thread for the bonds of one point; they only ever grow.
struct StressWorkspace {
    AlignedVector<double> strain_increment; ///< packs x 6
    AlignedVector<double> rotated_stress;   ///< packs x 6, before the material
    AlignedVector<double> suction;          ///< packs
    AlignedVector<double> saturation;       ///< packs
    AlignedVector<double> total_stress;     ///< packs x 6, after the material; zero in inactive lanes
    AlignedVector<double> gradient;         ///< packs x 9, velocity gradient at the end positions [1/s]
    AlignedVector<double> work;             ///< packs; `advance`: mean of old and new stress : D dt, else stress : D
    AlignedVector<std::uint8_t> lanes;      ///< packs, active lanes

    void reserve(std::size_t packs);
};

/// Suction and saturation of the bonds of a point: means of the ends.
void gather_water(const Model& model, std::size_t point, StressWorkspace& workspace);

/// Takes `gradient` and `lanes` of the workspace for the bonds of `point` and leaves there `total_stress`
/// sigma' + S_r s 1, `work` and, for `advance`, `strain_increment`; `advance` also puts the new state into the bonds.
/// Inactive lanes have zero stress afterwards, gradients of inactive lanes must be zero before.
MaterialStatus update_bond_stress(Model& model, std::size_t point, const Evaluation& evaluation,
                                  StressWorkspace& workspace);

/// Share-weighted sums over the bonds of a point.
struct StepSums {
    double work = 0.0;     ///< of the stress, per volume [J/m3]; a power [W/m3] unless stresses were advanced
    double dilation = 0.0; ///< tr D dt [-]; 0 unless stresses were advanced
};

/// @param share gives the shares of the bonds of a pack by its number
template <class Share>
StepSums step_sums(const StressWorkspace& workspace, std::size_t packs, StressUpdate update, Share&& share)
{
    StepSums sums;
    for (std::size_t p = 0; p < packs; ++p) {
        const Pack shares = share(p);
        sums.work += reduce(shares * load_pack(workspace.work.data() + p * pack_width));
        const double* strain = workspace.strain_increment.data() + p * 6 * pack_width;
        if (update == StressUpdate::advance)
            sums.dilation += reduce(shares * trace(load_symmetric(strain)));
    }
    return sums;
}

/// `total_stress` of one pack as a tensor.
SymmetricTensor<Pack> total_stress(const StressWorkspace& workspace, std::size_t pack);

} // namespace periporo
