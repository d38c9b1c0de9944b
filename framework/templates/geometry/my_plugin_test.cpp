// my plugin: what is inside, how large it is, and how points fill it.
#include "my_plugin.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

using namespace periporo;

namespace {

constexpr double radius = 0.25; // [m] with these coordinates the tests compute without rounding
const Vector3 centre(1.0, -2.0, 0.5);

lab::MyPlugin ball()
{
    Parameters parameters;
    parameters.set("radius", radius);
    parameters.set("centre", std::vector<double>{centre.x(), centre.y(), centre.z()});
    return lab::MyPlugin(parameters);
}

} // namespace

TEST_CASE("centre and surface belong to the ball, what is farther does not")
{
    CHECK(ball().contains(centre));
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(ball().contains(centre + radius * Vector3::Unit(axis)));
        CHECK_FALSE(ball().contains(centre + 1.001 * radius * Vector3::Unit(axis)));
    }
}

TEST_CASE("the bounds touch the ball on all sides")
{
    const Bounds bounds = ball().bounds();
    CHECK(bounds.lower == centre - Vector3::Constant(radius));
    CHECK(bounds.upper == centre + Vector3::Constant(radius));
}

TEST_CASE("the volume is that of a ball")
{
    // 4/3 pi (1/4)^3, to a few roundings
    CHECK(ball().volume() == doctest::Approx(std::numbers::pi / 48.0).epsilon(1e-15));
}

TEST_CASE("all points lie in the ball and their mirror images are points too")
{
    const PointCloud cloud = ball().fill(radius / 8);
    for (const Vector3& position : cloud.positions) {
        CHECK(ball().contains(position));
        const Vector3 image = 2.0 * centre - position;
        CHECK(std::find(cloud.positions.begin(), cloud.positions.end(), image) != cloud.positions.end());
    }
}

TEST_CASE("the volumes of the points add up to that of the ball")
{
    for (const double spacing : {radius, radius / 2.5, radius / 8}) {
        const PointCloud cloud = ball().fill(spacing);
        const double filled = std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0);
        CHECK(filled == doctest::Approx(ball().volume()).epsilon(1e-12)); // some thousand roundings of 1e-16
    }
}

TEST_CASE("a spacing too large for the ball is refused")
{
    CHECK_THROWS_AS(ball().fill(2.0 * radius), std::runtime_error);
}
