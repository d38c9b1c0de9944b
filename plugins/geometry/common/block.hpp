// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A rectangular block along the axes of a frame: what "box" and "slab" are.
#pragma once

#include "common/frame.hpp"

#include <CGAL/Iso_cuboid_3.h>

#include <array>
#include <string>

namespace periporo::geometry {

class Block : public Geometry {
public:
    /// @param name of the geometry, for messages
    /// @param edges names of the parameters that give the lengths along the frame's axes, for messages
    /// @param region where the block is, along the axes of the frame
    Block(std::string name, std::array<std::string, 3> edges, const Frame& frame, const Bounds& region);

    bool contains(const Vector3& position) const override;
    Bounds bounds() const override { return frame_.bounds(region_); }
    double volume() const override { return (region_.upper - region_.lower).prod(); }
    /// Whole cells along the axes of the frame.
    PointCloud fill(double spacing) const override;
    bool has_distance() const override { return true; }
    double signed_distance(const Vector3& position, Vector3& normal) const override;
    /// The planes of the faces.
    void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const override;

private:
    std::string name_;
    std::array<std::string, 3> edges_;
    Frame frame_;
    Bounds region_;
    ExactKernel::Iso_cuboid_3 scaled_region_; ///< times the scale of the frame
};

} // namespace periporo::geometry
