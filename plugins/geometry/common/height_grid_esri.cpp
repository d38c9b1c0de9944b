// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// ESRI ASCII grids: a header of six lines, then heights row by row from the north.
#include "height_grid_formats.hpp"

#include "periporo/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace periporo::geometry {

namespace {

/// The words of a text, and the line, from 1, that the last one stood in.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}

    /// Empty at the end.
    std::string_view next()
    {
        constexpr std::string_view blanks = " \t\r\n";
        const std::size_t first = std::min(rest_.find_first_not_of(blanks), rest_.size());
        line_ += static_cast<std::size_t>(std::count(rest_.begin(), rest_.begin() + first, '\n'));
        rest_.remove_prefix(first);
        const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(word.size());
        return word;
    }
    std::size_t line() const { return line_; }

private:
    std::string_view rest_;
    std::size_t line_ = 1;
};

/// Reads "ncols 4", "cellsize 2.5" and so on, up to the first word that is a number, which it returns.
std::string_view read_esri_header(const HeightGrid& grid, Words& words, std::map<std::string, double>& header)
{
    std::string_view word = words.next();
    for (; !word.empty() && !number(word); word = words.next()) {
        const std::string key = lower_case(word);
        const auto known = {"ncols",     "nrows",     "xllcorner", "xllcenter",
                            "yllcorner", "yllcenter", "cellsize",  "nodata_value"};
        if (std::find(known.begin(), known.end(), key) == known.end())
            grid.refuse(fmt::format("line {}: \"{}\" is none of the keys of an ESRI ASCII grid: {}", words.line(), word,
                                    fmt::join(known, ", ")));
        const std::string_view text = words.next();
        const auto value = number(text);
        if (!value)
            grid.refuse(fmt::format("line {}: {} must be a number, it is \"{}\"", words.line(), key, text));
        header[key] = *value;
    }
    return word;
}

double required(const HeightGrid& grid, const std::map<std::string, double>& header, const std::string& key)
{
    const auto entry = header.find(key);
    if (entry == header.end())
        grid.refuse(fmt::format("the header of the ESRI ASCII grid has no {}", key));
    return entry->second;
}

std::size_t count_of(const HeightGrid& grid, const std::map<std::string, double>& header, const std::string& key)
{
    const double value = required(grid, header, key);
    constexpr double most = 1e8;
    if (!(value >= 2.0 && value <= most) || value != std::floor(value))
        grid.refuse(fmt::format("{} must be a whole number from 2 on, it is {}", key, value));
    return static_cast<std::size_t>(value);
}

/// Centres of the cells along x or y.
std::vector<double> centres(const HeightGrid& grid, const std::map<std::string, double>& header, char axis,
                            std::size_t count)
{
    const double size = required(grid, header, "cellsize");
    if (!(size > 0.0) || !std::isfinite(size))
        grid.refuse(fmt::format("cellsize must be positive, it is {}", size));
    const std::string name = std::string(1, axis) + "ll";
    const bool at_centre = header.contains(name + "center");
    const double first = at_centre ? header.at(name + "center") : required(grid, header, name + "corner");
    std::vector<double> lines(count);
    for (std::size_t i = 0; i < count; ++i)
        lines[i] = first + (static_cast<double>(i) + (at_centre ? 0.0 : 0.5)) * size;
    return lines;
}

} // namespace

void read_esri_grid(HeightGrid& grid, const std::string& content)
{
    Words words(content);
    std::map<std::string, double> header;
    std::string_view word = read_esri_header(grid, words, header);
    const std::size_t columns = count_of(grid, header, "ncols");
    const std::size_t rows = count_of(grid, header, "nrows");
    grid.x = centres(grid, header, 'x', columns);
    grid.y = centres(grid, header, 'y', rows);
    const double absent = header.contains("nodata_value") ? header.at("nodata_value") : -9999.0;
    if (columns * rows > content.size())
        grid.refuse(fmt::format("the file is too short for {} rows of {} heights", rows, columns));
    grid.height.resize(columns * rows);
    for (std::size_t row = rows; row-- > 0;)
        for (std::size_t column = 0; column < columns; ++column, word = words.next()) {
            if (word.empty())
                grid.refuse(fmt::format("the file ends before row {}, column {}; its header promises {} rows of {} "
                                        "heights",
                                        rows - row, column + 1, rows, columns));
            const auto value = number(word);
            if (!value)
                grid.refuse(fmt::format("line {}: \"{}\" is not a number", words.line(), word));
            grid.height[row * columns + column] = *value == absent || !std::isfinite(*value) ? no_data : *value;
        }
    if (!word.empty())
        grid.refuse(fmt::format("line {}: there are more heights than the {} rows of {} that the header promises",
                                words.line(), rows, columns));
}

} // namespace periporo::geometry
