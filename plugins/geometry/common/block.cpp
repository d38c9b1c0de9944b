// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The block lower <= x <= upper in a frame.
#include "block.hpp"

#include "common/distance.hpp"
#include "common/whole_cells.hpp"

#include <utility>

namespace periporo::geometry {

Block::Block(std::string name, std::array<std::string, 3> edges, const Frame& frame, const Bounds& region)
    : name_(std::move(name)), edges_(std::move(edges)), frame_(frame), region_(region),
      scaled_region_(CGAL::ORIGIN + frame.scale() * exact_vector(region.lower),
                     CGAL::ORIGIN + frame.scale() * exact_vector(region.upper))
{
}

bool Block::contains(const Vector3& position) const
{
    if (!position.allFinite())
        return false;
    const Vector3 local = frame_.local(position);
    const double doubt = frame_.doubt(position);
    if ((local.array() < region_.lower.array() - doubt).any() || (local.array() > region_.upper.array() + doubt).any())
        return false;
    if ((local.array() > region_.lower.array() + doubt).all() && (local.array() < region_.upper.array() - doubt).all())
        return true;
    return !scaled_region_.has_on_unbounded_side(frame_.scaled_local(position));
}

PointCloud Block::fill(double spacing) const
{
    const Vector3 size = region_.upper - region_.lower;
    const std::vector<std::size_t> cells =
        whole_cells(name_, {{edges_[0], size.x()}, {edges_[1], size.y()}, {edges_[2], size.z()}}, spacing);
    const auto centre = [&](int direction, std::size_t i) {
        return region_.lower[direction] + size[direction] * static_cast<double>(2 * i + 1) /
                                              static_cast<double>(2 * cells[static_cast<std::size_t>(direction)]);
    };
    const std::size_t count = cells[0] * cells[1] * cells[2];
    PointCloud cloud;
    cloud.positions.reserve(count);
    for (std::size_t k = 0; k < cells[2]; ++k)
        for (std::size_t j = 0; j < cells[1]; ++j)
            for (std::size_t i = 0; i < cells[0]; ++i)
                cloud.positions.push_back(frame_.global({centre(0, i), centre(1, j), centre(2, k)}));
    cloud.volumes.assign(count, volume() / static_cast<double>(count));
    return cloud;
}

double Block::signed_distance(const Vector3& position, Vector3& normal) const
{
    const Vector3 local = frame_.local(position);
    const auto layer = [&](int direction) {
        return distance_from_layer(local[direction], region_.lower[direction], region_.upper[direction],
                                   Vector3::Unit(direction));
    };
    const SignedDistance distance = distance_from_common(distance_from_common(layer(0), layer(1)), layer(2));
    normal = frame_.axes() * distance.outward;
    return distance.value;
}

void Block::find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const
{
    const Vector3 local = frame_.local(position);
    for (int direction = 0; direction < 3; ++direction) {
        const Vector3 axis = frame_.axes().col(direction);
        if (const double above = local[direction] - region_.lower[direction]; above < reach)
            pieces.add(above, axis);
        if (const double below = region_.upper[direction] - local[direction]; below < reach)
            pieces.add(below, -axis);
    }
}

} // namespace periporo::geometry
