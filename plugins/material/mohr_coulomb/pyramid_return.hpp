// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Return of principal stresses to the planes and edges of the Mohr-Coulomb pyramid, in closed form.
#pragma once

#include "periporo/pack.hpp"

#include <array>

namespace periporo {

/// Deviators of the principal stresses, tension-positive, the largest first; mean stress, compression-positive; and the
/// sum of the multipliers of the planes that flow [-].
template <class Real>
struct PrincipalStress {
    std::array<Real, 3> deviator;
    Real pressure;
    Real multiplier;
};

/// With principal stresses s_1 >= s_2 >= s_3 and for the pairs (i, j) = (1, 3), (1, 2), (2, 3),
///     f_ij = (s_i - s_j) + (s_i + s_j) sin(phi) - 2 c cos(phi) <= 0,
/// flow along the potential in which psi stands for phi. One plane, f_13, or one of two edges flows: (1, 3) and (2, 3)
/// where s_1 = s_2 (triaxial extension), (1, 3) and (1, 2) where s_2 = s_3 (triaxial compression). In the sum S of
/// the two multipliers an edge is a plane through the mean of its equal stresses, so all three have the closed form
///     S = <f>/(g G + 4 K sin(phi) sin(psi)),  s = s_trial - 2 G S m,  p = p_trial + 2 K sin(psi) S
/// with, sf = sin(phi), sp = sin(psi),
///     plane        f = f_13               g = 4 (1 + sf sp/3)        m = (1 + sp/3, -2 sp/3, -(1 - sp/3))
///     extension    f = (f_13 + f_23)/2    g = (3 - sf)(1 - sp/3)     m = ((1 - sp/3)/2, (1 - sp/3)/2, -(1 - sp/3))
///     compression  f = (f_13 + f_12)/2    g = (3 + sf)(1 + sp/3)     m = (1 + sp/3, -(1 + sp/3)/2, -(1 + sp/3)/2)
/// (de Souza Neto, Peric and Owen 2008, chapter 8, and Clausen, Damkilde and Andersen 2006, in other symbols.) The
/// edges are needed where the plane alone would end with s_2 > s_1 or with s_2 < s_3. Both multipliers of an edge are
/// then positive: an edge takes the place of the plane because the second plane is violated on it, and of two planes
/// the first couples more weakly to the other than to itself.
///
/// The tip of the pyramid is not known here. Both s_2 > s_1 and s_2 < s_3 hold only beyond it, where every plane and
/// edge ends with p < -c cot(phi): the caller, which limits p, sees it there.
class PyramidReturn {
public:
    /// @param bulk_modulus K [Pa]; 0 for a return at held p
    /// @param shear_modulus G [Pa]
    /// @param shear_strength c cos(phi) [Pa]
    PyramidReturn(double bulk_modulus, double shear_modulus, double sin_friction, double sin_dilatancy,
                  double shear_strength)
        : twice_shear_modulus_(2.0 * shear_modulus), sin_friction_(sin_friction), dilatancy_(sin_dilatancy / 3.0),
          shear_strength_(shear_strength), stiffening_(2.0 * bulk_modulus * sin_dilatancy),
          plane_(4.0 * (1.0 + sin_friction * dilatancy_) * shear_modulus + 2.0 * sin_friction * stiffening_),
          extension_((3.0 - sin_friction) * (1.0 - dilatancy_) * shear_modulus + 2.0 * sin_friction * stiffening_),
          compression_((3.0 + sin_friction) * (1.0 + dilatancy_) * shear_modulus + 2.0 * sin_friction * stiffening_)
    {
    }

    /// @param trial deviators of the trial stress, the largest first [Pa]
    /// @param pressure its mean, compression-positive [Pa]
    template <class Real>
    PrincipalStress<Real> operator()(const std::array<Real, 3>& trial, const Real& pressure) const
    {
        const Real strength = 2.0 * (shear_strength_ + sin_friction_ * pressure);
        const auto [first, second, third] = trial;

        const Real upper = 0.5 * (first + second);
        const Real lower = 0.5 * (second + third);
        const Real plane = multiplier(first, third, strength) * (1.0 / plane_);
        const Real extension = multiplier(upper, third, strength) * (1.0 / extension_);
        const Real compression = multiplier(first, lower, strength) * (1.0 / compression_);

        const auto moved = [&](const Real& stress, const Real& sum, double direction) {
            return Real(stress - (twice_shear_modulus_ * direction) * sum);
        };
        const double more = 1.0 + dilatancy_;
        const double less = 1.0 - dilatancy_;
        const std::array<Real, 3> on_plane = {moved(first, plane, more), moved(second, plane, -2.0 * dilatancy_),
                                              moved(third, plane, -less)};
        const Real equal_upper = moved(upper, extension, 0.5 * less);
        const Real equal_lower = moved(lower, compression, -0.5 * more);
        const Mask<Real> extends = on_plane[1] > on_plane[0];
        const Mask<Real> compresses = on_plane[1] < on_plane[2];

        const auto chosen = [&](const Real& of_plane, const Real& of_extension, const Real& of_compression) {
            return select(extends, of_extension, select(compresses, of_compression, of_plane));
        };
        PrincipalStress<Real> result;
        result.deviator = {chosen(on_plane[0], equal_upper, moved(first, compression, more)),
                           chosen(on_plane[1], equal_upper, equal_lower),
                           chosen(on_plane[2], moved(third, extension, -less), equal_lower)};
        result.multiplier = chosen(plane, extension, compression);
        result.pressure = pressure + stiffening_ * result.multiplier;
        return result;
    }

private:
    /// <f_ij> of two deviators.
    template <class Real>
    Real multiplier(const Real& i, const Real& j, const Real& strength) const
    {
        return maximum(Real((1.0 + sin_friction_) * i - (1.0 - sin_friction_) * j - strength), Real(0.0));
    }

    double twice_shear_modulus_;
    double sin_friction_;
    double dilatancy_; // sin(psi)/3
    double shear_strength_;
    double stiffening_;  // 2 K sin(psi), of p by the multiplier
    double plane_;       // f by the multiplier [Pa]
    double extension_;   // the same on the edge s_1 = s_2
    double compression_; // and on s_2 = s_3
};

} // namespace periporo
