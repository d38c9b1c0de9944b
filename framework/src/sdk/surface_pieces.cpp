// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What geometries answer of their surface unless they know better, and the pieces of a surface.
#include "periporo/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace periporo {
namespace {

/// Two pieces whose distances (over the distance) and normals differ by less are one.
constexpr double rounding = 1e-12;

} // namespace

void SurfacePieces::add(double distance, const Vector3& normal)
{
    const auto end = pieces_.begin() + static_cast<std::ptrdiff_t>(count_);
    const bool known = std::any_of(pieces_.begin(), end, [&](const SurfacePiece& piece) {
        return std::abs(piece.distance - distance) <= rounding * std::abs(distance) &&
               (piece.normal - normal).squaredNorm() <= rounding * rounding;
    });
    if (known)
        return;
    if (count_ < capacity) {
        pieces_[count_++] = {distance, normal};
        return;
    }
    const auto farthest = std::max_element(
        pieces_.begin(), end, [](const SurfacePiece& a, const SurfacePiece& b) { return a.distance < b.distance; });
    if (distance < farthest->distance)
        *farthest = {distance, normal};
}

double Geometry::signed_distance(const Vector3& position, Vector3& normal) const
{
    static_cast<void>(position);
    static_cast<void>(normal);
    throw std::logic_error("this geometry does not know the distance from its surface");
}

void Geometry::find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const
{
    Vector3 normal;
    const double distance = signed_distance(position, normal);
    if (distance < reach)
        pieces.add(distance, normal);
}

void Geometry::find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const
{
    Vector3 normal;
    const double distance = -signed_distance(position, normal);
    if (distance < reach)
        pieces.add(distance, -normal);
}

} // namespace periporo
