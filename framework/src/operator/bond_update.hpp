// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the velocity gradient of bonds to their new stress: objectivity and the call of the material. Shared by all
// force states.
#pragma once

#include "operator/evaluation.hpp"
#include "operator/transpose.hpp"
#include "periporo/material_law.hpp"
#include "water/pore_stress.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace periporo {

/// For each byte of lane bits a pack of zeros and ones.
struct LaneFactors {
    alignas(64) double rows[std::size_t(1) << pack_width][pack_width];

    constexpr LaneFactors() : rows()
    {
        for (std::size_t bits = 0; bits < (std::size_t(1) << pack_width); ++bits)
            for (std::size_t lane = 0; lane < pack_width; ++lane)
                rows[bits][lane] = static_cast<double>(bits >> lane & 1u);
    }
};
inline constexpr LaneFactors lane_factors{};

/// The mask whose lane l is bit l.
inline PackMask lane_mask(std::uint8_t bits)
{
    return load_pack(lane_factors.rows[bits]) > 0.5;
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
    AlignedVector<double> strain;      ///< packs x 6: `advance`: D dt, else D
    AlignedVector<double> first_work;  ///< packs; `advance`: half of old, rotated stress : D dt
    AlignedVector<double> suction;     ///< packs
    AlignedVector<double> saturation;  ///< packs
    AlignedVector<std::uint8_t> lanes; ///< packs, active lanes

    void reserve(std::size_t packs);
};

/// Suction and saturation of bonds of a point: means of the ends, some of which are wet. `neighbours` fills whole
/// packs.
void gather_water(const BondEnds& ends, std::size_t point, const std::uint32_t* neighbours, std::size_t packs,
                  StressWorkspace& workspace);

/// The stress of bonds of one point through one evaluation: begin() for every pack, then update(), then end() for
/// every pack.
class BondStress {
public:
    /// @param neighbours of the bonds, whole packs
    /// @param state rows of the bonds, as MaterialBatch has them
    BondStress(const OperatorInput& input, std::size_t point, const std::uint32_t* neighbours, std::size_t packs,
               double* state, const Evaluation& evaluation, StressWorkspace& workspace);

    /// Takes the velocity gradient of a pack [1/s], zero in inactive lanes: with respect to the positions in the middle
    /// of the step if stress is to be advanced, otherwise to those at hand. Rotates the old stress if it is to be
    /// advanced.
    void begin(std::size_t pack, const Tensor<Pack>& gradient, std::uint8_t active)
    {
        double* strain = workspace_.strain.data() + pack * 6 * pack_width;
        workspace_.lanes[pack] = active;
        if (evaluation_.stress != StressUpdate::advance) {
            store_symmetric(symmetric_part(gradient), strain);
            return;
        }
        const double dt = evaluation_.time_step;
        double* bond = state_ + pack * rows_ * pack_width;
        const SymmetricTensor<Pack> stress = select(
            lane_mask(active), rotated(load_symmetric(bond), step_rotation(gradient, dt)), SymmetricTensor<Pack>{});
        const SymmetricTensor<Pack> increment = symmetric_part(gradient) * Pack(dt);
        store_symmetric(stress, bond);
        store_symmetric(increment, strain);
        store_pack(0.5 * double_contraction(stress, increment), workspace_.first_work.data() + pack * pack_width);
    }

    /// Calls the material if stresses are to be advanced.
    MaterialStatus update();

    struct Outcome {
        SymmetricTensor<Pack> stress; ///< sigma' + pore_stress() 1; zero in inactive lanes [Pa]
        Pack work;                    ///< `advance`: mean of old and new stress : D dt [J/m3], else stress : D [W/m3]
        Pack dilation;                ///< `advance`: tr D dt [-], else 0
    };
    Outcome end(std::size_t pack) const
    {
        const PackMask active = lane_mask(workspace_.lanes[pack]);
        const SymmetricTensor<Pack> strain = load_symmetric(workspace_.strain.data() + pack * 6 * pack_width);
        Outcome outcome;
        if (evaluation_.stress == StressUpdate::tangent) {
            outcome.stress = select(active, elastic_stress<Pack>({}, strain, bulk_modulus_, shear_modulus_),
                                    SymmetricTensor<Pack>{});
            outcome.work = double_contraction(outcome.stress, strain);
            outcome.dilation = 0.0;
            return outcome;
        }
        SymmetricTensor<Pack> water;
        if (wet_)
            water = SymmetricTensor<Pack>::isotropic(
                pore_stress(load_pack(workspace_.suction.data() + pack * pack_width),
                            load_pack(workspace_.saturation.data() + pack * pack_width)));
        const SymmetricTensor<Pack> stress = load_symmetric(state_ + pack * rows_ * pack_width);
        outcome.stress = select(active, stress + water, SymmetricTensor<Pack>{});
        if (evaluation_.stress == StressUpdate::keep) {
            outcome.work = double_contraction(outcome.stress, strain);
            outcome.dilation = 0.0;
            return outcome;
        }
        const Pack work = load_pack(workspace_.first_work.data() + pack * pack_width) +
                          double_contraction(0.5 * stress + water, strain);
        outcome.work = select(active, work, Pack(0.0));
        outcome.dilation = trace(strain);
        return outcome;
    }

    std::uint8_t active(std::size_t pack) const { return workspace_.lanes[pack]; }

private:
    const Evaluation& evaluation_;
    StressWorkspace& workspace_;
    const Material& material_;
    std::size_t packs_;
    std::size_t rows_;
    double* state_;
    double bulk_modulus_;
    double shear_modulus_;
    bool wet_;
};

} // namespace periporo
