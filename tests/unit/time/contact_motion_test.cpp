// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact in motion against closed forms.
#include "contact/rigid_plane/rigid_plane.hpp"
#include "contact/short_range/short_range.hpp"
#include "support/specimens.hpp"
#include "time/dynamics.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace specimens;

namespace {

constexpr double dx = 0.01;

Parameters law_parameters(double stiffness, double friction)
{
    Parameters parameters;
    parameters.set("stiffness", stiffness);
    parameters.set("friction", friction);
    parameters.set("restitution", 1.0);
    return parameters;
}

/// Two grains of different bodies on a line, too few for a family.
Model two_grains(double gap)
{
    Model model = from_positions({{0.0, 0.0, 0.0}, {gap, 0.0, 0.0}}, dx);
    model.state.bodies.push_back(model.state.bodies.front());
    model.state.points.body[1] = 1;
    model.state.points.mass[1] *= 3.0;
    find_first_families(model,
                        *make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon)));
    return model;
}

ContactForces short_range(double stiffness, double friction, const Model& model)
{
    const auto law = std::make_shared<ShortRange>(law_parameters(stiffness, friction));
    law->scale({model.state.spacing, model.state.horizon});
    return ContactForces({{law, {0, 1}}});
}

Parameters plane_parameters(double stiffness, double friction, const Vector3& normal)
{
    Parameters parameters = law_parameters(stiffness, friction);
    parameters.set("point", std::vector<double>{0.0, 0.0, 0.0});
    parameters.set("normal", std::vector<double>{normal.x(), normal.y(), normal.z()});
    return parameters;
}

/// A grain resting on a plane inclined about y by `angle`, gravity vertical; returns its travel down the slope.
double travel_on_incline(double angle, double friction, double time, double& speed)
{
    const Vector3 normal(std::sin(angle), 0.0, std::cos(angle));
    const Vector3 down(std::cos(angle), 0.0, -std::sin(angle));
    const double stiffness = 2e4, g = 9.81;
    Model model = from_positions({Vector3::Zero()}, dx);
    const double weight = model.state.points.mass[0] * g;
    const auto law = std::make_shared<RigidPlane>(plane_parameters(stiffness, friction, normal));
    law->scale({model.state.spacing, model.state.horizon});
    // where the normal force balances its part of the weight
    model.state.points.position[0] = normal * (law->cutoff() - weight * std::cos(angle) / stiffness);
    model.state.gravity = Vector3(0.0, 0.0, -g);
    ContactForces contact({{law, {0}}});
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    find_first_families(model, *force);
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    const Vector3 start = model.state.points.position[0];
    dynamics.start();
    const double dt = 1e-4;
    for (int step = 0; step < static_cast<int>(std::lround(time / dt)); ++step)
        dynamics.step({dt, MaterialResponse::full, 0.0});
    speed = model.state.points.velocity[0].dot(down);
    return (model.state.points.position[0] - start).dot(down);
}

} // namespace

TEST_CASE("two grains collide in half a sine: duration pi/omega, deepest overlap v/omega, restitution 1")
{
    const double k = 500.0, v = 0.3;
    Model model = two_grains(0.8 * dx);
    ContactForces contact = short_range(k, 0.0, model);
    const double m0 = model.state.points.mass[0], m1 = model.state.points.mass[1];
    const double omega = std::sqrt(k * (m0 + m1) / (m0 * m1));
    model.state.points.velocity = {Vector3(v, 0, 0), Vector3::Zero()};
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    dynamics.start();
    dynamics.open_ledger();
    const double dt = 1e-3 * std::numbers::pi / omega;
    double deepest = 0.0;
    int steps = 0;
    double gap = 0.8 * dx;
    while (steps == 0 || gap < 0.8 * dx) {
        dynamics.step({dt, MaterialResponse::full, 0.0});
        gap = model.state.points.position[1].x() - model.state.points.position[0].x();
        deepest = std::max(deepest, 0.8 * dx - gap);
        REQUIRE(++steps < 2000);
    }
    // Verlet is of second order: omega dt = pi/1000 gives 1e-6, and the end is seen within one step
    CHECK(std::abs(steps - 1000) <= 2);
    CHECK(deepest == doctest::Approx(v / omega).epsilon(1e-5).scale(0.0));
    const double after = model.state.points.velocity[1].x() - model.state.points.velocity[0].x();
    CHECK(after == doctest::Approx(v).epsilon(1e-5).scale(0.0));
    CHECK(m0 * model.state.points.velocity[0].x() + m1 * model.state.points.velocity[1].x() ==
          doctest::Approx(m0 * v).epsilon(1e-13).scale(0.0));
    CHECK(std::abs(dynamics.ledger().error()) < 1e-5 * 0.5 * m0 * v * v);
}

TEST_CASE("friction between two grains takes momentum from one and gives it to the other")
{
    Model model = two_grains(0.7 * dx);
    ContactForces contact = short_range(500.0, 0.4, model);
    model.state.points.velocity = {Vector3(0, 0.2, 0), Vector3(0, -0.1, 0.05)};
    const Vector3 before = model.state.points.mass[0] * model.state.points.velocity[0] +
                           model.state.points.mass[1] * model.state.points.velocity[1];
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    dynamics.start();
    dynamics.open_ledger();
    for (int step = 0; step < 200; ++step)
        dynamics.step({1e-5, MaterialResponse::full, 0.0});
    const Vector3 after = model.state.points.mass[0] * model.state.points.velocity[0] +
                          model.state.points.mass[1] * model.state.points.velocity[1];
    CHECK((after - before).norm() < 1e-14 * model.state.points.mass[1]);
    CHECK(dynamics.ledger().friction > 0.0);
}

TEST_CASE("friction that stops a slip within a step does not throw it back under local damping")
{
    Model model = two_grains(0.7 * dx);
    ContactForces contact = short_range(500.0, 1e3, model); // friction without a practical limit
    const double slip = 0.2;
    model.state.points.velocity = {Vector3(0.0, slip, 0.0), Vector3::Zero()};
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    dynamics.start();
    double least = slip;
    for (int step = 0; step < 20; ++step) {
        dynamics.step({1e-5, MaterialResponse::full, 0.8});
        least = std::min(least, model.state.points.velocity[0].y() - model.state.points.velocity[1].y());
    }
    CHECK(least < 1e-2 * slip);
    CHECK(least > -1e-2 * slip);
}

TEST_CASE("a grain that slips over six others at once is stopped within a step and not thrown back")
{
    // One grain above a ring of six of another body, heavy so that they stay; pressed together by their overlap.
    std::vector<Vector3> positions{{0.0, 0.0, 0.003}};
    for (int n = 0; n < 6; ++n)
        positions.emplace_back(0.005 * std::cos(n * std::numbers::pi / 3.0),
                               0.005 * std::sin(n * std::numbers::pi / 3.0), 0.0);
    Model model = from_positions(positions, dx, 0.1); // a horizon too short for families
    model.state.bodies.push_back(model.state.bodies.front());
    for (std::size_t i = 1; i < model.size(); ++i) {
        model.state.points.body[i] = 1;
        model.state.points.mass[i] *= 1e6;
    }
    find_first_families(model,
                        *make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon)));
    ContactForces contact = short_range(1e5, 1e3, model); // friction without a practical limit
    contact.find_candidates(model, 0.0);
    const double slip = 0.1, dt = 1e-5;
    set_velocity(model, [&](const Vector3& x) { return Vector3(0.0, x.z() > 0.0 ? slip : 0.0, 0.0); });
    std::vector<Vector3> force(model.size(), Vector3::Zero());
    contact.add_reactions(model, dt, ContactForces::Approach::none, force);
    const double change = dt / model.state.points.mass[0] * contact.friction()[0].y();
    CHECK(change < -0.3 * slip); // each contact stops the part of the slip that is tangential to it
    CHECK(change >= -slip);
}

TEST_CASE("a block slides down an incline with g (sin a - mu cos a)")
{
    const double angle = 0.6, mu = 0.3, time = 0.2;
    double speed = 0.0;
    const double travel = travel_on_incline(angle, mu, time, speed);
    const double a = 9.81 * (std::sin(angle) - mu * std::cos(angle));
    // Friction acts from the first step on: the first half kick is without it and leaves the block half a step of
    // mu g cos a, 2e-4 of the speed, too fast.
    CHECK(speed == doctest::Approx(a * time).epsilon(1e-3).scale(0.0));
    CHECK(travel == doctest::Approx(0.5 * a * time * time).epsilon(1e-3).scale(0.0));
}

TEST_CASE("a block sticks below the angle of friction, to round-off, and slides just above it")
{
    const double mu = 0.5;
    double speed = 0.0;
    // The first half kick comes before friction and gives v = g sin a dt/2; mu g cos a - g sin a then brakes it.
    const double angle = std::atan(mu) - 0.01, g = 9.81, dt = 1e-4;
    const double start = 0.5 * dt * g * std::sin(angle);
    const double braked = start * start / (2.0 * g * (mu * std::cos(angle) - std::sin(angle)));
    // It moves on by v dt before it is braked at all, v dt/2 more than under steady braking. Of 20 steps the last is
    // shortened: an eighth of a step's braking, 6e-4 of the travel, is left open.
    CHECK(travel_on_incline(angle, mu, 0.5, speed) ==
          doctest::Approx(braked + 0.5 * start * dt).epsilon(1e-3).scale(0.0));
    CHECK(std::abs(speed) < 1e-12);
    CHECK(travel_on_incline(std::atan(mu) + 0.01, mu, 0.5, speed) > 0.01);
}

TEST_CASE("a grain that comes loose among others starts without contact force")
{
    // a compact cluster of three points: too few for a sub-horizon, so all are free, closer than the cut-off 0.8 dx
    Model model = from_positions({{0, 0, 0}, {0.5 * dx, 0, 0}, {0, 0.45 * dx, 0}}, dx);
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    find_first_families(model, *force);
    const auto law = std::make_shared<ShortRange>(law_parameters(500.0, 0.0));
    law->scale({model.state.spacing, model.state.horizon});
    ContactForces contact({{law, {0, 0}}});
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    dynamics.start();
    dynamics.open_ledger();
    CHECK(contact.energy() == 0.0);
    // pushed together they repel, and give back what was put in
    model.state.points.velocity[1] = Vector3(-0.05, 0, 0);
    dynamics.open_ledger();
    double stored = 0.0;
    for (int step = 0; step < 4000; ++step) {
        dynamics.step({1e-5, MaterialResponse::full, 0.0});
        stored = std::max(stored, dynamics.ledger().contact);
    }
    CHECK(stored > 0.3 * dynamics.ledger().opening);
    CHECK(std::abs(dynamics.ledger().error()) < 1e-3 * dynamics.ledger().opening);
}
