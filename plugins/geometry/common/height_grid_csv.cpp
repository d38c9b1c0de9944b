// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Height grids in CSV files: a line "x, y, z", then a line per point in any order.
#include "height_grid_formats.hpp"

#include "periporo/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace periporo::geometry {

namespace {

struct CsvPoint {
    std::array<double, 3> position{no_data, no_data, no_data};
    std::size_t line = 0;
};

std::vector<std::string_view> fields_of(std::string_view line)
{
    std::vector<std::string_view> fields;
    for (;;) {
        const std::size_t comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos)
            return fields;
        line.remove_prefix(comma + 1);
    }
}

/// Which of x, y and z each field of a line is.
std::array<std::size_t, 3> csv_axes(const HeightGrid& grid, std::string_view header)
{
    const std::vector<std::string_view> fields = fields_of(header);
    std::array<std::size_t, 3> axes{};
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
        const std::string name(1, static_cast<char>('x' + axis));
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](auto text) { return lower_case(text) == name; });
        if (field == fields.end() || fields.size() != axes.size())
            grid.refuse(fmt::format("line 1 must name the columns, \"x, y, z\" in any order; it is \"{}\"", header));
        axes[static_cast<std::size_t>(field - fields.begin())] = axis;
    }
    return axes;
}

CsvPoint csv_point(const HeightGrid& grid, std::string_view text, std::size_t line,
                   const std::array<std::size_t, 3>& axes)
{
    const std::vector<std::string_view> fields = fields_of(text);
    if (fields.size() != axes.size())
        grid.refuse(fmt::format("line {}: \"{}\" has {} fields, not three", line, text, fields.size()));
    CsvPoint point;
    point.line = line;
    for (std::size_t f = 0; f < axes.size(); ++f) {
        const auto value = number(fields[f]);
        const bool may_lack = axes[f] == 2;
        if ((!value && !(may_lack && fields[f].empty())) || (!may_lack && !std::isfinite(*value)))
            grid.refuse(fmt::format("line {}: \"{}\" is not a {}number", line, fields[f], may_lack ? "" : "finite "));
        point.position[axes[f]] = value && std::isfinite(*value) ? *value : no_data;
    }
    return point;
}

std::vector<CsvPoint> csv_points(const HeightGrid& grid, std::string_view content)
{
    std::vector<CsvPoint> points;
    std::array<std::size_t, 3> axes{};
    for (std::size_t line = 1; !content.empty(); ++line) {
        const std::size_t end = std::min(content.find('\n'), content.size());
        const std::string_view text = trimmed(content.substr(0, end));
        content.remove_prefix(std::min(end + 1, content.size()));
        if (line == 1)
            axes = csv_axes(grid, text);
        else if (!text.empty())
            points.push_back(csv_point(grid, text, line, axes));
    }
    return points;
}

/// The points that share their x or y.
struct CsvLine {
    std::size_t points = 0;
    std::size_t first_line = 0; ///< of the file
};

std::map<double, CsvLine> csv_lines(const std::vector<CsvPoint>& points, std::size_t axis)
{
    std::map<double, CsvLine> lines;
    for (const CsvPoint& point : points) {
        CsvLine& line = lines[point.position[axis]];
        line.first_line = line.points++ == 0 ? point.line : std::min(line.first_line, point.line);
    }
    return lines;
}

/// Takes the places of the lines; each must have a point on each of the `others`.
std::vector<double> complete_lines(const HeightGrid& grid, const std::map<double, CsvLine>& lines, char axis,
                                   std::size_t others)
{
    const auto poorest = std::min_element(
        lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.second.points < b.second.points; });
    if (lines.size() < 2 || others < 2)
        grid.refuse("the points must lie on at least two lines along x and two along y");
    if (poorest->second.points != others)
        grid.refuse(
            fmt::format("line {}: {} = {} is shared by {} of the {} points that it needs; the points must form a "
                        "rectangular grid with a point for every x and every y",
                        poorest->second.first_line, axis, poorest->first, poorest->second.points, others));
    std::vector<double> places;
    for (const auto& [place, line] : lines)
        places.push_back(place);
    return places;
}

} // namespace

void read_csv_grid(HeightGrid& grid, const std::string& content)
{
    std::vector<CsvPoint> points = csv_points(grid, content);
    const auto key = [](const CsvPoint& point) { return std::pair(point.position[1], point.position[0]); };
    std::stable_sort(points.begin(), points.end(),
                     [&](const CsvPoint& a, const CsvPoint& b) { return key(a) < key(b); });
    const auto twice = std::adjacent_find(points.begin(), points.end(),
                                          [&](const CsvPoint& a, const CsvPoint& b) { return key(a) == key(b); });
    if (twice != points.end())
        grid.refuse(fmt::format("line {} has the x and y of line {}", std::next(twice)->line, twice->line));
    const std::map<double, CsvLine> columns = csv_lines(points, 0);
    const std::map<double, CsvLine> rows = csv_lines(points, 1);
    grid.x = complete_lines(grid, columns, 'x', rows.size());
    grid.y = complete_lines(grid, rows, 'y', columns.size());
    for (const CsvPoint& point : points)
        grid.height.push_back(point.position[2]);
}

} // namespace periporo::geometry
