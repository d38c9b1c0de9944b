// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "heightfield": the ground under a terrain, down to a level, a depth or a second surface.
#include "layer.hpp"

#include "common/height_grid.hpp"
#include "common/surface_distance.hpp"
#include "common/vector.hpp"

#include "periporo/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace periporo::geometry {

namespace {

/// The grid of a file, cut to the extent, with a height everywhere.
HeightGrid read_grid(const Parameters& parameters, const std::string& name)
{
    HeightGrid grid = read_height_grid(parameters.text(name));
    if (parameters.has("extent")) {
        const std::vector<double>& extent = parameters.real_list("extent");
        grid = cut(grid, {extent.at(0), extent.at(1), extent.at(2), extent.at(3)});
    }
    for (std::size_t row = grid.rows(); row-- > 0;)
        for (std::size_t column = 0; column < grid.columns(); ++column)
            if (std::isnan(grid.at(column, row)))
                grid.refuse(fmt::format("there is no height at {}; cut out a rectangle without gaps by \"extent\", or "
                                        "fill them in the program that the grid comes from",
                                        grid.place(column, row)));
    return grid;
}

/// Heights of the underside, in the coordinates of the file.
std::vector<double> bottom_of(const HeightGrid& terrain, const Parameters& parameters)
{
    if (parameters.has("bottom_file")) {
        const HeightGrid bottom = read_grid(parameters, "bottom_file");
        require_same_lines(terrain, bottom);
        return bottom.height;
    }
    if (parameters.has("base"))
        return std::vector<double>(terrain.height.size(), parameters.real("base"));
    std::vector<double> heights = terrain.height;
    for (double& height : heights)
        height -= parameters.real("thickness");
    return heights;
}

void shift(std::vector<double>& coordinates, double distance)
{
    for (double& coordinate : coordinates)
        coordinate += distance;
}

void require_ascending(const HeightGrid& grid, const std::vector<double>& lines, char axis)
{
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (!(lines[i - 1] < lines[i]) || !std::isfinite(lines[i - 1]) || !std::isfinite(lines[i]))
            grid.refuse(fmt::format("the grid lines {0} = {1} and {0} = {2} cannot be told apart; is the shift, or the "
                                    "header of the file, wrong?",
                                    axis, lines[i - 1], lines[i]));
}

void require_thickness(const HeightGrid& terrain, const std::vector<double>& bottom)
{
    for (std::size_t row = terrain.rows(); row-- > 0;)
        for (std::size_t column = 0; column < terrain.columns(); ++column) {
            const double lower = bottom[row * terrain.columns() + column];
            if (!(terrain.at(column, row) > lower))
                terrain.refuse(fmt::format("the terrain must lie above the bottom; at {} it is at {} m and the bottom "
                                           "at {} m",
                                           terrain.place(column, row), terrain.at(column, row), lower));
        }
}

Layer read_layer(const Parameters& parameters)
{
    if (int{parameters.has("base")} + int{parameters.has("thickness")} + int{parameters.has("bottom_file")} != 1)
        throw std::runtime_error("a heightfield needs exactly one of base, thickness and bottom_file");
    HeightGrid terrain = read_grid(parameters, "file");
    std::vector<double> bottom = bottom_of(terrain, parameters);
    require_thickness(terrain, bottom);
    const Vector3 distance = vector(parameters, "shift");
    shift(terrain.x, distance.x());
    shift(terrain.y, distance.y());
    shift(terrain.height, distance.z());
    shift(bottom, distance.z());
    require_ascending(terrain, terrain.x, 'x');
    require_ascending(terrain, terrain.y, 'y');
    require_thickness(terrain, bottom); // whatever the shift rounded off
    return {terrain.x, terrain.y, terrain.height, std::move(bottom)};
}

class HeightField : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        records.push_back(Parameter::file("file", "Heights of the terrain: ESRI ASCII grid (.asc) or x, y, z (.csv)"));
        records.push_back(
            Parameter::real("base", dimension::length, "Level of a flat bottom, as the file counts heights")
                .optional());
        records.push_back(Parameter::real("thickness", dimension::length, "Depth of the bottom below the terrain")
                              .above(0.0)
                              .optional());
        records.push_back(
            Parameter::file("bottom_file", "Heights of the bottom, on the grid lines of the terrain").optional());
        records.push_back(Parameter::real_list("extent", dimension::length, 4,
                                               "Rectangle [x0, y0, x1, y1] to cut out, in the file's coordinates")
                              .optional());
        records.push_back(Parameter::real_list("shift", dimension::length, 3,
                                               "Added to the file's coordinates to make those of the model")
                              .by_default(std::vector<double>{0.0, 0.0, 0.0}));
        return records;
    }

    explicit HeightField(const Parameters& parameters) : layer_(read_layer(parameters)) {}

    bool contains(const Vector3& position) const override { return layer_.contains(position); }
    Bounds bounds() const override { return layer_.bounds(); }
    double volume() const override { return layer_.volume(); }
    bool has_distance() const override { return true; }
    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        const SignedDistance distance = surface().at(position, layer_.contains(position));
        normal = distance.outward;
        return distance.value;
    }

    bool has_pieces() const override { return true; }
    void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        surface().find_pieces(position, reach, pieces);
    }
    void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        surface().find_pieces(position, reach, pieces);
    }

private:
    /// Not made before it is asked for: the triangles of a large terrain take far more memory than its heights.
    const SurfaceDistance& surface() const
    {
        std::call_once(surface_made_, [&] { surface_ = std::make_unique<SurfaceDistance>(layer_.surface()); });
        return *surface_;
    }

    Layer layer_;
    mutable std::once_flag surface_made_;
    mutable std::unique_ptr<const SurfaceDistance> surface_;
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::HeightField, "heightfield",
                "The ground under a terrain, down to a level, a depth or a second surface")
