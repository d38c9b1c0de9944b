// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads and writes coordinate planes.
#include "case/plane.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace periporo {

PlaneDescription parse_plane(std::string_view text)
{
    constexpr std::string_view axes = "xyzr";
    const std::size_t equals = text.find('=');
    const std::size_t first = text.find_first_not_of(' ');
    const std::size_t axis = first == std::string_view::npos ? first : axes.find(text[first]);
    if (equals == std::string_view::npos || axis == std::string_view::npos ||
        text.find_first_not_of(' ', first + 1) != equals)
        throw std::invalid_argument(
            fmt::format("\"{}\" is not a plane x, y or z = length, nor a cylinder r = length", text));

    const std::string_view offset_text = text.substr(equals + 1);
    const Quantity offset = parse_quantity(offset_text);
    const bool bare_zero = offset.dimension == dimension::none && offset.value == 0.0;
    if (offset.dimension != dimension::length && !bare_zero)
        throw std::invalid_argument(fmt::format(
            "the offset in \"{}\" is {}, not a length", text,
            offset.dimension == dimension::none ? "without a unit" : "in units of " + si_unit(offset.dimension)));
    if (axis == cylinder_axis && offset.value <= 0.0)
        throw std::invalid_argument(fmt::format("the radius in \"{}\" is not positive", text));
    return {static_cast<int>(axis), offset.value};
}

std::string plane_text(const PlaneDescription& plane)
{
    return fmt::format("{} = {} m", "xyzr"[plane.axis], plane.offset);
}

} // namespace periporo
