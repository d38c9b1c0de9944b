// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Principal values and directions of a symmetric tensor, on packs.
#pragma once

#include "periporo/tensor.hpp"

#include <array>

namespace periporo {

/// Principal values, the largest first, and their directions: a = sum of values[i] e_i (x) e_i to round-off of |a|,
/// also where values are equal.
///
/// Jacobi's method (Golub and Van Loan 2013, section 8.5): each rotation makes one component off the diagonal zero, by
/// the smaller of the two angles that do. Of a million tensors three sweeps over all components leave 3e-5 in the
/// worst, four nothing above round-off; the fifth is a margin. Their number is fixed, so that no lane depends on its
/// neighbours.
template <class Real>
class PrincipalAxes {
public:
    std::array<Real, 3> values;

    explicit PrincipalAxes(const SymmetricTensor<Real>& a) : values{a.xx, a.yy, a.zz}
    {
        Real xy = a.xy, yz = a.yz, xz = a.xz;
        for (int sweep = 0; sweep < 5; ++sweep) {
            rotate<0, 1>(xy, xz, yz);
            rotate<1, 2>(yz, xy, xz);
            rotate<0, 2>(xz, xy, yz);
        }
        order<0, 1>();
        order<1, 2>();
        order<0, 1>();
    }

    /// sum of x[i] e_i (x) e_i. Equal x give exactly x times the identity.
    SymmetricTensor<Real> tensor(const std::array<Real, 3>& x) const
    {
        return SymmetricTensor<Real>::isotropic(x[1]) + dyad(axes_[0]) * Real(x[0] - x[1]) +
               dyad(axes_[2]) * Real(x[2] - x[1]);
    }

private:
    using Axis = std::array<Real, 3>;

    static SymmetricTensor<Real> dyad(const Axis& e)
    {
        return {e[0] * e[0], e[1] * e[1], e[2] * e[2], e[0] * e[1], e[1] * e[2], e[0] * e[2]};
    }

    /// Turns axes i and j so that their component a_ij vanishes; a_ki and a_kj are those with the third axis.
    template <std::size_t i, std::size_t j>
    void rotate(Real& a_ij, Real& a_ki, Real& a_kj)
    {
        const Real difference = values[j] - values[i];
        const Real twice = 2.0 * a_ij;
        const Real length = absolute(difference) + square_root(Real(difference * difference + twice * twice));
        const Real signed_twice = select(difference < Real(0.0), Real(-twice), twice);
        const Real tangent = select(length > Real(0.0), Real(signed_twice / length), Real(0.0));
        const Real cosine = 1.0 / square_root(Real(1.0 + tangent * tangent));
        const Real sine = tangent * cosine;
        values[i] -= tangent * a_ij;
        values[j] += tangent * a_ij;
        a_ij = Real(0.0);
        turn(a_ki, a_kj, cosine, sine);
        for (std::size_t c = 0; c < 3; ++c)
            turn(axes_[i][c], axes_[j][c], cosine, sine);
    }
    static void turn(Real& i, Real& j, const Real& cosine, const Real& sine)
    {
        const Real old_i = i;
        i = cosine * old_i - sine * j;
        j = sine * old_i + cosine * j;
    }

    /// Exchanges axes i and j where value j is larger.
    template <std::size_t i, std::size_t j>
    void order()
    {
        const Mask<Real> exchange = values[j] > values[i];
        const auto ordered = [&](Real& a, Real& b) {
            const Real old_a = a;
            a = select(exchange, b, a);
            b = select(exchange, old_a, b);
        };
        ordered(values[i], values[j]);
        for (std::size_t c = 0; c < 3; ++c)
            ordered(axes_[i][c], axes_[j][c]);
    }

    std::array<Axis, 3> axes_ = {Axis{Real(1.0), Real(0.0), Real(0.0)}, Axis{Real(0.0), Real(1.0), Real(0.0)},
                                 Axis{Real(0.0), Real(0.0), Real(1.0)}};
};

} // namespace periporo
