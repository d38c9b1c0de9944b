// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Containment, volume and surface of a layer between two surfaces.
#include "layer.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace periporo::geometry {

namespace {

/// The interval of ascending lines that holds the place, with both its ends; the place lies between first and last.
std::size_t interval(const std::vector<double>& lines, double place)
{
    const auto after = std::upper_bound(lines.begin() + 1, lines.end() - 1, place);
    return static_cast<std::size_t>(after - lines.begin()) - 1;
}

} // namespace

Layer::Layer(std::vector<double> x, std::vector<double> y, std::vector<double> top, std::vector<double> bottom)
    : x_(std::move(x)), y_(std::move(y)), top_(std::move(top)), bottom_(std::move(bottom))
{
}

bool Layer::contains(const Vector3& position) const
{
    if (!position.allFinite() || position.x() < x_.front() || position.x() > x_.back() || position.y() < y_.front() ||
        position.y() > y_.back())
        return false;
    return contains_in_cell(interval(x_, position.x()), interval(y_, position.y()), position);
}

bool Layer::contains_in_cell(std::size_t column, std::size_t row, const Vector3& position) const
{
    const std::size_t south_west = at(column, row);
    const std::size_t north_east = at(column + 1, row + 1);
    const double z = position.z();
    // Triangles are no higher and no lower than their corners.
    const std::array<std::size_t, 4> corners{south_west, south_west + 1, north_east - 1, north_east};
    const auto all_top = [&](auto&& fits) {
        return std::all_of(corners.begin(), corners.end(), [&](std::size_t corner) { return fits(top_[corner]); });
    };
    const auto all_bottom = [&](auto&& fits) {
        return std::all_of(corners.begin(), corners.end(), [&](std::size_t corner) { return fits(bottom_[corner]); });
    };
    const auto above = [z](double height) { return z > height; };
    const auto below = [z](double height) { return z < height; };
    if (all_top(above) || all_bottom(below))
        return false;
    if (all_top(below) && all_bottom(above))
        return true;

    using Plane = MeshKernel::Point_2;
    const MeshPoint point = mesh_point(position);
    const bool north_west = CGAL::left_turn(Plane(x_[column], y_[row]), Plane(x_[column + 1], y_[row + 1]),
                                            Plane(position.x(), position.y()));
    const std::pair<std::size_t, std::size_t> third =
        north_west ? std::pair(column, row + 1) : std::pair(column + 1, row);
    const auto side_of = [&](const std::vector<double>& height) {
        const MeshPoint a(x_[column], y_[row], height[south_west]);
        const MeshPoint b(x_[column + 1], y_[row + 1], height[north_east]);
        const MeshPoint c(x_[third.first], y_[third.second], height[at(third.first, third.second)]);
        // Seen from above a, b, c run counter-clockwise in the north-west and clockwise in the south-east.
        const CGAL::Orientation side = CGAL::orientation(a, b, c, point);
        return north_west ? side : -side;
    };
    return side_of(top_) != CGAL::POSITIVE && side_of(bottom_) != CGAL::NEGATIVE;
}

Bounds Layer::bounds() const
{
    return {{x_.front(), y_.front(), *std::min_element(bottom_.begin(), bottom_.end())},
            {x_.back(), y_.back(), *std::max_element(top_.begin(), top_.end())}};
}

double Layer::volume() const
{
    // A triangle covers half its cell, and the mean thickness there is that of its three corners.
    const auto thickness = [&](std::size_t corner) { return top_[corner] - bottom_[corner]; };
    double sum = 0.0;
    for (std::size_t row = 0; row + 1 < y_.size(); ++row) {
        double of_row = 0.0; // summed by itself to keep its digits
        for (std::size_t column = 0; column + 1 < x_.size(); ++column)
            of_row += (x_[column + 1] - x_[column]) / 6.0 *
                      (2.0 * thickness(at(column, row)) + 2.0 * thickness(at(column + 1, row + 1)) +
                       thickness(at(column + 1, row)) + thickness(at(column, row + 1)));
        sum += (y_[row + 1] - y_[row]) * of_row;
    }
    return sum;
}

Mesh Layer::surface() const
{
    Mesh mesh;
    const auto nodes = static_cast<Mesh::size_type>(top_.size());
    mesh.reserve(2 * nodes, 6 * nodes, 4 * nodes);
    for (const std::vector<double>* height : {&top_, &bottom_})
        for (std::size_t row = 0; row < y_.size(); ++row)
            for (std::size_t column = 0; column < x_.size(); ++column)
                mesh.add_vertex(MeshPoint(x_[column], y_[row], (*height)[at(column, row)]));
    const auto upper = [](std::size_t node) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(node)); };
    const auto lower = [&](std::size_t node) { return Mesh::Vertex_index(upper(node) + nodes); };

    const std::size_t columns = x_.size();
    const std::size_t rows = y_.size();
    for (std::size_t row = 0; row + 1 < rows; ++row)
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const std::size_t south_west = at(column, row);
            const std::size_t north_east = at(column + 1, row + 1);
            for (const auto& [b, c] : {std::pair(south_west + 1, north_east), std::pair(north_east, north_east - 1)}) {
                mesh.add_face(upper(south_west), upper(b), upper(c));
                mesh.add_face(lower(south_west), lower(c), lower(b));
            }
        }
    // Between two nodes of the rim, counter-clockwise as seen from above.
    const auto add_side = [&](std::size_t from, std::size_t to) {
        mesh.add_face(lower(from), lower(to), upper(to));
        mesh.add_face(lower(from), upper(to), upper(from));
    };
    for (std::size_t column = 0; column + 1 < columns; ++column) {
        add_side(at(column, 0), at(column + 1, 0));
        add_side(at(column + 1, rows - 1), at(column, rows - 1));
    }
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        add_side(at(columns - 1, row), at(columns - 1, row + 1));
        add_side(at(0, row + 1), at(0, row));
    }
    return mesh;
}

} // namespace periporo::geometry
