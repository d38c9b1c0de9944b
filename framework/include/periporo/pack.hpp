// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Packs of doubles and the few functions that let a law be written once for `double` and for packs.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>

namespace periporo {

/// As many doubles as one vector register of the target holds.
using Pack = std::experimental::native_simd<double>;
/// The outcome of comparing two packs, lane by lane.
using PackMask = Pack::mask_type;
/// Number of lanes of a Pack.
inline constexpr std::size_t pack_width = Pack::size();
static_assert(pack_width <= 8, "masks of lanes are kept in one byte");

/// The result of comparing two `Real`s: bool for double, PackMask for Pack.
template <class Real>
struct MaskOf {
    using type = bool;
};
template <>
struct MaskOf<Pack> {
    using type = PackMask;
};
template <class Real>
using Mask = typename MaskOf<Real>::type;

/// `a` where the mask holds, `b` elsewhere. Both are evaluated.
inline double select(bool mask, double a, double b)
{
    return mask ? a : b;
}
inline Pack select(const PackMask& mask, const Pack& a, Pack b)
{
    where(mask, b) = a;
    return b;
}

/// True when the mask holds in at least one lane.
inline bool any(bool mask)
{
    return mask;
}
inline bool any(const PackMask& mask)
{
    return std::experimental::any_of(mask);
}

/// True when the mask holds in every lane.
inline bool all(bool mask)
{
    return mask;
}
inline bool all(const PackMask& mask)
{
    return std::experimental::all_of(mask);
}

inline double minimum(double a, double b)
{
    return std::min(a, b);
}
inline Pack minimum(const Pack& a, const Pack& b)
{
    return std::experimental::min(a, b);
}
inline double maximum(double a, double b)
{
    return std::max(a, b);
}
inline Pack maximum(const Pack& a, const Pack& b)
{
    return std::experimental::max(a, b);
}

inline double square_root(double a)
{
    return std::sqrt(a);
}
// g++ 12 takes the undefined source operand of its own AVX-512 square root for a fault of the caller
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
inline Pack square_root(const Pack& a)
{
    return std::experimental::sqrt(a);
}
#pragma GCC diagnostic pop

inline double absolute(double a)
{
    return std::abs(a);
}
inline Pack absolute(const Pack& a)
{
    return std::experimental::abs(a);
}

/// Natural logarithm; the pack version works lane by lane and is meant for set-up code.
inline double logarithm(double a)
{
    return std::log(a);
}
inline Pack logarithm(const Pack& a)
{
    return Pack([&](auto lane) { return std::log(a[lane]); });
}

/// e^a. The pack version reduces the argument to |r| <= ln(2)/2 (Cody and Waite's two-part ln 2), sums the Taylor
/// series to r^13/13!, and scales by 2^n; it agrees with std::exp within 2 units in the last place on [-708, 709]
/// and is held at the ends of that interval outside it.
inline double exponential(double a)
{
    return std::exp(a);
}
inline Pack exponential(const Pack& a)
{
    using Bits = std::experimental::rebind_simd_t<std::int64_t, Pack>;
    static_assert(sizeof(Bits) == sizeof(Pack));
    const Pack x = minimum(maximum(a, Pack(-708.0)), Pack(709.0));
    const Pack round_to_integer = 0x1.8p52; // adding it leaves the nearest integer in the low mantissa bits
    const Pack shifted = x * 0x1.71547652b82fep0 + round_to_integer;
    const Pack n = shifted - round_to_integer;
    // the first part of ln 2 ends in 21 zero bits, so its product with n is exact without fused multiply-add too
    const Pack r = (x - n * 0x1.62e42fee00000p-1) - n * 0x1.a39ef35793c76p-33;
    Pack sum = 1.0 / 6227020800.0; // 1/13!
    for (const double coefficient :
         {1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0,
          1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0})
        sum = sum * r + coefficient;
    Bits bits = std::bit_cast<Bits>(shifted);
    bits = (bits + 1023) << 52;
    return sum * std::bit_cast<Pack>(bits);
}

/// The outcome of a comparison as bits: bit l is lane l.
inline std::uint8_t lane_bits(const PackMask& mask)
{
    return static_cast<std::uint8_t>(mask.__to_bitset().to_ulong());
}

/// Lane `lane` of a value; a double has one lane, whatever is asked for.
inline double lane_of(double a, std::size_t)
{
    return a;
}
inline double lane_of(const Pack& a, std::size_t lane)
{
    return a[lane];
}

} // namespace periporo
