// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds the format of a file of points, and checks what was read.
#include "point_file.hpp"

#include "periporo/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <stdexcept>

namespace periporo::geometry {

namespace {

void require_sound_numbers(const PointFile& file)
{
    const PointCloud& points = file.points;
    for (std::size_t p = 0; p < points.positions.size(); ++p) {
        if (!points.positions[p].allFinite())
            file.refuse(fmt::format("{}: the position ({}, {}, {}) is not finite", file.place(p),
                                    points.positions[p].x(), points.positions[p].y(), points.positions[p].z()));
        if (!(points.volumes[p] > 0.0) || !std::isfinite(points.volumes[p]))
            file.refuse(
                fmt::format("{}: the volume must be positive and finite, not {}", file.place(p), points.volumes[p]));
    }
}

void require_distinct_places(const PointFile& file)
{
    const std::vector<Vector3>& positions = file.points.positions;
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::lexicographical_compare(positions[a].begin(), positions[a].end(), positions[b].begin(),
                                            positions[b].end());
    });
    const auto twin = std::adjacent_find(order.begin(), order.end(),
                                         [&](std::size_t a, std::size_t b) { return positions[a] == positions[b]; });
    if (twin == order.end())
        return;
    const auto [first, second] = std::minmax(twin[0], twin[1]);
    file.refuse(fmt::format("{} and {} put two points at one place, ({:.10g}, {:.10g}, {:.10g})", file.place(first),
                            file.place(second), positions[first].x(), positions[first].y(), positions[first].z()));
}

} // namespace

std::string PointFile::place(std::size_t point) const
{
    return lines.empty() ? fmt::format("point {}", point) : fmt::format("line {}", lines[point]);
}

void PointFile::refuse(const std::string& what) const
{
    throw std::runtime_error(fmt::format("{}: {}", path, what));
}

PointFile read_points(const std::string& path)
{
    PointFile file;
    file.path = path;
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension == ".csv")
        read_csv(file);
    else if (extension == ".h5" || extension == ".hdf5")
        read_hdf5(file);
    else
        file.refuse("points are read from .csv, .h5 and .hdf5 files; which of them this is its name must say");
    if (file.points.positions.empty())
        file.refuse("there are no points in it");
    require_sound_numbers(file);
    require_distinct_places(file);
    return file;
}

} // namespace periporo::geometry
