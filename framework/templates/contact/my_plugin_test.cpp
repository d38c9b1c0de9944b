// my plugin: reach, energy, and the speed after a collision.
#include "my_plugin.hpp"

#include <doctest/doctest.h>
#include <periporo/contact_kit.hpp>

#include <numbers>

using namespace periporo;

namespace {

constexpr double stiffness = 1000.0; // [N/m]
constexpr double spacing = 0.01;     // [m]
constexpr double cutoff = 0.8 * spacing;
constexpr double mass = 0.002; // [kg] of each point; the reduced mass is one half

lab::MyPlugin law(double damping_ratio)
{
    Parameters parameters;
    parameters.set("stiffness", stiffness);
    parameters.set("damping_ratio", damping_ratio);
    parameters.set("reach", 0.8);
    parameters.set("friction", 0.3);
    lab::MyPlugin result(parameters);
    result.scale({spacing, 3.015 * spacing});
    return result;
}

ContactResponse response(const lab::MyPlugin& law, double distance, double approach_speed)
{
    const ContactPair pair{distance, approach_speed, 1e-6, 1e-6, mass, mass};
    ContactResponse response;
    law.evaluate({&pair, 1}, {&response, 1});
    return response;
}

/// Speed after over speed before a head-on collision, by small steps (velocity Verlet).
double restitution(double damping_ratio)
{
    const lab::MyPlugin contact = law(damping_ratio);
    const double reduced_mass = 0.5 * mass;
    const double step = 1e-4 * std::sqrt(reduced_mass / stiffness);
    const double speed = 0.1; // [m/s]
    double distance = cutoff, approach = speed;
    do {
        approach -= 0.5 * step * response(contact, distance, approach).force / reduced_mass;
        distance -= step * approach;
        approach -= 0.5 * step * response(contact, distance, approach).force / reduced_mass;
    } while (response(contact, distance, approach).force > 0.0);
    return -approach / speed;
}

} // namespace

TEST_CASE("the law passes the contact kit")
{
    // Momentum, energy, damping, pull, collisions in the steps of a run, the rigid surface, and the parameters.
    for (const double damping_ratio : {0.0, 0.2, 1.0}) {
        const Parameters parameters =
            kit::parameters_of(lab::MyPlugin::parameters(),
                               {{"stiffness", stiffness}, {"damping_ratio", damping_ratio}, {"friction", 0.3}});
        for (const std::string& fault : kit::check_contact_law<lab::MyPlugin>(parameters))
            FAIL_CHECK(fault);
    }
}

TEST_CASE("points that do not overlap do not meet")
{
    const ContactResponse apart = response(law(0.1), 1.001 * cutoff, 1.0);
    CHECK(apart.force == 0.0);
    CHECK(apart.stiffness == 0.0);
    CHECK(apart.energy == 0.0);
}

TEST_CASE("without damping the force is the slope of the stored energy, and the stiffness that of the force")
{
    const lab::MyPlugin contact = law(0.0);
    const double distance = 0.7 * cutoff, probe = 0.01 * cutoff;
    const ContactResponse here = response(contact, distance, 0.5);
    const ContactResponse nearer = response(contact, distance - probe, 0.5);
    const ContactResponse farther = response(contact, distance + probe, 0.5);
    // Central differences of a parabola and of a line are exact; differences of 2 per cent lose two digits.
    CHECK(here.force == doctest::Approx((nearer.energy - farther.energy) / (2.0 * probe)).epsilon(1e-12));
    CHECK(here.stiffness == doctest::Approx((nearer.force - farther.force) / (2.0 * probe)).epsilon(1e-12));
    CHECK(here.damping_force == 0.0);
}

TEST_CASE("the dashpot acts on a rigid surface too, with the mass of the point")
{
    const lab::MyPlugin contact = law(0.5);
    const ContactPair pair{0.9 * cutoff, 0.2, 1e-6, 0.0, mass, 0.0};
    ContactResponse response;
    contact.evaluate({&pair, 1}, {&response, 1});
    CHECK(response.damping_force == doctest::Approx(2.0 * 0.5 * std::sqrt(stiffness * mass) * 0.2).epsilon(1e-12));
}

TEST_CASE("a contact never pulls, however fast the points part")
{
    CHECK(response(law(0.5), 0.99 * cutoff, -100.0).force == 0.0);
}

TEST_CASE("a collision ends with the restitution of a linear dashpot that never pulls")
{
    // The pair parts when the force is zero, at w t = pi - atan(2 b w/(w^2 - b^2)) with b = zeta w0 and
    // w = w0 sqrt(1 - zeta^2), and the speed is then exp(-b t) of the first (Schwager and Poeschel 2007, Granular
    // Matter 9).
    for (const double zeta : {0.0, 0.1, 0.5}) {
        const double w = std::sqrt(1.0 - zeta * zeta); // with w0 = 1
        const double phase = std::numbers::pi - std::atan(2.0 * zeta * w / (w * w - zeta * zeta));
        // About 3e4 steps, each wrong by the half step that the damping force lags behind: 1e-4 at most.
        CHECK(restitution(zeta) == doctest::Approx(std::exp(-zeta / w * phase)).epsilon(1e-4));
    }
}
