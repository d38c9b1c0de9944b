// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The cohesive contact: its pull, its work of separation, and who escapes it.
#include "collision.hpp"
#include "contact/adhesive/adhesive.hpp"
#include "contact_checks.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

const double spacing = 1e-2;
const ContactScale scale{spacing, 3.0 * spacing, ContactPartner::points};
const ContactScale above_surface{spacing, 3.0 * spacing, ContactPartner::surface};
const double cell = spacing * spacing * spacing;
const double strength = 2e3;            // [Pa]
const double pull = strength * 1e-4;    // on the face of a cell [N]
const double range = 2.5e-3;            // the default
const double work = 0.5 * pull * range; // of separation [J]
const ContactPair pair{0.0, 0.0, cell, cell, 1.6e-3, 1.6e-3};
const ContactPair rigid{0.0, 0.0, cell, 0.0, 1.6e-3, 0.0};

Adhesive adhesive(std::map<std::string, ParameterValue> values, const ContactScale& lengths)
{
    values["friction"] = 0.3;
    return made<Adhesive>(values, lengths);
}

/// The law used most below: k = 400 N/m, so that the pull is greatest 0.5 mm above the contact distance.
Adhesive adhesive(double restitution, const ContactScale& lengths)
{
    return adhesive({{"stiffness", 400.0}, {"strength", strength}, {"restitution", restitution}}, lengths);
}

double touch(const ContactScale& lengths)
{
    return lengths.partner == ContactPartner::surface ? 0.5 * spacing : 0.8 * spacing;
}

struct Meeting {
    Adhesive law;
    double touch;
    Side upper;
    Side lower;
    double mass; // reduced
};

std::vector<Meeting> meetings(double restitution)
{
    const Side point{2e-3, cell};
    return {
        {adhesive(restitution, scale), touch(scale), point, {6e-3, cell}, 1.5e-3},
        {adhesive(restitution, above_surface), touch(above_surface), point, {0.0, 0.0, ContactPartner::surface}, 2e-3}};
}

} // namespace

TEST_CASE("it pushes and pulls as one spring up to the strength on the face of a cell, and lets go linearly")
{
    for (const auto& lengths : {scale, above_surface}) {
        const Adhesive contact = adhesive(1.0, lengths);
        const double zero = touch(lengths);
        CHECK(contact.cutoff() == zero + range);
        CHECK(contact.friction() == 0.3);
        // 1e-12: distances of 1e-2 against openings of 1e-4
        const auto force = [&](double opening) { return response_at(contact, zero + opening, pair).force; };
        CHECK(force(-1e-3) == doctest::Approx(0.4).epsilon(1e-12));
        CHECK(force(0.25e-3) == doctest::Approx(-0.5 * pull).epsilon(1e-12).scale(0.0));
        CHECK(force(0.5e-3) == doctest::Approx(-pull).epsilon(1e-12).scale(0.0));
        CHECK(force(1.5e-3) == doctest::Approx(-0.5 * pull).epsilon(1e-12).scale(0.0));
    }
}

TEST_CASE("force and stiffness are the derivatives of the energy, which is the work done")
{
    for (const auto& lengths : {scale, above_surface}) {
        const Adhesive contact = adhesive(1.0, lengths);
        const double zero = touch(lengths), peak = zero + 0.5e-3;
        check_section(contact, pair, -0.5 * zero, zero);
        check_section(contact, pair, zero, peak);
        check_section(contact, pair, peak, contact.cutoff());
        CHECK(response_at(contact, zero, pair).energy == doctest::Approx(-work).epsilon(1e-14).scale(0.0));
        check_steepest_at_zero(contact, pair);
        check_reach(adhesive(0.3, lengths), pair);
        check_block(adhesive(0.3, lengths), pair);
    }
    check_both_ends(adhesive(0.3, scale), pair);
    check_both_ends(adhesive({{"modulus", 1e7}, {"strength", 2e3}}, scale), pair);
    check_block(adhesive(0.3, above_surface), rigid);
}

TEST_CASE("the dashpot acts on what is pressed, and never pulls")
{
    const Adhesive contact = adhesive(0.3, scale);
    ContactPair moving = pair;
    for (const double speed : {-5.0, -0.1, 0.1, 5.0}) {
        moving.approach_speed = speed;
        for (const double opening : {0.0, 0.2e-3, 1e-3}) {
            const ContactResponse pulled = response_at(contact, touch(scale) + opening, moving);
            CHECK(pulled.damping_force == 0.0);
            CHECK(pulled.force == response_at(contact, touch(scale) + opening, pair).force);
        }
        const ContactResponse pressed = response_at(contact, 0.9 * touch(scale), moving);
        CHECK(pressed.force >= 0.0);
        CHECK(pressed.damping_force * speed > 0.0);
        const double elastic = response_at(contact, 0.9 * touch(scale), pair).force;
        CHECK(pressed.force == doctest::Approx(elastic + pressed.damping_force).epsilon(1e-14));
    }
}

TEST_CASE("small points with soft springs pull less, so that no part of the law is steeper than the spring")
{
    const Adhesive contact = adhesive({{"modulus", 1e7}, {"strength", 2e3}}, scale);
    ContactPair small = pair;
    small.volume_a *= 0.05;
    small.volume_b *= 0.05;
    const double k = response_at(contact, 0.0, small).stiffness;
    CHECK(0.5 * k * range < strength * std::cbrt(small.volume_a) * std::cbrt(small.volume_a));
    CHECK(response_at(contact, touch(scale) + 0.5 * range, small).force ==
          doctest::Approx(-0.5 * k * range).epsilon(1e-12).scale(0.0));
    check_steepest_at_zero(contact, small);
    check_section(contact, small, touch(scale) + 0.5 * range, contact.cutoff());
}

TEST_CASE("a strength that the spring of a cell cannot pull within the range is refused, with the most that it can")
{
    // k range/2 on a face: 400 N/m x 2.5 mm/2/1 cm^2 = 5 kPa
    CHECK_NOTHROW(adhesive({{"stiffness", 400.0}, {"strength", 4999.0}}, scale));
    CHECK_NOTHROW(adhesive({{"stiffness", 400.0}, {"strength", 9999.0}, {"range", 5e-3}}, scale));
    CHECK_THROWS_WITH_AS(adhesive({{"stiffness", 400.0}, {"strength", 5001.0}}, scale),
                         "contact 'adhesive': its strength of 5001 Pa is too much for its spring, which pulls at most "
                         "5000 Pa, k range/2 on the face of a cell; raise modulus (or stiffness) or range",
                         std::invalid_argument);
}

TEST_CASE("contact distance and range are as given")
{
    const Adhesive contact =
        adhesive({{"stiffness", 400.0}, {"strength", 1e3}, {"contact_distance", 6e-3}, {"range", 1e-3}}, scale);
    CHECK(contact.cutoff() == 7e-3);
    CHECK(response_at(contact, 6e-3, pair).force == 0.0);
    CHECK(response_at(contact, 5.9e-3, pair).force > 0.0);
    CHECK(response_at(contact, 6.1e-3, pair).force < 0.0);
}

TEST_CASE("what parts with less than (2 W/m)^(1/2) comes back, with more it is gone, and slower by W")
{
    for (const Meeting& meeting : meetings(1.0)) {
        const double escape = std::sqrt(2.0 * work / meeting.mass);
        const auto parting = [&](double speed) {
            return Collision(meeting.law, meeting.upper, meeting.lower, meeting.touch, -speed);
        };
        Collision captured = parting(0.999 * escape);
        captured.run_until([](const Collision& now) { return now.opening_speed() < 0.0; });
        CHECK(captured.distance() < meeting.law.cutoff());
        // and swings in its well for ever
        for (int n = 0; n < 100000; ++n) {
            captured.step(captured.fine_step());
            REQUIRE(captured.distance() < meeting.law.cutoff());
        }

        Collision escapes = parting(1.001 * escape);
        escapes.run_until([](const Collision& now) { return now.apart() || now.opening_speed() < 0.0; });
        // 1.001^2 - 1 of the energy is left. Verlet: energy within (omega dt)^2/8 = 1.3e-7 of its largest, over 2e-3
        CHECK(escapes.opening_speed() ==
              doctest::Approx(escape * std::sqrt(1.001 * 1.001 - 1.0)).epsilon(1e-4).scale(0.0));
    }
}

TEST_CASE("restitution is that of the pressed part; what rebounds must still climb out of the pull")
{
    const double restitution = 0.6;
    for (const Meeting& meeting : meetings(restitution)) {
        // v'^2 = e^2 (v^2 + 2 W/m) - 2 W/m; below v^2 = 2 W/m (1/e^2 - 1) it sticks
        const double well = 2.0 * work / meeting.mass;
        const double sticking = std::sqrt(well * (1.0 / (restitution * restitution) - 1.0));
        for (const double factor : {0.99, 1.01, 3.0}) {
            const double speed = factor * sticking;
            // begun at the touch, so that the dashpot sets in between two steps and not within one
            Collision collision(meeting.law, meeting.upper, meeting.lower, meeting.touch,
                                std::sqrt(speed * speed + well));
            bool parting = false;
            collision.run_until([&](const Collision& now) {
                parting = parting || now.opening_speed() > 0.0;
                return now.apart() || (parting && now.opening_speed() < 0.0);
            });
            CHECK(collision.apart() == (factor > 1.0));
            const double left = restitution * restitution * (speed * speed + well) - well;
            // some (omega dt)^2 = 1e-6 of the energy, of which 1/200 is left at 1.01
            if (factor > 1.0)
                CHECK(collision.opening_speed() == doctest::Approx(std::sqrt(left)).epsilon(1e-4).scale(0.0));
        }
    }
}
