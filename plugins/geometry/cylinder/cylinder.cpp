// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "cylinder": a right circular cylinder along any axis.
#include "common/distance.hpp"
#include "common/exact.hpp"
#include "common/vector.hpp"
#include "common/whole_cells.hpp"

#include "periporo/geometry.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace periporo::geometry {

namespace {

/// Two directions that make a right-handed frame with the axis. For an axis along z they are x and y.
Eigen::Matrix3d frame_along(const Vector3& axis)
{
    int least = 0;
    axis.cwiseAbs().minCoeff(&least);
    Eigen::Matrix3d frame;
    frame.col(0) = (Vector3::Unit(least) - axis * axis[least]).normalized();
    frame.col(1) = axis.cross(frame.col(0));
    frame.col(2) = axis;
    return frame;
}

class Cylinder : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        records.push_back(Parameter::real("radius", dimension::length, "Radius").above(0.0));
        records.push_back(Parameter::real("height", dimension::length, "Height along the axis").above(0.0));
        records.push_back(Parameter::real_list("origin", dimension::length, 3, "Centre of the base")
                              .by_default(std::vector<double>{0.0, 0.0, 0.0}));
        records.push_back(
            Parameter::real_list("axis", dimension::none, 3, "Direction from the base to the top, of any length")
                .by_default(std::vector<double>{0.0, 0.0, 1.0}));
        return records;
    }

    explicit Cylinder(const Parameters& parameters)
        : radius_(parameters.real("radius")), height_(parameters.real("height")), origin_(vector(parameters, "origin")),
          direction_(direction(parameters, "axis"))
    {
        // Scaled by the largest component first: exact along a coordinate axis, no overflow along any other.
        frame_ = frame_along((direction_ / direction_.lpNorm<Eigen::Infinity>()).normalized());
        exact_origin_ = exact_point(origin_);
        exact_direction_ = exact_vector(direction_);
        exact_length_squared_ = exact_direction_.squared_length();
        exact_radius_bound_ = Exact(radius_) * Exact(radius_) * exact_length_squared_;
        exact_height_bound_ = Exact(height_) * Exact(height_) * exact_length_squared_;
    }

    bool contains(const Vector3& position) const override
    {
        if (!position.allFinite())
            return false;
        const Vector3 local = frame_.transpose() * (position - origin_);
        const double distance = std::hypot(local.x(), local.y());
        // |local - exact local| and |distance - exact distance| are below this.
        const double doubt = rounding * (position.lpNorm<1>() + origin_.lpNorm<1>() + radius_ + height_);
        if (local.z() < -doubt || local.z() > height_ + doubt || distance > radius_ + doubt)
            return false;
        if (local.z() > doubt && local.z() < height_ - doubt && distance < radius_ - doubt)
            return true;
        return contains_exactly(position);
    }

    Bounds bounds() const override
    {
        const Vector3 axis = frame_.col(2);
        const Vector3 top = origin_ + height_ * axis;
        // A circle about the axis a reaches r sqrt(1 - a_x^2) = r sqrt(a_y^2 + a_z^2) along x.
        const Vector3 reach = radius_ * Vector3(std::hypot(axis.y(), axis.z()), std::hypot(axis.z(), axis.x()),
                                                std::hypot(axis.x(), axis.y()));
        return {origin_.cwiseMin(top) - reach, origin_.cwiseMax(top) + reach};
    }

    double volume() const override { return std::numbers::pi * radius_ * radius_ * height_; }

    /// A lattice with a corner of cells in the centre of the base, so that planes through the axis and along the frame
    /// cut no cell and a half or quarter of the cloud is the other's mirror image. The ends cut no cell either.
    PointCloud fill(double spacing) const override
    {
        whole_cells("cylinder", {{"height", height_}}, spacing);
        return fill_by_lattice(*this, spacing,
                               {origin_, frame_, {{-radius_, -radius_, 0.0}, {radius_, radius_, height_}}});
    }

    bool has_distance() const override { return true; }

    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        const Vector3 local = frame_.transpose() * (position - origin_);
        const SignedDistance side{std::hypot(local.x(), local.y()) - radius_,
                                  unit_vector({local.x(), local.y(), 0.0}, Vector3::UnitX())};
        const SignedDistance distance =
            distance_from_common(side, distance_from_layer(local.z(), 0.0, height_, Vector3::UnitZ()));
        normal = frame_ * distance.outward;
        return distance.value;
    }

    /// The wall and the planes of the ends.
    void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        const Vector3 local = frame_.transpose() * (position - origin_);
        if (const double to_wall = radius_ - std::hypot(local.x(), local.y()); to_wall < reach)
            pieces.add(to_wall, frame_ * -unit_vector({local.x(), local.y(), 0.0}, Vector3::UnitX()));
        if (local.z() < reach)
            pieces.add(local.z(), frame_.col(2));
        if (const double to_top = height_ - local.z(); to_top < reach)
            pieces.add(to_top, -frame_.col(2));
    }

private:
    /// With a the axis of any length, t = a.p and p from the base's centre: 0 <= t <= h |a| and |p|^2 |a|^2 - t^2 <=
    /// r^2 |a|^2, squared where a root would stand.
    bool contains_exactly(const Vector3& position) const
    {
        const ExactVector offset = exact_point(position) - exact_origin_;
        const Exact along = offset * exact_direction_;
        if (CGAL::is_negative(along) || along * along > exact_height_bound_)
            return false;
        return offset.squared_length() * exact_length_squared_ - along * along <= exact_radius_bound_;
    }

    double radius_;
    double height_;
    Vector3 origin_;
    Vector3 direction_;
    Eigen::Matrix3d frame_;
    ExactPoint exact_origin_;
    ExactVector exact_direction_;
    Exact exact_length_squared_;
    Exact exact_radius_bound_; ///< r^2 |a|^2
    Exact exact_height_bound_; ///< h^2 |a|^2
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Cylinder, "cylinder", "A right circular cylinder")
