// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Elastic spheres: Hertz's law, and its collisions in closed form.
#include "collision.hpp"
#include "contact/hertz/hertz.hpp"
#include "contact_checks.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

const double spacing = 1e-2;
const ContactScale scale{spacing, 3.015 * spacing, ContactPartner::points};
const ContactScale above_surface{spacing, 3.015 * spacing, ContactPartner::surface};
const double young = 3e6;
const double nu = 0.25;

double ball(double radius)
{
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

const ContactPair pair{0.0, 0.0, ball(5e-3), ball(5e-3), 2e-3, 2e-3};
const ContactPair rigid{0.0, 0.0, ball(5e-3), 0.0, 2e-3, 0.0};

Hertz hertz(double restitution, const ContactScale& lengths)
{
    return made<Hertz>(
        {{"young_modulus", young}, {"poisson_ratio", nu}, {"friction", 0.3}, {"restitution", restitution}}, lengths);
}

/// R*, E* and the reduced mass of a collision, each worked out by hand.
struct Impact {
    Hertz law;
    Side upper;
    Side lower;
    double radius;
    double modulus;
    double mass;
};

std::vector<Impact> impacts(double restitution)
{
    const double alike = young / (2.0 * (1.0 - nu * nu)), one = young / (1.0 - nu * nu);
    const Side point{2e-3, ball(6e-3)};
    return {
        {hertz(restitution, scale), point, {6e-3, ball(3e-3)}, 2e-3, alike, 1.5e-3},
        {hertz(restitution, above_surface), point, {0.0, 0.0, ContactPartner::surface}, 6e-3, one, 2e-3},
        {hertz(restitution, above_surface), point, {6e-3, ball(3e-3), ContactPartner::surface}, 6e-3, alike, 1.5e-3}};
}

} // namespace

TEST_CASE("the force is 4/3 E* R*^(1/2) o^(3/2), with E* and R* of two spheres, or of one on a surface")
{
    for (const Impact& impact : impacts(1.0)) {
        const ContactPair one{0.0, 0.0, impact.upper.volume, impact.lower.volume, impact.upper.mass, impact.lower.mass};
        const double overlap = 7e-4;
        const double expected = 4.0 / 3.0 * impact.modulus * std::sqrt(impact.radius * overlap) * overlap;
        const double distance = impact.law.cutoff() - overlap;
        CHECK(response_at(impact.law, distance, one).force == doctest::Approx(expected).epsilon(1e-12).scale(0.0));
    }
}

TEST_CASE("force and stiffness are the derivatives of the energy, which is the work done")
{
    for (const auto& lengths : {scale, above_surface}) {
        const Hertz contact = hertz(1.0, lengths);
        check_section(contact, pair, 0.0, contact.cutoff());
        check_section(contact, pair, -contact.cutoff(), 0.0); // along the tangent
        check_steepest_at_zero(contact, pair);
        check_reach(hertz(0.5, lengths), pair);
        check_block(hertz(0.5, lengths), pair);
    }
    check_both_ends(hertz(0.5, scale), pair);
    check_block(hertz(0.5, above_surface), rigid);
}

TEST_CASE("points touch at 0.8 spacings, and half a spacing above a surface")
{
    CHECK(hertz(1.0, scale).cutoff() == 0.8 * spacing);
    CHECK(hertz(1.0, above_surface).cutoff() == 0.5 * spacing);
    CHECK(hertz(1.0, scale).friction() == 0.3);
}

TEST_CASE("an elastic collision is as deep and takes as long as Hertz has it")
{
    // m v^2/2 = 2/5 K o^(5/2) gives the depth; the duration is 2 depth/v times the integral of (1 - x^(5/2))^(-1/2)
    // over 0..1, which is B(2/5, 1/2) 2/5: 2.943 depth/v = 2.868 (m^2/(R E*^2 v))^(1/5).
    const double constant = 0.8 * std::beta(0.4, 0.5);
    CHECK(constant == doctest::Approx(2.943).epsilon(1e-4));
    for (const Impact& impact : impacts(1.0))
        for (const double speed : {0.01, 1.0}) {
            const double depth =
                std::pow(15.0 * impact.mass * speed * speed / (16.0 * std::sqrt(impact.radius) * impact.modulus), 0.4);
            REQUIRE(depth < impact.law.cutoff());
            Collision collision(impact.law, impact.upper, impact.lower, impact.law.cutoff(), speed);
            double deepest = 0.0;
            collision.run_until([&](const Collision& now) {
                deepest = std::max(deepest, impact.law.cutoff() - now.distance());
                return now.apart();
            });
            // Verlet: about (omega dt)^2 = 1e-6; the end is seen at the next step, for which it is led back.
            CHECK(deepest == doctest::Approx(depth).epsilon(1e-6).scale(0.0));
            const double late = (collision.distance() - impact.law.cutoff()) / collision.opening_speed();
            CHECK(collision.time() - late == doctest::Approx(constant * depth / speed).epsilon(1e-6).scale(0.0));
            const double law =
                std::pow(impact.mass * impact.mass / (impact.radius * impact.modulus * impact.modulus * speed), 0.2);
            CHECK(collision.time() == doctest::Approx(2.87 * law).epsilon(0.002).scale(0.0));
        }
}

TEST_CASE("the restitution is the one asked for, at every speed")
{
    for (const double restitution : {0.1, 0.5, 0.9})
        for (const Impact& impact : impacts(restitution))
            for (const double speed : {1e-3, 1.0}) {
                Collision collision(impact.law, impact.upper, impact.lower, impact.law.cutoff(), speed);
                collision.run_until([](const Collision& now) { return now.apart(); });
                // Verlet sees a dashpot that sets in as o^(1/4), the more roughly the faster the touch: error of
                // dt^(5/4)
                CHECK(collision.opening_speed() == doctest::Approx(restitution * speed).epsilon(1e-4).scale(0.0));
            }
}
