// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Packs of doubles and the few functions that let a law be written once for `double` and for packs.
#pragma once

#include "periporo/target.hpp"

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
static_assert(Pack::size() == pack_width);
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
[[gnu::always_inline]] inline double select(bool mask, double a, double b)
{
    return mask ? a : b;
}
[[gnu::always_inline]] inline Pack select(const PackMask& mask, const Pack& a, Pack b)
{
    where(mask, b) = a;
    return b;
}

/// True when the mask holds in at least one lane.
[[gnu::always_inline]] inline bool any(bool mask)
{
    return mask;
}
[[gnu::always_inline]] inline bool any(const PackMask& mask)
{
    return std::experimental::any_of(mask);
}

/// True when the mask holds in every lane.
[[gnu::always_inline]] inline bool all(bool mask)
{
    return mask;
}
[[gnu::always_inline]] inline bool all(const PackMask& mask)
{
    return std::experimental::all_of(mask);
}

[[gnu::always_inline]] inline double minimum(double a, double b)
{
    return std::min(a, b);
}
[[gnu::always_inline]] inline Pack minimum(const Pack& a, const Pack& b)
{
    return std::experimental::min(a, b);
}
[[gnu::always_inline]] inline double maximum(double a, double b)
{
    return std::max(a, b);
}
[[gnu::always_inline]] inline Pack maximum(const Pack& a, const Pack& b)
{
    return std::experimental::max(a, b);
}

[[gnu::always_inline]] inline double square_root(double a)
{
    return std::sqrt(a);
}
// g++ 12 takes the undefined source operand of its own AVX-512 square root for a fault of the caller
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
[[gnu::always_inline]] inline Pack square_root(const Pack& a)
{
    return std::experimental::sqrt(a);
}
#pragma GCC diagnostic pop

[[gnu::always_inline]] inline double absolute(double a)
{
    return std::abs(a);
}
[[gnu::always_inline]] inline Pack absolute(const Pack& a)
{
    return std::experimental::abs(a);
}

/// Natural logarithm; the pack version works lane by lane and is meant for set-up code.
[[gnu::always_inline]] inline double logarithm(double a)
{
    return std::log(a);
}
[[gnu::always_inline]] inline Pack logarithm(const Pack& a)
{
    return Pack([&](auto lane) { return std::log(a[lane]); });
}

/// e^a. The pack version reduces the argument to |r| <= ln(2)/2 (Cody and Waite's two-part ln 2), sums the Taylor
/// series to r^13/13!, and scales by 2^n; it agrees with std::exp within 2 units in the last place on [-708, 709]
/// and is held at the ends of that interval outside it.
[[gnu::always_inline]] inline double exponential(double a)
{
    return std::exp(a);
}
[[gnu::always_inline]] inline Pack exponential(const Pack& a)
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
[[gnu::always_inline]] inline std::uint8_t lane_bits(const PackMask& mask)
{
    return static_cast<std::uint8_t>(mask.__to_bitset().to_ulong());
}

/// Lane `lane` of a value; a double has one lane, whatever is asked for.
[[gnu::always_inline]] inline double lane_of(double a, std::size_t)
{
    return a;
}
[[gnu::always_inline]] inline double lane_of(const Pack& a, std::size_t lane)
{
    return a[lane];
}

/// Two packs that go through a law side by side: the long chains of roots and quotients of one fill the waits of the
/// other.
struct PackPair {
    Pack first, second;

    PackPair() = default;
    [[gnu::always_inline]] PackPair(double value) : first(value), second(value) {}
    [[gnu::always_inline]] PackPair(const Pack& a, const Pack& b) : first(a), second(b) {}
};
/// The outcome of comparing two pairs.
struct PackPairMask {
    PackMask first, second;

    [[gnu::always_inline]] explicit PackPairMask(bool value) : first(value), second(value) {}
    [[gnu::always_inline]] PackPairMask(const PackMask& a, const PackMask& b) : first(a), second(b) {}
};
template <>
struct MaskOf<PackPair> {
    using type = PackPairMask;
};

#define PERIPORO_PAIRWISE(result, operation)                                                                           \
    [[gnu::always_inline]] inline result operator operation(const PackPair& a, const PackPair& b)                      \
    {                                                                                                                  \
        return {a.first operation b.first, a.second operation b.second};                                               \
    }
PERIPORO_PAIRWISE(PackPair, +)
PERIPORO_PAIRWISE(PackPair, -)
PERIPORO_PAIRWISE(PackPair, *)
PERIPORO_PAIRWISE(PackPair, /)
PERIPORO_PAIRWISE(PackPairMask, <)
PERIPORO_PAIRWISE(PackPairMask, <=)
PERIPORO_PAIRWISE(PackPairMask, >)
PERIPORO_PAIRWISE(PackPairMask, >=)
PERIPORO_PAIRWISE(PackPairMask, ==)
PERIPORO_PAIRWISE(PackPairMask, !=)
#undef PERIPORO_PAIRWISE

[[gnu::always_inline]] inline PackPair operator-(const PackPair& a)
{
    return {-a.first, -a.second};
}
[[gnu::always_inline]] inline PackPair& operator+=(PackPair& a, const PackPair& b)
{
    return a = a + b;
}
[[gnu::always_inline]] inline PackPair& operator-=(PackPair& a, const PackPair& b)
{
    return a = a - b;
}
[[gnu::always_inline]] inline PackPair& operator*=(PackPair& a, const PackPair& b)
{
    return a = a * b;
}
[[gnu::always_inline]] inline PackPair& operator/=(PackPair& a, const PackPair& b)
{
    return a = a / b;
}
[[gnu::always_inline]] inline PackPairMask operator&&(const PackPairMask& a, const PackPairMask& b)
{
    return {a.first && b.first, a.second && b.second};
}
[[gnu::always_inline]] inline PackPairMask operator||(const PackPairMask& a, const PackPairMask& b)
{
    return {a.first || b.first, a.second || b.second};
}
[[gnu::always_inline]] inline PackPairMask operator!(const PackPairMask& a)
{
    return {!a.first, !a.second};
}
[[gnu::always_inline]] inline PackPair select(const PackPairMask& mask, const PackPair& a, const PackPair& b)
{
    return {select(mask.first, a.first, b.first), select(mask.second, a.second, b.second)};
}
[[gnu::always_inline]] inline bool any(const PackPairMask& mask)
{
    return any(mask.first || mask.second);
}
[[gnu::always_inline]] inline bool all(const PackPairMask& mask)
{
    return all(mask.first && mask.second);
}
[[gnu::always_inline]] inline PackPair minimum(const PackPair& a, const PackPair& b)
{
    return {minimum(a.first, b.first), minimum(a.second, b.second)};
}
[[gnu::always_inline]] inline PackPair maximum(const PackPair& a, const PackPair& b)
{
    return {maximum(a.first, b.first), maximum(a.second, b.second)};
}
[[gnu::always_inline]] inline PackPair square_root(const PackPair& a)
{
    return {square_root(a.first), square_root(a.second)};
}
[[gnu::always_inline]] inline PackPair absolute(const PackPair& a)
{
    return {absolute(a.first), absolute(a.second)};
}
[[gnu::always_inline]] inline PackPair logarithm(const PackPair& a)
{
    return {logarithm(a.first), logarithm(a.second)};
}
[[gnu::always_inline]] inline PackPair exponential(const PackPair& a)
{
    return {exponential(a.first), exponential(a.second)};
}
/// Lanes of the first pack, then of the second.
[[gnu::always_inline]] inline double lane_of(const PackPair& a, std::size_t lane)
{
    return lane < pack_width ? a.first[lane] : a.second[lane - pack_width];
}

} // namespace periporo
