// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Between rows of values of one bond and packs of one value over bonds.
#pragma once

#include "periporo/pack.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <utility>

namespace periporo {

inline Pack load_pack(const double* row)
{
    return Pack(row, std::experimental::vector_aligned);
}
inline void store_pack(const Pack& pack, double* row)
{
    pack.copy_to(row, std::experimental::vector_aligned);
}

namespace detail {

typedef double PackLanes __attribute__((vector_size(sizeof(Pack))));

/// a0 b0 a1 b1 ... of the lower or upper halves of a and b.
template <bool upper, std::size_t... lane>
PackLanes interleaved(PackLanes a, PackLanes b, std::index_sequence<lane...>)
{
    return __builtin_shufflevector(
        a, b, static_cast<int>(lane / 2 + (upper ? pack_width / 2 : 0) + lane % 2 * pack_width)...);
}

} // namespace detail

/// Lane l of pack r becomes lane r of pack l: perfect shuffles of rows, as many as the width has binary digits.
inline void transpose(std::array<Pack, pack_width>& rows)
{
    using detail::PackLanes;
    constexpr auto lanes = std::make_index_sequence<pack_width>();
    std::array<PackLanes, pack_width> a, b;
    for (std::size_t r = 0; r < pack_width; ++r)
        a[r] = std::bit_cast<PackLanes>(rows[r]);
    for (std::size_t stage = 1; stage < pack_width; stage *= 2) {
        for (std::size_t r = 0; r < pack_width / 2; ++r) {
            b[2 * r] = detail::interleaved<false>(a[r], a[r + pack_width / 2], lanes);
            b[2 * r + 1] = detail::interleaved<true>(a[r], a[r + pack_width / 2], lanes);
        }
        a = b;
    }
    for (std::size_t r = 0; r < pack_width; ++r)
        rows[r] = std::bit_cast<Pack>(a[r]);
}

/// The first `values` doubles of one row for each lane, as `values` packs. `row(lane)` gives the start of a row.
template <std::size_t values, class Row>
inline std::array<Pack, values> load_transposed(Row&& row)
{
    static_assert(values % pack_width == 0);
    std::array<Pack, values> packs;
    for (std::size_t first = 0; first < values; first += pack_width) {
        std::array<Pack, pack_width> square;
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            square[lane] = load_pack(row(lane) + first);
        transpose(square);
        for (std::size_t v = 0; v < pack_width; ++v)
            packs[first + v] = square[v];
    }
    return packs;
}

/// The opposite of load_transposed: rows of `values` doubles for pack_width bonds, one after the other.
template <std::size_t values>
inline void store_transposed(const std::array<Pack, values>& packs, double* rows)
{
    static_assert(values % pack_width == 0);
    for (std::size_t first = 0; first < values; first += pack_width) {
        std::array<Pack, pack_width> square;
        for (std::size_t v = 0; v < pack_width; ++v)
            square[v] = packs[first + v];
        transpose(square);
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            store_pack(square[lane], rows + lane * values + first);
    }
}

/// Three packs as one row for each lane: a value of each, then zero.
inline void store_rows_of_lanes(const std::array<Pack, 3>& packs, double* rows)
{
    using detail::PackLanes;
    constexpr auto lanes = std::make_index_sequence<pack_width>();
    const auto x = std::bit_cast<PackLanes>(packs[0]);
    const auto y = std::bit_cast<PackLanes>(packs[1]);
    const auto z = std::bit_cast<PackLanes>(packs[2]);
    const PackLanes zero{};
    const std::array<PackLanes, 2> xz{detail::interleaved<false>(x, z, lanes), detail::interleaved<true>(x, z, lanes)};
    const std::array<PackLanes, 2> y0{detail::interleaved<false>(y, zero, lanes),
                                      detail::interleaved<true>(y, zero, lanes)};
    for (std::size_t half = 0; half < 2; ++half) {
        const PackLanes lower = detail::interleaved<false>(xz[half], y0[half], lanes);
        const PackLanes upper = detail::interleaved<true>(xz[half], y0[half], lanes);
        store_pack(std::bit_cast<Pack>(lower), rows + 2 * half * pack_width);
        store_pack(std::bit_cast<Pack>(upper), rows + (2 * half + 1) * pack_width);
    }
}

} // namespace periporo
