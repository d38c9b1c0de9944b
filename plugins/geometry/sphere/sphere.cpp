// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "sphere": a ball.
#include "common/distance.hpp"
#include "common/exact.hpp"
#include "common/vector.hpp"

#include "periporo/geometry.hpp"

#include <numbers>

namespace periporo::geometry {

namespace {

class Sphere : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("radius", dimension::length, "Radius").above(0.0),
                Parameter::real_list("centre", dimension::length, 3, "Centre")
                    .by_default(std::vector<double>{0.0, 0.0, 0.0})};
    }

    explicit Sphere(const Parameters& parameters)
        : radius_(parameters.real("radius")), centre_(vector(parameters, "centre")),
          exact_centre_(exact_point(centre_)), exact_radius_squared_(Exact(radius_) * Exact(radius_))
    {
    }

    bool contains(const Vector3& position) const override
    {
        if (!position.allFinite())
            return false;
        const double height = (position - centre_).norm() - radius_;
        const double doubt = rounding * (position.lpNorm<1>() + centre_.lpNorm<1>() + radius_);
        if (std::abs(height) > doubt)
            return height < 0.0;
        return CGAL::squared_distance(exact_point(position), exact_centre_) <= exact_radius_squared_;
    }

    Bounds bounds() const override
    {
        return {centre_ - Vector3::Constant(radius_), centre_ + Vector3::Constant(radius_)};
    }

    double volume() const override { return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_; }

    /// A lattice with a corner of cells in the centre, so that all balls of one radius are filled alike, wherever they
    /// are, and planes through the centre cut no cell.
    PointCloud fill(double spacing) const override
    {
        return fill_by_lattice(
            *this, spacing, {.origin = centre_, .bounds = {Vector3::Constant(-radius_), Vector3::Constant(radius_)}});
    }

    bool has_distance() const override { return true; }

    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        const Vector3 offset = position - centre_;
        normal = unit_vector(offset, Vector3::UnitZ());
        return offset.norm() - radius_;
    }

private:
    double radius_;
    Vector3 centre_;
    ExactPoint exact_centre_;
    Exact exact_radius_squared_;
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Sphere, "sphere", "A ball")
