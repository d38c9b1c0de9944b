// my plugin: what holds for every material, and curves with a closed form.
#include "my_plugin.hpp"

#include <periporo/material_kit.hpp>
#include <periporo/material_point.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace periporo;

namespace {

constexpr double bulk_modulus = 1e6;                         // [Pa]
constexpr double shear_modulus = 2e5;                        // [Pa]
constexpr double yield_stress = 300.0;                       // [Pa]
constexpr double viscosity = 50.0;                           // [Pa s]
const double shear_strength = yield_stress / std::sqrt(3.0); // [Pa] tau_y

Parameters parameters()
{
    return kit::parameters_of(lab::MyPlugin::parameters(), {{"bulk_modulus", bulk_modulus},
                                                            {"shear_modulus", shear_modulus},
                                                            {"yield_stress", yield_stress},
                                                            {"viscosity", viscosity}});
}

/// A step of simple shear by gamma: the tensor component is one half of it.
SymmetricTensor<double> simple_shear(double gamma)
{
    return {0.0, 0.0, 0.0, 0.5 * gamma, 0.0, 0.0};
}

} // namespace

TEST_CASE("the law passes the checks of the material kit")
{
    kit::Range range;
    range.pressures = {1e2, 1e3, 1e4};                             // [Pa] the yield stress does not depend on them
    range.stress_ratio = 0.02;                                     // up to q = 200 Pa, inside the yield surface
    range.tension_limit = std::numeric_limits<double>::infinity(); // nothing limits the mean stress of this law
    range.rate_dependent = true;
    for (const std::string& fault : kit::check_law<lab::MyPlugin>(parameters(), range))
        FAIL_CHECK(fault);
}

TEST_CASE("below the yield stress simple shear is elastic")
{
    const LawMaterial<lab::MyPlugin> material(parameters());
    MaterialPoint point(material);
    const double gamma = 0.9 * shear_strength / shear_modulus;
    REQUIRE(point.step(simple_shear(gamma), 1e-3).converged);
    CHECK(point.stress().xy == doctest::Approx(shear_modulus * gamma).epsilon(1e-14)); // a few roundings
    CHECK(point.state(lab::MyPlugin::plastic_shear_strain) == 0.0);
}

TEST_CASE("the start of steady shear follows its closed form")
{
    // From tau = tau_y on, d tau/dt = G (rate - (tau - tau_y)/eta): the stress relaxes towards tau_y + eta rate.
    const double rate = 2.0;                             // [1/s]
    const double relaxation = viscosity / shear_modulus; // [s]
    const double yield_time = shear_strength / (shear_modulus * rate);
    const double step = relaxation / 100.0;
    const LawMaterial<lab::MyPlugin> material(parameters());
    MaterialPoint point(material);
    double largest_difference = 0.0;
    for (double time = step; time < yield_time + 5.0 * relaxation; time += step) {
        REQUIRE(point.step(simple_shear(rate * step), step).converged);
        const double expected =
            time < yield_time ? shear_modulus * rate * time
                              : shear_strength + viscosity * rate * (1.0 - std::exp((yield_time - time) / relaxation));
        largest_difference = std::max(largest_difference, std::abs(point.stress().xy - expected));
    }
    // Backward Euler lags behind an exponential by step/(2 e relaxation) of its height, to first order; 1/e < 1/2.
    CHECK(largest_difference <= viscosity * rate * step / (4.0 * relaxation));
}

TEST_CASE("a strain that is not a number is answered by a failure")
{
    const LawMaterial<lab::MyPlugin> material(parameters());
    MaterialPoint point(material);
    CHECK_FALSE(point.step(simple_shear(std::nan("")), 1e-3).converged);
}
