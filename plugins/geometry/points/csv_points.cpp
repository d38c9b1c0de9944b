// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Material points from text with commas.
#include "point_file.hpp"

#include "common/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string_view>

namespace periporo::geometry {

namespace {

constexpr std::array<std::string_view, 4> names{"x", "y", "z", "volume"};

/// A cell without blanks around it and without quotes.
std::string_view content_of(std::string_view cell)
{
    cell = trimmed(cell);
    const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
    return quoted ? cell.substr(1, cell.size() - 2) : cell;
}

std::vector<std::string_view> cells_of(std::string_view line)
{
    std::vector<std::string_view> cells;
    for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
        cells.push_back(content_of(line.substr(0, comma)));
        line.remove_prefix(comma + 1);
    }
    cells.push_back(content_of(line));
    return cells;
}

/// Which column each of the names heads.
std::array<std::size_t, 4> find_columns(PointFile& file, std::string_view header)
{
    const std::vector<std::string_view> cells = cells_of(header);
    std::array<std::size_t, 4> columns{};
    for (std::size_t n = 0; n < names.size(); ++n) {
        const auto count = std::count(cells.begin(), cells.end(), names[n]);
        if (count != 1)
            file.refuse(fmt::format("its header \"{}\" has {} columns named {}; it must name x, y, z [m] and "
                                    "volume [m3] once each, between commas",
                                    trimmed(header), count, names[n]));
        columns[n] = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), names[n]) - cells.begin());
    }
    for (const std::string_view cell : cells)
        if (std::find(names.begin(), names.end(), cell) == names.end())
            file.unused_columns.emplace_back(cell);
    return columns;
}

double value_of(const PointFile& file, std::size_t line, std::string_view name, std::string_view cell)
{
    const std::optional<double> value = number(cell);
    if (!value)
        file.refuse(fmt::format("line {}: {} is \"{}\", which is no number that can be used", line, name, cell));
    return *value;
}

} // namespace

void read_csv(PointFile& file)
{
    std::ifstream stream(file.path, std::ios::binary);
    if (!stream)
        file.refuse("cannot be read");
    std::array<std::size_t, 4> columns{};
    std::size_t width = 0; // of the table, 0 before the header
    std::string text;
    for (std::size_t line = 1; std::getline(stream, text); ++line) {
        std::string_view row = text;
        if (line == 1 && row.starts_with("\xef\xbb\xbf")) // the mark that some programs put before UTF-8
            row.remove_prefix(3);
        if (trimmed(row).empty())
            continue;
        const std::vector<std::string_view> cells = cells_of(row);
        if (width == 0) {
            columns = find_columns(file, row);
            width = cells.size();
            continue;
        }
        if (cells.size() != width)
            file.refuse(fmt::format("line {} has {} cells, and the header {}", line, cells.size(), width));
        std::array<double, 4> values{};
        for (std::size_t n = 0; n < names.size(); ++n)
            values[n] = value_of(file, line, names[n], cells[columns[n]]);
        file.points.positions.emplace_back(values[0], values[1], values[2]);
        file.points.volumes.push_back(values[3]);
        file.lines.push_back(line);
    }
    if (stream.bad())
        file.refuse("cannot be read to its end");
    if (width == 0)
        file.refuse("it has no header, which must name the columns x, y, z [m] and volume [m3]");
}

} // namespace periporo::geometry
