// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Vectors of a pack of bonds, one bond a lane: positions and velocities relative to the point.
#pragma once

#include "operator/transpose.hpp"
#include "periporo/tensor.hpp"

#include <array>

namespace periporo {

/// The components x y z of eight vectors.
using BondVector = std::array<Pack, 3>;

/// Three rows of a pack as a vector, and back.
inline BondVector load_vector(const double* rows)
{
    return {load_pack(rows), load_pack(rows + pack_width), load_pack(rows + 2 * pack_width)};
}
inline void store_vector(const BondVector& v, double* rows)
{
    for (std::size_t c = 0; c < 3; ++c)
        store_pack(v[c], rows + c * pack_width);
}

/// Difference and multiple; named, since the vector is no class of ours for operators to be found by.
inline BondVector minus(const BondVector& a, const BondVector& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline BondVector times(const Pack& f, const BondVector& v)
{
    return {f * v[0], f * v[1], f * v[2]};
}

inline Pack dot(const BondVector& a, const BondVector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// t v
inline BondVector times(const Tensor<Pack>& t, const BondVector& v)
{
    return {t.xx * v[0] + t.xy * v[1] + t.xz * v[2], t.yx * v[0] + t.yy * v[1] + t.yz * v[2],
            t.zx * v[0] + t.zy * v[1] + t.zz * v[2]};
}

/// a (x) b
inline Tensor<Pack> dyad(const BondVector& a, const BondVector& b)
{
    return {a[0] * b[0], a[0] * b[1], a[0] * b[2], a[1] * b[0], a[1] * b[1],
            a[1] * b[2], a[2] * b[0], a[2] * b[1], a[2] * b[2]};
}

} // namespace periporo
