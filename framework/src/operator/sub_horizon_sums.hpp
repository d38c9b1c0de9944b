// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums over the sub-horizons of one point's bonds: the innermost loop of the operator.
#pragma once

#include "families/sub_horizons.hpp"
#include "operator/transpose.hpp"

#include <algorithm>

namespace periporo {

/// Rows of `values` doubles, one for each bond of a point and three more, and a column of one double each if `tail`.
template <std::size_t values, bool tail>
struct BondRows {
    static_assert(values % pack_width == 0);
    static constexpr std::size_t further_rows = 3;

    AlignedVector<double> rows;
    AlignedVector<double> column;

    /// Room for so many packs of bonds.
    void reserve(std::size_t packs)
    {
        const std::size_t count = packs * pack_width + further_rows;
        if (rows.size() >= count * values)
            return;
        rows.resize(count * values);
        if (tail)
            column.resize(count);
    }
    double* row(std::size_t bond) { return rows.data() + bond * values; }
    const double* row(std::size_t bond) const { return rows.data() + bond * values; }
};

/// sums[b] = sum over the members k of the sub-horizon of bond b of features[k], for every bond of the point and
/// every value of a row; the rows of lanes without a bond are zero. Vectors lie along a row. Row `count` of `features`
/// is used up.
template <std::size_t values, bool tail>
void sum_sub_horizons(const SubHorizonView& sub_horizons, BondRows<values, tail>& features,
                      BondRows<values, tail>& sums)
{
    constexpr std::size_t packs = values / pack_width;
    const std::size_t count = sub_horizons.count;
    std::fill_n(features.row(count), values, 0.0);
    std::fill_n(sums.row(count), values, 0.0);
    std::array<Pack, packs> all;
    for (Pack& sum : all)
        sum = 0.0;
    double all_tail = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t v = 0; v < packs; ++v)
            all[v] += load_pack(features.row(k) + v * pack_width);
        if constexpr (tail)
            all_tail += features.column[k];
    }
    for (std::size_t v = 0; v < packs; ++v)
        store_pack(all[v], sums.row(count + 1) + v * pack_width);
    if constexpr (tail) {
        features.column[count] = 0.0;
        sums.column[count] = 0.0;
        sums.column[count + 1] = all_tail;
    }
    const double* feature = features.rows.data();
    double* const sum = sums.rows.data();
    const double* feature_tail = features.column.data();
    double* const sum_tail = sums.column.data();
    sub_horizons.with_members([&](auto* member) {
        for (std::size_t b = 0; b < count; ++b) {
            const SubHorizonView::Step step = sub_horizons.steps[b];
            // two accumulators: what enters and what leaves do not wait for each other
            std::array<Pack, packs> enter, leave;
            double enter_tail = 0.0;
            double leave_tail = 0.0;
            for (std::size_t v = 0; v < packs; ++v) {
                enter[v] = load_pack(sum + step.from * values + v * pack_width);
                leave[v] = 0.0;
            }
            if constexpr (tail)
                enter_tail = sum_tail[step.from];
            const auto* leaving = member + step.pairs;
            for (const auto* entering = member; entering != leaving; ++entering) {
                const std::size_t in = entering[0];
                const std::size_t out = entering[step.pairs];
#pragma GCC unroll 8
                for (std::size_t v = 0; v < packs; ++v) {
                    enter[v] += load_pack(feature + in * values + v * pack_width);
                    leave[v] += load_pack(feature + out * values + v * pack_width);
                }
                if constexpr (tail) {
                    enter_tail += feature_tail[in];
                    leave_tail += feature_tail[out];
                }
            }
            member = leaving + step.pairs;
            for (std::size_t v = 0; v < packs; ++v)
                store_pack(enter[v] - leave[v], sum + b * values + v * pack_width);
            if constexpr (tail)
                sum_tail[b] = enter_tail - leave_tail;
        }
    });
    const std::size_t lanes = (count + pack_width - 1) / pack_width * pack_width;
    std::fill(sums.row(count), sums.row(lanes), 0.0);
    if constexpr (tail)
        std::fill(sum_tail + count, sum_tail + lanes, 0.0);
}

/// The same for one value a bond: `values` has one double a bond, `sums` gets one a bond.
inline void sum_sub_horizons(const SubHorizonView& sub_horizons, AlignedVector<double>& values,
                             AlignedVector<double>& sums)
{
    const std::size_t count = sub_horizons.count;
    values.resize(count + 1);
    values[count] = 0.0;
    sums.assign(count + 2, 0.0);
    for (std::size_t k = 0; k < count; ++k)
        sums[count + 1] += values[k];
    sub_horizons.with_members([&](auto* member) {
        for (std::size_t b = 0; b < count; ++b) {
            const SubHorizonView::Step step = sub_horizons.steps[b];
            double enter = sums[step.from];
            double leave = 0.0;
            for (std::size_t m = 0; m < step.pairs; ++m, ++member) {
                enter += values[member[0]];
                leave += values[member[step.pairs]];
            }
            member += step.pairs;
            sums[b] = enter - leave;
        }
    });
}

} // namespace periporo
