// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Second-order tensors in three dimensions over `double` or `Pack`, as the operator and the material laws need them.
#pragma once

#include "periporo/pack.hpp"
#include "periporo/vector.hpp"

#include <array>

namespace periporo {

/// Names of the components of a SymmetricTensor, in the order of storage.
inline constexpr const char* symmetric_component_names[6] = {"xx", "yy", "zz", "xy", "yz", "xz"};

/// A symmetric tensor by its six components; stresses are tension-positive [Pa], strains extension-positive [-].
template <class Real>
struct SymmetricTensor {
    Real xx{0.0}, yy{0.0}, zz{0.0}, xy{0.0}, yz{0.0}, xz{0.0};

    static SymmetricTensor isotropic(const Real& value)
    {
        return {value, value, value, Real(0.0), Real(0.0), Real(0.0)};
    }

    SymmetricTensor& operator+=(const SymmetricTensor& o)
    {
        xx += o.xx, yy += o.yy, zz += o.zz, xy += o.xy, yz += o.yz, xz += o.xz;
        return *this;
    }
    SymmetricTensor& operator-=(const SymmetricTensor& o)
    {
        xx -= o.xx, yy -= o.yy, zz -= o.zz, xy -= o.xy, yz -= o.yz, xz -= o.xz;
        return *this;
    }
    SymmetricTensor& operator*=(const Real& f)
    {
        xx *= f, yy *= f, zz *= f, xy *= f, yz *= f, xz *= f;
        return *this;
    }
    friend SymmetricTensor operator+(SymmetricTensor a, const SymmetricTensor& b) { return a += b; }
    friend SymmetricTensor operator-(SymmetricTensor a, const SymmetricTensor& b) { return a -= b; }
    friend SymmetricTensor operator*(SymmetricTensor a, const Real& f) { return a *= f; }
    friend SymmetricTensor operator*(const Real& f, SymmetricTensor a) { return a *= f; }
};

template <class Real>
Real trace(const SymmetricTensor<Real>& a)
{
    return a.xx + a.yy + a.zz;
}

/// a - tr(a)/3 1
template <class Real>
SymmetricTensor<Real> deviator(const SymmetricTensor<Real>& a)
{
    return a - SymmetricTensor<Real>::isotropic(trace(a) * (1.0 / 3.0));
}

/// a : b, both off-diagonal halves counted.
template <class Real>
Real double_contraction(const SymmetricTensor<Real>& a, const SymmetricTensor<Real>& b)
{
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.xz * b.xz);
}

/// Frobenius norm sqrt(a : a).
template <class Real>
Real norm(const SymmetricTensor<Real>& a)
{
    return square_root(double_contraction(a, a));
}

template <class Real>
Real determinant(const SymmetricTensor<Real>& a)
{
    return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) + a.xz * (a.xy * a.yz - a.yy * a.xz);
}

/// The adjugate, that is det(a) a^-1; defined for singular tensors too.
template <class Real>
SymmetricTensor<Real> adjugate(const SymmetricTensor<Real>& a)
{
    return {a.yy * a.zz - a.yz * a.yz, a.xx * a.zz - a.xz * a.xz, a.xx * a.yy - a.xy * a.xy,
            a.yz * a.xz - a.xy * a.zz, a.xy * a.xz - a.xx * a.yz, a.xy * a.yz - a.yy * a.xz};
}

/// `a` in the lanes of the mask, `b` in the others; whatever stands there, not-finite numbers included, is gone.
template <class Real>
SymmetricTensor<Real> select(const Mask<Real>& mask, const SymmetricTensor<Real>& a, const SymmetricTensor<Real>& b)
{
    return {select(mask, a.xx, b.xx), select(mask, a.yy, b.yy), select(mask, a.zz, b.zz),
            select(mask, a.xy, b.xy), select(mask, a.yz, b.yz), select(mask, a.xz, b.xz)};
}

/// A general tensor by rows; `xy` is row x, column y. A velocity gradient has L_xy = dv_x/dy.
template <class Real>
struct Tensor {
    Real xx{0.0}, xy{0.0}, xz{0.0}, yx{0.0}, yy{0.0}, yz{0.0}, zx{0.0}, zy{0.0}, zz{0.0};

    static Tensor identity()
    {
        Tensor t;
        t.xx = t.yy = t.zz = Real(1.0);
        return t;
    }
    Tensor& operator+=(const Tensor& o)
    {
        xx += o.xx, xy += o.xy, xz += o.xz, yx += o.yx, yy += o.yy, yz += o.yz, zx += o.zx, zy += o.zy, zz += o.zz;
        return *this;
    }
    Tensor& operator-=(const Tensor& o)
    {
        xx -= o.xx, xy -= o.xy, xz -= o.xz, yx -= o.yx, yy -= o.yy, yz -= o.yz, zx -= o.zx, zy -= o.zy, zz -= o.zz;
        return *this;
    }
    Tensor& operator*=(const Real& f)
    {
        xx *= f, xy *= f, xz *= f, yx *= f, yy *= f, yz *= f, zx *= f, zy *= f, zz *= f;
        return *this;
    }
    friend Tensor operator+(Tensor a, const Tensor& b) { return a += b; }
    friend Tensor operator*(Tensor a, const Real& f) { return a *= f; }
};

template <class Real>
Tensor<Real> select(const Mask<Real>& mask, const Tensor<Real>& a, const Tensor<Real>& b)
{
    return {select(mask, a.xx, b.xx), select(mask, a.xy, b.xy), select(mask, a.xz, b.xz),
            select(mask, a.yx, b.yx), select(mask, a.yy, b.yy), select(mask, a.yz, b.yz),
            select(mask, a.zx, b.zx), select(mask, a.zy, b.zy), select(mask, a.zz, b.zz)};
}

template <class Real>
Real trace(const Tensor<Real>& a)
{
    return a.xx + a.yy + a.zz;
}

template <class Real>
Tensor<Real> operator*(const Tensor<Real>& a, const Tensor<Real>& b)
{
    return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
            a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
            a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
            a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
            a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

template <class Real>
Tensor<Real> operator*(const Tensor<Real>& a, const SymmetricTensor<Real>& b)
{
    return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
            a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.xy + a.yz * b.xz,
            a.yx * b.xy + a.yy * b.yy + a.yz * b.yz, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
            a.zx * b.xx + a.zy * b.xy + a.zz * b.xz, a.zx * b.xy + a.zy * b.yy + a.zz * b.yz,
            a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/// Components xx yy zz xy yz xz, the order of the rows of a state.
template <class Real>
std::array<Real, 6> components(const SymmetricTensor<Real>& a)
{
    return {a.xx, a.yy, a.zz, a.xy, a.yz, a.xz};
}
/// The symmetric tensor of components xx yy zz xy yz xz: an array, or anything with an index.
template <class Real = double, class Components>
SymmetricTensor<Real> symmetric_tensor(const Components& c)
{
    return {c[0], c[1], c[2], c[3], c[4], c[5]};
}

/// The tensor with the same components as a symmetric one.
template <class Real>
Tensor<Real> full(const SymmetricTensor<Real>& a)
{
    return {a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz};
}

template <class Real>
SymmetricTensor<Real> symmetric_part(const Tensor<Real>& a)
{
    return {a.xx, a.yy, a.zz, 0.5 * (a.xy + a.yx), 0.5 * (a.yz + a.zy), 0.5 * (a.xz + a.zx)};
}

/// b a b^T, the components of `a` after the rotation (or reflection) b.
template <class Real>
SymmetricTensor<Real> rotated(const SymmetricTensor<Real>& a, const Tensor<Real>& b)
{
    const Tensor<Real> t = b * a;
    return {t.xx * b.xx + t.xy * b.xy + t.xz * b.xz, t.yx * b.yx + t.yy * b.yy + t.yz * b.yz,
            t.zx * b.zx + t.zy * b.zy + t.zz * b.zz, t.xx * b.yx + t.xy * b.yy + t.xz * b.yz,
            t.yx * b.zx + t.yy * b.zy + t.yz * b.zz, t.xx * b.zx + t.xy * b.zy + t.xz * b.zz};
}

/// A tensor and its determinant, which its adjugate is to be divided by.
template <class Real>
struct Adjugate {
    Tensor<Real> tensor;
    Real determinant;
};

/// The adjugate of a general tensor, det(a) a^-1; defined for singular tensors too.
template <class Real>
Adjugate<Real> adjugate(const Tensor<Real>& a)
{
    const Real cxx = a.yy * a.zz - a.yz * a.zy;
    const Real cyx = a.yz * a.zx - a.yx * a.zz;
    const Real czx = a.yx * a.zy - a.yy * a.zx;
    return {{cxx, a.xz * a.zy - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy, cyx, a.xx * a.zz - a.xz * a.zx,
             a.xz * a.yx - a.xx * a.yz, czx, a.xy * a.zx - a.xx * a.zy, a.xx * a.yy - a.xy * a.yx},
            a.xx * cxx + a.xy * cyx + a.xz * czx};
}

/// The inverse of a general tensor; the caller knows that it exists.
template <class Real>
Tensor<Real> inverse(const Tensor<Real>& a)
{
    const Adjugate<Real> adjugate_of_a = adjugate(a);
    return adjugate_of_a.tensor * Real(1.0 / adjugate_of_a.determinant);
}

} // namespace periporo
