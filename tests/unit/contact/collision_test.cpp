// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Collisions under every contact law: momentum, energy, restitution; and the closed forms of the linear ones.
#include "collision.hpp"
#include "contact/adhesive/adhesive.hpp"
#include "contact/contact_bound.hpp"
#include "contact/hertz/hertz.hpp"
#include "contact/penalty/penalty.hpp"
#include "contact/rigid_plane/rigid_plane.hpp"
#include "contact/short_range/short_range.hpp"
#include "contact_checks.hpp"
#include "time/stable_step.hpp"

#include <memory>

using namespace periporo;
using namespace periporo::test;

namespace {

const double spacing = 1e-2;
const double cell = spacing * spacing * spacing;
const double speed = 0.2; // [m/s]

/// A law at work between two sides.
struct Encounter {
    std::string name;
    bool linear; // the force is a spring's as long as it is not zero
    std::shared_ptr<const Contact> law;
    Side lower;
    double mass; // reduced
};

const Side upper{2e-3, cell};

template <class Law>
void add(std::vector<Encounter>& all, const std::string& name, bool linear,
         std::map<std::string, ParameterValue> values, double restitution)
{
    values["friction"] = 0.0;
    values["restitution"] = restitution;
    const Side point{6e-3, 0.8 * cell};
    const Side rigid{0.0, 0.0, ContactPartner::surface};
    const Side deformable{6e-3, 0.8 * cell, ContactPartner::surface};
    for (const Side& lower : {point, rigid, deformable}) {
        if (values.contains("normal") && lower.mass > 0.0)
            continue; // brings its own surface
        const ContactScale lengths{spacing, 3.0 * spacing, lower.kind};
        const bool between_points = lower.kind == ContactPartner::points;
        all.push_back({name + (between_points     ? " between points"
                               : lower.mass > 0.0 ? " on a deformable surface"
                                                  : " on a rigid surface"),
                       linear, std::make_shared<Law>(made<Law>(values, lengths)), lower,
                       lower.mass > 0.0 ? 1.5e-3 : 2e-3});
    }
}

std::vector<Encounter> encounters(double restitution)
{
    std::vector<Encounter> all;
    add<ShortRange>(all, "short_range", true, {{"modulus", 1e6}}, restitution);
    add<Penalty>(all, "penalty", true, {{"normal_stiffness", 1e7}}, restitution);
    add<RigidPlane>(all, "rigid_plane", true,
                    {{"modulus", 1e5}, {"point", std::vector{0.0, 0.0, 0.0}}, {"normal", std::vector{0.0, 0.0, 1.0}}},
                    restitution);
    add<Hertz>(all, "hertz", false, {{"young_modulus", 1e6}, {"poisson_ratio", 0.3}}, restitution);
    add<Adhesive>(all, "adhesive", false, {{"stiffness", 1e3}, {"strength", 100.0}, {"range", 1e-3}}, restitution);
    return all;
}

Collision start(const Encounter& encounter)
{
    return Collision(*encounter.law, upper, encounter.lower, encounter.law->cutoff(), speed);
}

/// Steps that every law is done with a collision in, or has kept what it caught for many periods.
const int long_after = 20000;

/// Runs until the sides are apart.
Collision collide(const Encounter& encounter)
{
    Collision collision = start(encounter);
    collision.run_until([](const Collision& now) { return now.apart(); });
    return collision;
}

/// (k/m)^(1/2) of a linear law [1/s]
double frequency(const Encounter& encounter)
{
    const ContactPair pair{0.0, 0.0, upper.volume, encounter.lower.volume, upper.mass, encounter.lower.mass};
    return std::sqrt(response_at(*encounter.law, 0.0, pair).stiffness / encounter.mass);
}

} // namespace

TEST_CASE("momentum is kept to round-off, and kinetic and stored energy and what the dashpot took stay the same sum")
{
    for (const double restitution : {1.0, 0.5, 0.1})
        for (const Encounter& encounter : encounters(restitution)) {
            CAPTURE(encounter.name);
            CAPTURE(restitution);
            Collision collision = start(encounter);
            const double momentum = collision.momentum();
            const double energy = collision.kinetic() + collision.stored();
            const double time_step = collision.fine_step();
            double most_stored = 0.0;
            double worst = 0.0;
            for (int n = 0; n < long_after; ++n) {
                collision.step(time_step);
                most_stored = std::max(most_stored, std::abs(collision.stored()));
                worst =
                    std::max(worst, std::abs(collision.kinetic() + collision.stored() + collision.damped() - energy));
            }
            CHECK(most_stored > 0.05 * energy); // or the collision would prove little
            CHECK(worst < 3e-6 * energy);       // half of (2 zeta omega dt)^2, which is 6e-6 for a restitution of 0.1
            if (encounter.lower.mass > 0.0)     // 4e4 roundings of 1e-16, seldom all of one sign
                CHECK(collision.momentum() == doctest::Approx(momentum).epsilon(1e-13).scale(0.0));
            if (restitution == 1.0) {
                CHECK(collision.apart());
                CHECK(collision.damped() == 0.0);
                CHECK(collision.opening_speed() == doctest::Approx(speed).epsilon(1e-6).scale(0.0));
            }
        }
}

TEST_CASE("under a linear law a collision is half a sine: duration pi/omega, deepest overlap v/omega")
{
    for (const Encounter& encounter : encounters(1.0)) {
        if (!encounter.linear)
            continue;
        CAPTURE(encounter.name);
        const double omega = frequency(encounter);
        Collision collision = start(encounter);
        double deepest = 0.0;
        collision.run_until([&](const Collision& now) {
            deepest = std::max(deepest, encounter.law->cutoff() - now.distance());
            return now.apart();
        });
        // Verlet: (omega dt)^2/24 = 4e-8, and the end is seen at the next step, for which it is led back
        const double late = (collision.distance() - encounter.law->cutoff()) / collision.opening_speed();
        CHECK(collision.time() - late == doctest::Approx(std::numbers::pi / omega).epsilon(1e-6).scale(0.0));
        CHECK(deepest == doctest::Approx(speed / omega).epsilon(1e-6).scale(0.0));
    }
}

TEST_CASE("the restitution is the one asked for")
{
    for (const double restitution : {0.1, 0.5, 0.9})
        for (const Encounter& encounter : encounters(restitution)) {
            if (encounter.name.starts_with("adhesive"))
                continue; // that of the pressed part alone, see its own tests
            CAPTURE(encounter.name);
            // (omega dt)^2 = 1e-6; under hertz dt^(5/4), as the dashpot sets in as o^(1/4)
            const double bound = encounter.linear ? 3e-6 : 1e-4;
            const double left = collide(encounter).opening_speed();
            CHECK(left == doctest::Approx(restitution * speed).epsilon(bound).scale(0.0));
        }
}

namespace {

/// Speed after over speed before a collision in the leapfrog steps that the stable step allows: 0.3 over the frequency
/// at full overlap, and shorter where the strongest dashpots act.
/// @param phase of the first touch, in steps
double restitution_in_steps(const Encounter& encounter, double phase)
{
    const Contact& law = *encounter.law;
    ContactPair pair{0.0, 0.0, upper.volume, encounter.lower.volume, upper.mass, encounter.lower.mass};
    const ContactSlopes steepest = slopes(law, pair);
    pair.time_step = contact_resolution(true) / std::sqrt(sharpness(pair, steepest));
    double opening_speed = -speed;
    double distance = law.cutoff() + phase * speed * pair.time_step;
    while (distance <= law.cutoff() + speed * pair.time_step) {
        distance += pair.time_step * opening_speed;
        pair.approach_speed = -opening_speed;
        opening_speed += pair.time_step / encounter.mass * response_at(law, distance, pair).force;
    }
    return opening_speed / speed;
}

} // namespace

TEST_CASE("in the steps of a run the restitution is the one asked for within 0.02, whenever the first touch is")
{
    for (const double restitution : {1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 0.05, 0.0})
        for (const Encounter& encounter : encounters(restitution)) {
            if (encounter.name.starts_with("adhesive"))
                continue; // its pull keeps a part
            CAPTURE(encounter.name);
            CAPTURE(restitution);
            const double wanted = std::max(restitution, 0.048); // what the strongest dashpot leaves
            double least = 1.0, largest = 0.0;
            for (int n = 1; n < 20; ++n) {
                const double left = restitution_in_steps(encounter, n / 20.0);
                least = std::min(least, left);
                largest = std::max(largest, left);
            }
            CHECK(least > wanted - 0.02);
            CHECK(largest < wanted + 0.02);
        }
}

TEST_CASE("in the steps of a run a contact at rest has the force of its spring, and no dashpot turns a motion round")
{
    for (const Encounter& encounter : encounters(0.0)) {
        CAPTURE(encounter.name);
        ContactPair pair{0.0, 0.0, upper.volume, encounter.lower.volume, upper.mass, encounter.lower.mass};
        const double distance = 0.7 * encounter.law->cutoff();
        const double spring = response_at(*encounter.law, distance, pair).force;
        for (const double time_step : {1e-6, 1e-4, 1.0}) {
            pair.time_step = time_step;
            pair.approach_speed = 0.0;
            CHECK(response_at(*encounter.law, distance, pair).force == spring);
            pair.approach_speed = 1e-3 * distance / time_step;
            const double change =
                time_step / encounter.mass * response_at(*encounter.law, distance, pair).damping_force;
            CHECK(change > 0.0);
            CHECK(change <= pair.approach_speed * (1.0 + 1e-6)); // round-off of a spring 1e8 times as strong
        }
    }
}

TEST_CASE("no restitution asked for leaves less than 0.05")
{
    for (const Encounter& encounter : encounters(0.0)) {
        CAPTURE(encounter.name);
        if (encounter.name.starts_with("adhesive"))
            continue; // it sticks
        const double left = collide(encounter).opening_speed() / speed;
        CHECK(left > 0.047);
        CHECK(left < 0.05);
    }
}

TEST_CASE("a damped linear contact lasts until its force is gone")
{
    for (const double restitution : {0.1, 0.5, 0.9})
        for (const Encounter& encounter : encounters(restitution)) {
            if (!encounter.linear)
                continue;
            CAPTURE(encounter.name);
            // Schwager and Poeschel (2007): with zeta = sin(a) the force is gone at a phase pi - 2 a
            const double zeta = damping_ratio(restitution);
            const double b = std::sqrt(std::abs(1.0 - zeta * zeta));
            const double duration = 2.0 * (zeta < 1.0 ? std::acos(zeta) : std::acosh(zeta)) / b;
            Collision collision = start(encounter);
            collision.run_until([](const Collision& now) { return now.time() > 0.0 && now.force() <= 0.0; });
            // the fine step is 1e-3/omega, and the end is seen within one
            CHECK(std::abs(collision.time() * frequency(encounter) - duration) < 1.1e-3);
        }
}

TEST_CASE("the damping ratio of some restitutions in closed form")
{
    CHECK(damping_ratio(1.0) == 0.0);
    CHECK(damping_ratio(std::exp(-2.0)) == doctest::Approx(1.0).epsilon(1e-8));
    // acos(1/2)/(3/4)^(1/2) = 2 pi/(3 3^(1/2)), acos(2^(-1/2))/2^(-1/2) = pi/2 2^(-1/2)
    CHECK(damping_ratio(std::exp(-2.0 * std::numbers::pi / (3.0 * std::sqrt(3.0)))) ==
          doctest::Approx(0.5).epsilon(1e-14));
    CHECK(damping_ratio(std::exp(-0.5 * std::numbers::pi)) == doctest::Approx(std::sqrt(0.5)).epsilon(1e-14));
    CHECK(damping_ratio(0.0) == doctest::Approx(2.0).epsilon(1e-14));
    // weak damping: e = 1 - pi zeta
    CHECK(damping_ratio(1.0 - 1e-6) == doctest::Approx(1e-6 / std::numbers::pi).epsilon(1e-5).scale(0.0));
}
