// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How many whole lattice cells fit along the edges of a geometry, and what to say when none do.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo::geometry {

/// One edge to be divided into cells.
struct Edge {
    std::string name; ///< as the user knows it, "size[0]"
    double length;    ///< [m]
};

/// A number of cells may differ from a whole one by this much; the cells are then stretched to fit.
inline constexpr double whole_cell_tolerance = 1e-6;

/// How many cells of `spacing` the length holds, or nothing when it holds no whole number of them.
inline std::optional<std::size_t> cells_along(double length, double spacing)
{
    const double cells = std::round(length / spacing);
    if (cells < 1.0 || std::abs(length / spacing - cells) > whole_cell_tolerance)
        return std::nullopt;
    return static_cast<std::size_t>(cells);
}

/// The spacing nearest to the wanted one that divides every edge into whole cells; nothing between half and twice the
/// wanted one may.
inline std::optional<double> nearest_fitting_spacing(const std::vector<Edge>& edges, double wanted)
{
    std::optional<double> best;
    const double first = edges.front().length;
    const double search_limit = 1e6; // a search that ends, however fine the spacing
    const auto least = static_cast<long>(std::clamp(std::ceil(0.5 * first / wanted), 1.0, search_limit));
    const auto most = static_cast<long>(std::min(std::floor(2.0 * first / wanted), search_limit));
    for (long cells = least; cells <= most; ++cells) {
        const double spacing = first / static_cast<double>(cells);
        const bool fits_all = std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
            return cells_along(edge.length, spacing).has_value();
        });
        if (fits_all && (!best || std::abs(spacing - wanted) < std::abs(*best - wanted)))
            best = spacing;
    }
    return best;
}

/// Cells along each edge. `what` names the geometry in messages.
/// @throws std::runtime_error when an edge is no whole number of spacings, with the nearest lengths and spacing that
/// would fit.
inline std::vector<std::size_t> whole_cells(const std::string& what, const std::vector<Edge>& edges, double spacing)
{
    if (!(spacing > 0.0) || !std::isfinite(spacing))
        throw std::runtime_error(fmt::format("{}: the spacing must be positive, it is {} m", what, spacing));
    std::vector<std::size_t> cells;
    std::string misfits;
    for (const Edge& edge : edges) {
        if (const auto count = cells_along(edge.length, spacing)) {
            cells.push_back(*count);
            continue;
        }
        const double below = std::floor(edge.length / spacing);
        auto text = std::back_inserter(misfits);
        fmt::format_to(text, "\n  {} = {:.10g} m is {:.7g} cells; ", edge.name, edge.length, edge.length / spacing);
        if (below >= 1.0)
            fmt::format_to(text, "{:.10g} m or ", below * spacing);
        fmt::format_to(text, "{:.10g} m would fit", (below + 1.0) * spacing);
    }
    if (misfits.empty())
        return cells;
    const auto fitting = nearest_fitting_spacing(edges, spacing);
    throw std::runtime_error(
        fmt::format("{} cannot be filled with whole cells of spacing {:.10g} m:{}\n  {}", what, spacing, misfits,
                    fitting ? fmt::format("or a spacing of {:.10g} m, which divides every edge", *fitting)
                            : "no spacing between half and twice this one divides every edge"));
}

} // namespace periporo::geometry
