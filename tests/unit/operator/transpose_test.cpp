// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rows of one bond to packs over bonds, and back.
#include "operator/transpose.hpp"
#include "state/aligned.hpp"

#include <doctest/doctest.h>

using namespace periporo;

namespace {

constexpr std::size_t values = 2 * pack_width;

AlignedVector<double> numbered_rows()
{
    AlignedVector<double> rows(pack_width * values);
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        for (std::size_t v = 0; v < values; ++v)
            rows[lane * values + v] = 100.0 * static_cast<double>(lane) + static_cast<double>(v);
    return rows;
}

} // namespace

TEST_CASE("value v of the row of a lane becomes that lane of pack v")
{
    const AlignedVector<double> rows = numbered_rows();
    const auto packs = load_transposed<values>([&](std::size_t lane) { return rows.data() + lane * values; });
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        for (std::size_t v = 0; v < values; ++v)
            CHECK(packs[v][lane] == rows[lane * values + v]);
}

TEST_CASE("rows may lie anywhere, and one may serve several lanes")
{
    const AlignedVector<double> rows = numbered_rows();
    const auto packs = load_transposed<values>([&](std::size_t) { return rows.data() + values; });
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        CHECK(packs[1][lane] == rows[values + 1]);
}

TEST_CASE("storing undoes loading")
{
    const AlignedVector<double> rows = numbered_rows();
    AlignedVector<double> back(rows.size());
    store_transposed<values>(load_transposed<values>([&](std::size_t lane) { return rows.data() + lane * values; }),
                             back.data());
    CHECK(back == rows);
}

TEST_CASE("three packs become a row for each lane: a value of each, then zero")
{
    std::array<Pack, 3> packs;
    for (std::size_t c = 0; c < 3; ++c)
        packs[c] = Pack([&](auto lane) { return 10.0 * static_cast<double>(lane) + static_cast<double>(c) + 1.0; });
    AlignedVector<double> rows(4 * pack_width, -1.0);
    store_rows_of_lanes(packs, rows.data());
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(rows[4 * lane + c] == packs[c][lane]);
        CHECK(rows[4 * lane + 3] == 0.0);
    }
}
