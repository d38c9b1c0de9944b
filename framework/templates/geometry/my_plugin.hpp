// my plugin: a ball.
//
// Make it yours: parameters() and the three functions that every geometry has. With these any geometry is filled with
// cubic cells, with its exact volume; a geometry that knows a better way has a fill() of its own. See geometry.hpp.
#pragma once

#include <periporo/geometry.hpp>

#include <numbers>
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

    /// Exact volume [m3], which the volumes of the points add up to.
    double volume() const override { return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_; }

private:
    double radius_;
    Vector3 centre_;
};

} // namespace lab
