// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums over sub-horizons for a pack of bonds at a time: the innermost loop of the operator.
#pragma once

#include "periporo/pack.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace periporo {

/// For each byte of membership bits a pack of zeros and ones.
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
    return Pack(lane_factors.rows[bits], std::experimental::vector_aligned) > 0.5;
}

/// Distance of the rows of features in memory, for families of up to so many packs. A few fixed values, so that the
/// inner loop is compiled with constant offsets: with a variable one it spends its time moving addresses about.
inline std::size_t row_stride(std::size_t packs)
{
    return std::bit_ceil(std::max<std::size_t>(packs * pack_width, 128));
}

template <std::size_t features, std::size_t stride>
inline std::array<Pack, features> masked_sums_at_stride(const std::uint8_t* membership, std::size_t members,
                                                        std::size_t packs, const double* feature)
{
    std::array<Pack, features> sums;
    for (Pack& sum : sums)
        sum = 0.0;
    for (std::size_t k = 0; k < members; ++k) {
        const Pack factor(lane_factors.rows[membership[k * packs]], std::experimental::vector_aligned);
#pragma GCC unroll 16
        for (std::size_t f = 0; f < features; ++f)
            sums[f] += factor * Pack(feature[f * stride + k]);
    }
    return sums;
}

/// sum over members k with their bit set in column `pack` of `membership` (rows of `packs` bytes) of
/// features[f * row_stride(packs) + k], for every feature f and every lane of the pack. Lanes lie along the bonds, so
/// that the sums arrive as the packs that the tensor algebra and the materials work on; no bit is walked and nothing
/// branches.
/// @throws std::length_error for a family of more than 1024 bonds, which only points on top of each other can have.
template <std::size_t features>
inline std::array<Pack, features> masked_sums(const std::uint8_t* membership, std::size_t members, std::size_t packs,
                                              std::size_t pack, const double* feature)
{
    switch (row_stride(packs)) {
    case 128:
        return masked_sums_at_stride<features, 128>(membership + pack, members, packs, feature);
    case 256:
        return masked_sums_at_stride<features, 256>(membership + pack, members, packs, feature);
    case 512:
        return masked_sums_at_stride<features, 512>(membership + pack, members, packs, feature);
    case 1024:
        return masked_sums_at_stride<features, 1024>(membership + pack, members, packs, feature);
    default:
        throw std::length_error("a family has more than 1024 bonds");
    }
}

} // namespace periporo
