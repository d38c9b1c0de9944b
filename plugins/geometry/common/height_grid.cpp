// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Height grids: read, compared, and cut.
#include "height_grid.hpp"

#include "height_grid_formats.hpp"
#include "periporo/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace periporo::geometry {

namespace {

constexpr double line_tolerance = 1e-6; ///< of the distance between grid lines

std::string content_of(const HeightGrid& grid)
{
    std::ifstream stream(grid.path, std::ios::binary);
    if (!stream)
        grid.refuse("cannot be opened");
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The grid line nearest to a place, and how far away it may be.
struct NearestLine {
    std::size_t index;
    double tolerance;
};

NearestLine nearest_line(const std::vector<double>& lines, double place)
{
    const auto distance = [&](double line) { return std::abs(line - place); };
    const auto nearest =
        std::min_element(lines.begin(), lines.end(), [&](double a, double b) { return distance(a) < distance(b); });
    const auto next = nearest == lines.begin() ? std::next(nearest) : std::prev(nearest);
    return {static_cast<std::size_t>(nearest - lines.begin()), line_tolerance * std::abs(*next - *nearest)};
}

/// First and last of the lines between two places.
std::pair<std::size_t, std::size_t> lines_between(const HeightGrid& grid, const std::vector<double>& lines, char axis,
                                                  double first, double last)
{
    for (const double place : {first, last})
        if (const auto [index, tolerance] = nearest_line(lines, place); !(std::abs(lines[index] - place) <= tolerance))
            grid.refuse(fmt::format("the extent must end on grid lines; {} = {} is none, the nearest is {}", axis,
                                    place, lines[index]));
    if (!(first < last))
        grid.refuse(fmt::format("the extent [x0, y0, x1, y1] must have {0}0 below {0}1; they are {1} and {2}", axis,
                                first, last));
    return {nearest_line(lines, first).index, nearest_line(lines, last).index};
}

void require_same(const HeightGrid& a, const HeightGrid& b, const std::vector<double>& of_a,
                  const std::vector<double>& of_b, char axis)
{
    if (of_a.size() != of_b.size())
        b.refuse(fmt::format("must have the grid lines of {}, but has {} and not {} along {}", a.path, of_b.size(),
                             of_a.size(), axis));
    for (std::size_t i = 0; i < of_a.size(); ++i)
        if (const auto [index, tolerance] = nearest_line(of_a, of_b[i]);
            index != i || std::abs(of_b[i] - of_a[i]) > tolerance)
            b.refuse(fmt::format("must have the grid lines of {}, but has {} = {} where that has {}", a.path, axis,
                                 of_b[i], of_a[i]));
}

} // namespace

std::string HeightGrid::place(std::size_t column, std::size_t row) const
{
    return fmt::format("row {}, column {} (x = {}, y = {})", rows_cut + rows() - row, columns_cut + column + 1,
                       x[column], y[row]);
}

void HeightGrid::refuse(const std::string& what) const
{
    throw std::runtime_error(fmt::format("{}: {}", path, what));
}

HeightGrid read_height_grid(const std::string& path)
{
    HeightGrid grid;
    grid.path = path;
    const std::string format = lower_case(std::filesystem::path(path).extension().string());
    if (format == ".asc")
        read_esri_grid(grid, content_of(grid));
    else if (format == ".csv")
        read_csv_grid(grid, content_of(grid));
    else
        grid.refuse("the ending of a file of heights must be .asc (ESRI ASCII grid) or .csv");
    return grid;
}

HeightGrid cut(const HeightGrid& grid, const std::array<double, 4>& extent)
{
    const auto [west, east] = lines_between(grid, grid.x, 'x', extent[0], extent[2]);
    const auto [south, north] = lines_between(grid, grid.y, 'y', extent[1], extent[3]);
    HeightGrid part;
    part.path = grid.path;
    part.x.assign(grid.x.begin() + west, grid.x.begin() + east + 1);
    part.y.assign(grid.y.begin() + south, grid.y.begin() + north + 1);
    for (std::size_t row = south; row <= north; ++row)
        for (std::size_t column = west; column <= east; ++column)
            part.height.push_back(grid.at(column, row));
    part.columns_cut = grid.columns_cut + west;
    part.rows_cut = grid.rows_cut + grid.rows() - 1 - north;
    return part;
}

void require_same_lines(const HeightGrid& a, const HeightGrid& b)
{
    require_same(a, b, a.x, b.x, 'x');
    require_same(a, b, a.y, b.y, 'y');
}

} // namespace periporo::geometry
