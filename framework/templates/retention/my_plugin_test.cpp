// my plugin: the shape of the curve.
#include "my_plugin.hpp"

#include <doctest/doctest.h>

using namespace periporo;

namespace {

constexpr double air_entry = 2000.0; // [Pa]
constexpr double exponent = 0.5;     // lambda
constexpr double porosity = 0.4;

lab::MyPlugin curve()
{
    Parameters parameters;
    parameters.set("air_entry", air_entry);
    parameters.set("pore_size_index", exponent);
    return lab::MyPlugin(parameters);
}

} // namespace

TEST_CASE("soil is saturated up to the suction at which air enters")
{
    for (const double suction : {0.0, 0.5 * air_entry, air_entry})
        CHECK(curve().saturation(suction, porosity) == 1.0);
}

TEST_CASE("beyond air entry the curve is a line of slope -lambda over the logarithms")
{
    for (const double ratio : {2.0, 10.0, 1000.0})
        CHECK(std::log(curve().saturation(ratio * air_entry, porosity)) ==
              doctest::Approx(-exponent * std::log(ratio)).epsilon(1e-14)); // a few roundings
}

TEST_CASE("saturation falls with suction and stays above zero")
{
    double last = 1.0;
    for (double suction = 1.01 * air_entry; suction < 1e9; suction *= 2.0) {
        const double saturation = curve().saturation(suction, porosity);
        CHECK(saturation > 0.0);
        CHECK(saturation < last);
        last = saturation;
    }
}

TEST_CASE("a curve that says so does not change with the porosity")
{
    REQUIRE_FALSE(curve().depends_on_porosity());
    CHECK(curve().saturation(3.0 * air_entry, 0.1) == curve().saturation(3.0 * air_entry, 0.9));
}
