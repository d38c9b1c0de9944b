// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The name a user probably meant: edit distance over a list of known names.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace periporo {

/// Cost of the cheapest way from one name to the other: 2 for each character inserted, dropped, replaced or swapped
/// with its neighbour, 1 for a letter in the wrong case.
inline std::size_t edit_cost(std::string_view from, std::string_view to)
{
    const auto replace_cost = [](char a, char b) -> std::size_t {
        if (a == b)
            return 0;
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)) ? 1 : 2;
    };
    std::vector<std::size_t> before(to.size() + 1), previous(to.size() + 1), row(to.size() + 1);
    for (std::size_t j = 0; j <= to.size(); ++j)
        row[j] = 2 * j;
    for (std::size_t i = 1; i <= from.size(); ++i) {
        before.swap(previous);
        previous.swap(row);
        row[0] = 2 * i;
        for (std::size_t j = 1; j <= to.size(); ++j) {
            row[j] =
                std::min({previous[j] + 2, row[j - 1] + 2, previous[j - 1] + replace_cost(from[i - 1], to[j - 1])});
            if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 2);
        }
    }
    return row[to.size()];
}

/// The known name nearest to `wanted`, the earlier one of equals, or nothing when none is near enough to be meant:
/// about one wrong character in three is tolerated, or a known name that begins or ends with what was written.
inline std::optional<std::string> nearest_name(std::string_view wanted, const std::vector<std::string>& known)
{
    const std::size_t tolerated = 2 * std::max<std::size_t>(1, (wanted.size() + 1) / 3);
    std::optional<std::string> best;
    std::size_t best_cost = tolerated + 1;
    for (const std::string& name : known) {
        const std::size_t longer = std::max(wanted.size(), name.size()) - std::min(wanted.size(), name.size());
        // Each character too many costs 2, so that a very long name need not be compared letter by letter.
        std::size_t cost = 2 * longer > tolerated ? 2 * longer : edit_cost(wanted, name);
        const bool part = wanted.size() >= 3 && (name.starts_with(wanted) || name.ends_with(wanted));
        if (part)
            cost = std::min(cost, tolerated);
        if (cost < best_cost) {
            best_cost = cost;
            best = name;
        }
    }
    return best;
}

} // namespace periporo
