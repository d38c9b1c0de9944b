// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "box": a rectangular block, which may be turned about its origin.
#include "rotation.hpp"

#include "common/exact.hpp"
#include "common/vector.hpp"
#include "common/whole_cells.hpp"

#include "periporo/geometry.hpp"

#include <CGAL/Iso_cuboid_3.h>

namespace periporo::geometry {

namespace {

class Box : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        records.push_back(
            Parameter::real_list("size", dimension::length, 3, "Edges along the box's own x, y and z").above(0.0));
        records.push_back(Parameter::real_list("origin", dimension::length, 3,
                                               "Corner from which the edges go out; the lower corner when not rotated")
                              .by_default(std::vector<double>{0.0, 0.0, 0.0}));
        records.push_back(
            Parameter::real_list("rotation_axis", dimension::none, 3, "Axis through the origin to rotate about")
                .by_default(std::vector<double>{0.0, 0.0, 1.0}));
        records.push_back(Parameter::real("rotation_angle", dimension::none,
                                          "Right-handed angle about the axis, in radian or \"deg\"")
                              .by_default(0.0));
        return records;
    }

    explicit Box(const Parameters& parameters)
        : size_(vector(parameters, "size")), origin_(vector(parameters, "origin")),
          rotation_(direction(parameters, "rotation_axis"), parameters.real("rotation_angle")),
          exact_origin_(exact_point(origin_)),
          exact_box_(CGAL::ORIGIN, CGAL::ORIGIN + rotation_.scale() * exact_vector(size_))
    {
    }

    bool contains(const Vector3& position) const override
    {
        if (!position.allFinite())
            return false;
        const Vector3 offset = position - origin_;
        const Vector3 local = rotation_.matrix().transpose() * offset;
        // |local - exact local| is below this in every component.
        const double doubt = rounding * (position.lpNorm<1>() + origin_.lpNorm<1>() + size_.maxCoeff());
        if ((local.array() < -doubt).any() || (local.array() > size_.array() + doubt).any())
            return false;
        if ((local.array() > doubt).all() && (local.array() < size_.array() - doubt).all())
            return true;
        return contains_exactly(position);
    }

    Bounds bounds() const override
    {
        // Each edge reaches down or up along each coordinate.
        const Eigen::Matrix3d edges = rotation_.matrix() * size_.asDiagonal();
        return {origin_ + edges.cwiseMin(0.0).rowwise().sum(), origin_ + edges.cwiseMax(0.0).rowwise().sum()};
    }

    double volume() const override { return size_.prod(); }

    PointCloud fill(double spacing) const override
    {
        const std::vector<std::size_t> cells =
            whole_cells("box", {{"size[0]", size_.x()}, {"size[1]", size_.y()}, {"size[2]", size_.z()}}, spacing);
        const auto centre = [&](int direction, std::size_t i) {
            return size_[direction] * static_cast<double>(2 * i + 1) /
                   static_cast<double>(2 * cells[static_cast<std::size_t>(direction)]);
        };
        const std::size_t count = cells[0] * cells[1] * cells[2];
        PointCloud cloud;
        cloud.positions.reserve(count);
        for (std::size_t k = 0; k < cells[2]; ++k)
            for (std::size_t j = 0; j < cells[1]; ++j)
                for (std::size_t i = 0; i < cells[0]; ++i)
                    cloud.positions.push_back(origin_ +
                                              rotation_.matrix() * Vector3(centre(0, i), centre(1, j), centre(2, k)));
        cloud.volumes.assign(count, volume() / static_cast<double>(count));
        return cloud;
    }

private:
    /// The position in the box's own axes times scale(), against the box times scale(): no division, no root.
    bool contains_exactly(const Vector3& position) const
    {
        const ExactVector offset = exact_point(position) - exact_origin_;
        const ExactPoint local(offset * rotation_.exact_axis(0), offset * rotation_.exact_axis(1),
                               offset * rotation_.exact_axis(2));
        return !exact_box_.has_on_unbounded_side(local);
    }

    Vector3 size_;
    Vector3 origin_;
    Rotation rotation_;
    ExactPoint exact_origin_;
    ExactKernel::Iso_cuboid_3 exact_box_;
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Box, "box", "A rectangular block")
