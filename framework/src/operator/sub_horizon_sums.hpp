// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sums over the sub-horizons of one point's bonds: the innermost loop of the operator.
#pragma once

#include "neighbourhood/sub_horizons.hpp"
#include "operator/transpose.hpp"

#include <algorithm>

namespace periporo {

/// Rows of `values` doubles, one for each bond of a point and more, and a column of one double each if `tail`.
template <std::size_t values, bool tail>
struct BondRows {
    static_assert(values % pack_width == 0);

    AlignedVector<double> rows;
    AlignedVector<double> column;

    /// Room for so many packs of bonds.
    void reserve(std::size_t packs)
    {
        const std::size_t count = 3 * packs * pack_width / 2 + 3; // nobody, the twins and the whole family too
        if (rows.size() >= count * values)
            return;
        rows.resize(count * values);
        if (tail)
            column.resize(count);
    }
    double* row(std::size_t bond) { return rows.data() + bond * values; }
    const double* row(std::size_t bond) const { return rows.data() + bond * values; }
};

/// What a column needs before its sums: nobody, the twins and the whole family.
inline void prepare_column(const SubHorizonView& sub_horizons, double* feature, double* sum)
{
    const std::size_t count = sub_horizons.count;
    feature[count] = 0.0;
    double all = feature[2 * sub_horizons.twins()];
    for (std::size_t m = 0; m < sub_horizons.twins(); ++m)
        all += feature[sub_horizons.first_twins() + m] = feature[2 * m] + feature[2 * m + 1];
    sum[count] = 0.0;
    sum[count + 1] = all;
}

/// sums[b] = sum over the members k of the sub-horizon of bond b of features[k], for every bond of the point and
/// every value of a row; the rows of lanes without a bond are zero. Vectors lie along a row. Rows of `features` behind
/// the last bond are used up.
template <std::size_t values, bool tail>
void sum_sub_horizons(const SubHorizonView& sub_horizons, BondRows<values, tail>& features,
                      BondRows<values, tail>& sums)
{
    constexpr std::size_t packs = values / pack_width;
    const std::size_t count = sub_horizons.count;
    double* const feature = features.rows.data();
    double* const sum = sums.rows.data();
    double* const feature_tail = features.column.data();
    double* const sum_tail = sums.column.data();
    std::fill_n(feature + count * values, values, 0.0);
    std::fill_n(sum + count * values, values, 0.0);
    const std::size_t twins = sub_horizons.twins();
    std::array<Pack, packs> all;
    for (std::size_t v = 0; v < packs; ++v) // the last member, when it has no twin
        all[v] = load_pack(feature + 2 * twins * values + v * pack_width);
    for (std::size_t m = 0; m < twins; ++m) {
        const double* const lower = feature + 2 * m * values;
        double* const both = feature + (sub_horizons.first_twins() + m) * values;
        for (std::size_t v = 0; v < packs; ++v) {
            const Pack pair = load_pack(lower + v * pack_width) + load_pack(lower + values + v * pack_width);
            store_pack(pair, both + v * pack_width);
            all[v] += pair;
        }
    }
    for (std::size_t v = 0; v < packs; ++v)
        store_pack(all[v], sum + (count + 1) * values + v * pack_width);
    if constexpr (tail)
        prepare_column(sub_horizons, feature_tail, sum_tail);
    sub_horizons.with_members([&](auto* member) {
        for (std::size_t c = 0; c < count; ++c) {
            const SubHorizonView::Change change = sub_horizons.changes[c];
            // two accumulators: what enters and what leaves do not wait for each other
            std::array<Pack, packs> enter, leave;
            enter.fill(Pack(0.0));
            leave.fill(Pack(0.0));
            double enter_tail = 0.0;
            double leave_tail = 0.0;
            const auto* leaving = member + change.pairs;
            for (const auto* entering = member; entering != leaving; ++entering) {
                const std::size_t in = entering[0];
                const std::size_t out = entering[change.pairs];
                const double* const entered = feature + in * values;
                const double* const left = feature + out * values;
#pragma GCC unroll 8
                for (std::size_t v = 0; v < packs; ++v) {
                    enter[v] += load_pack(entered + v * pack_width);
                    leave[v] += load_pack(left + v * pack_width);
                }
                if constexpr (tail) {
                    enter_tail += feature_tail[in];
                    leave_tail += feature_tail[out];
                }
            }
            member = leaving + change.pairs;
            for (std::size_t v = 0; v < packs; ++v)
                store_pack(enter[v] - leave[v], sum + change.bond * values + v * pack_width);
            if constexpr (tail)
                sum_tail[change.bond] = enter_tail - leave_tail;
        }
    });
    for (std::size_t b = 0; b < count; ++b) {
        const std::size_t from = sub_horizons.from[b];
        for (std::size_t v = 0; v < packs; ++v) {
            double* const row = sum + b * values + v * pack_width;
            store_pack(load_pack(row) + load_pack(sum + from * values + v * pack_width), row);
        }
        if constexpr (tail)
            sum_tail[b] += sum_tail[from];
    }
    const std::size_t lanes = (count + pack_width - 1) / pack_width * pack_width;
    std::fill(sum + count * values, sum + lanes * values, 0.0);
    if constexpr (tail)
        std::fill(sum_tail + count, sum_tail + lanes, 0.0);
}

/// The same for one value a bond: `values` has one double a bond, `sums` gets one a bond.
inline void sum_sub_horizons(const SubHorizonView& sub_horizons, AlignedVector<double>& values,
                             AlignedVector<double>& sums)
{
    const std::size_t count = sub_horizons.count;
    values.resize(sub_horizons.first_twins() + sub_horizons.twins());
    sums.resize(count + 2);
    prepare_column(sub_horizons, values.data(), sums.data());
    sub_horizons.with_members([&](auto* member) {
        for (std::size_t c = 0; c < count; ++c) {
            const SubHorizonView::Change change = sub_horizons.changes[c];
            double enter = 0.0;
            double leave = 0.0;
            for (std::size_t m = 0; m < change.pairs; ++m, ++member) {
                enter += values[member[0]];
                leave += values[member[change.pairs]];
            }
            member += change.pairs;
            sums[change.bond] = enter - leave;
        }
    });
    for (std::size_t b = 0; b < count; ++b)
        sums[b] += sums[sub_horizons.from[b]];
}

} // namespace periporo
