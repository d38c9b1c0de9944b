// my plugin: a ball, and the material points that fill it.
//
// Make it yours: parameters() and the four functions that every geometry has.
#pragma once

#include <periporo/geometry.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace lab {

using namespace periporo;

class MyPlugin : public periporo::Geometry {
public:
    /// What a case gives. Values arrive checked and in SI units; `periporo inspect my_plugin` prints this list.
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("radius", dimension::length, "Radius").above(0.0),
                Parameter::real_list("centre", dimension::length, 3, "Centre")
                    .by_default(std::vector<double>{0.0, 0.0, 0.0})};
    }

    explicit MyPlugin(const Parameters& parameters) : radius_(parameters.real("radius"))
    {
        const std::vector<double>& centre = parameters.real_list("centre");
        centre_ = {centre[0], centre[1], centre[2]};
    }

    /// True inside and on the surface, up to the rounding of a few operations.
    bool contains(const Vector3& position) const override
    {
        return (position - centre_).squaredNorm() <= radius_ * radius_;
    }

    /// The smallest axis-aligned box around the geometry.
    Bounds bounds() const override
    {
        return {centre_ - Vector3::Constant(radius_), centre_ + Vector3::Constant(radius_)};
    }

    /// Exact volume [m3], which the volume of the points is compared with.
    double volume() const override { return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_; }

    /// Whole cubic cells whose centres lie inside. A corner of cells lies in the ball's centre, so that planes through
    /// it cut no cell and each half of the points is the mirror image of the other.
    PointCloud fill(double spacing) const override
    {
        const auto cells = static_cast<long>(std::ceil(radius_ / spacing)); // on each side of the centre
        PointCloud cloud;
        for (long k = -cells; k < cells; ++k)
            for (long j = -cells; j < cells; ++j)
                for (long i = -cells; i < cells; ++i) {
                    const Vector3 offset = spacing * (Vector3(i, j, k) + Vector3::Constant(0.5));
                    if (offset.squaredNorm() < radius_ * radius_)
                        cloud.positions.push_back(centre_ + offset);
                }
        if (cloud.positions.empty()) // the nearest cells are sqrt(3)/2 spacings away
            throw std::runtime_error("my_plugin: no cell fits into the radius of " + std::to_string(radius_) +
                                     " m; the spacing must be below " + std::to_string(2.0 / std::sqrt(3.0) * radius_) +
                                     " m");
        cloud.volumes.assign(cloud.positions.size(), spacing * spacing * spacing);
        return cloud;
    }

private:
    double radius_;
    Vector3 centre_;
};

} // namespace lab
