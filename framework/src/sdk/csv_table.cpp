// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "periporo/csv_table.hpp"

#include "periporo/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace periporo {
namespace {

/// Without blanks at both ends, and without quotes around the rest.
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

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line, const std::string& reason)
{
    throw std::runtime_error(line > 0 ? fmt::format("{}: line {}: {}", file.string(), line, reason)
                                      : fmt::format("{}: {}", file.string(), reason));
}

/// Where a column stands and what its numbers are multiplied with.
struct Place {
    std::size_t column = 0;
    double unit = 1.0;
};

/// "suction [kPa]" as its name and unit; the unit may be absent.
std::pair<std::string_view, std::string_view> heading(std::string_view cell)
{
    const std::size_t bracket = cell.find('[');
    if (bracket == std::string_view::npos || cell.back() != ']')
        return {cell, {}};
    return {content_of(cell.substr(0, bracket)), content_of(cell.substr(bracket + 1, cell.size() - bracket - 2))};
}

/// "x [m], y [m] and volume [m3]", for a message.
std::string names_of(const std::vector<CsvColumn>& columns)
{
    std::string names;
    for (std::size_t c = 0; c < columns.size(); ++c)
        names += fmt::format("{}{} [{}]",
                             c == 0                   ? ""
                             : c + 1 < columns.size() ? ", "
                                                      : " and ",
                             columns[c].name, si_unit(columns[c].dimension));
    return names;
}

/// @param all columns of the table, for the message
Place find_column(const std::filesystem::path& file, std::size_t line, const std::vector<std::string_view>& header,
                  const CsvColumn& wanted, const std::vector<CsvColumn>& all)
{
    std::optional<Place> found;
    for (std::size_t c = 0; c < header.size(); ++c) {
        const auto [name, unit] = heading(header[c]);
        if (name != wanted.name)
            continue;
        if (found)
            refuse(file, line, fmt::format("two columns are named {}", wanted.name));
        found = Place{c, 1.0};
        if (unit.empty() || unit == "-")
            continue;
        const Quantity one = parse_quantity("1 " + std::string(unit));
        if (one.dimension != wanted.dimension)
            refuse(
                file, line,
                fmt::format("column {} is in {}; it may be in {}", wanted.name, unit, known_units(wanted.dimension)));
        found->unit = one.value;
    }
    if (!found)
        refuse(file, line,
               fmt::format("the header names no column {} [{}]; the first line must name {}", wanted.name,
                           si_unit(wanted.dimension), names_of(all)));
    return *found;
}

} // namespace

std::string CsvTable::place(std::size_t row) const
{
    return fmt::format("{}: line {}", file.string(), lines.at(row));
}

CsvTable read_csv_table(const std::filesystem::path& file, const std::vector<CsvColumn>& columns)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        refuse(file, 0, "cannot be read");
    CsvTable table{file, std::vector<std::vector<double>>(columns.size()), {}, {}};
    std::vector<Place> places;
    std::size_t width = 0; // of the table, 0 before the header
    std::string text;
    for (std::size_t line = 1; std::getline(stream, text); ++line) {
        std::string_view row = text;
        if (line == 1 && row.starts_with("\xef\xbb\xbf")) // the mark that some programs put before UTF-8
            row.remove_prefix(3);
        row = row.substr(0, row.find('#'));
        if (content_of(row).empty())
            continue;
        const std::vector<std::string_view> cells = cells_of(row);
        if (width == 0) {
            width = cells.size();
            try {
                for (const CsvColumn& column : columns)
                    places.push_back(find_column(file, line, cells, column, columns));
                for (const std::string_view cell : cells)
                    if (std::ranges::find(columns, heading(cell).first, &CsvColumn::name) == columns.end())
                        table.unused.emplace_back(heading(cell).first);
            } catch (const std::invalid_argument& fault) { // an unknown unit
                refuse(file, line, fault.what());
            }
            continue;
        }
        if (cells.size() != width)
            refuse(file, line,
                   fmt::format("{} cells, and {} in the header; every row needs a cell for each column", cells.size(),
                               width));
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const std::optional<double> value = number(cells[places[c].column]);
            if (!value || !std::isfinite(*value))
                refuse(
                    file, line,
                    fmt::format("{} is \"{}\", which is no finite number", columns[c].name, cells[places[c].column]));
            table.columns[c].push_back(*value * places[c].unit);
        }
        table.lines.push_back(line);
    }
    if (stream.bad())
        refuse(file, 0, "cannot be read to its end");
    if (width == 0)
        refuse(file, 0, fmt::format("it has no header; the first line must name {}", names_of(columns)));
    return table;
}

} // namespace periporo
