// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Motion of whole bodies.
#include "support/specimens.hpp"
#include "time/dynamics.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace specimens;

namespace {

constexpr double dx = 0.01;

} // namespace

TEST_CASE("a body in free flight keeps momentum and angular momentum to round-off while it deforms and is refreshed")
{
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        Model model = from_positions(jittered(lattice(5, 4, 6, dx), dx, 0.1), dx);
        find_first_families(model, force);
        for (std::size_t i = 0; i < model.size(); ++i) {
            const Vector3& x = model.state.points.position[i];
            model.state.points.velocity[i] = Vector3(2.0, -1.0, 0.5) + Vector3(3.0, -8.0, 20.0).cross(x) +
                                             0.3 * Vector3(std::sin(60.0 * x.z()), std::cos(80.0 * x.x()), 0.0);
        }
        const auto sums = [&](Vector3& linear, Vector3& angular) {
            linear = angular = Vector3::Zero();
            for (std::size_t i = 0; i < model.size(); ++i) {
                linear += model.state.points.mass[i] * model.state.points.velocity[i];
                angular +=
                    model.state.points.mass[i] * model.state.points.position[i].cross(model.state.points.velocity[i]);
            }
        };
        Vector3 linear, angular, linear_after, angular_after;
        sums(linear, angular);
        ContactForces contact({});
        Dynamics dynamics(model, force, contact, {0.05 * dx, false});
        dynamics.start();
        for (int step = 0; step < 100; ++step)
            dynamics.step({5e-5, MaterialResponse::full, 0.0});
        sums(linear_after, angular_after);
        CHECK(dynamics.refreshes() > 3);
        CHECK((linear_after - linear).norm() < 1e-13 * linear.norm());
        if (state != "volume_weighted") // its moments do not balance
            CHECK((angular_after - angular).norm() < 1e-12 * angular.norm());
    });
}

TEST_CASE("a body that takes up mass while it falls closes its energy, and falls on with g")
{
    Model model = from_positions(lattice(4, 3, 3, dx), dx);
    model.state.gravity = {0.0, 0.0, -9.81};
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    find_first_families(model, *force);
    for (Vector3& v : model.state.points.velocity)
        v = {0.0, 0.0, -1.0};
    ContactForces contact({});
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    dynamics.start();
    dynamics.open_ledger();
    constexpr double dt = 1e-4;
    constexpr int steps = 200;
    for (int step = 0; step < steps; ++step) {
        ArrivedEnergy arrived;
        for (std::size_t i = 0; i < model.size(); ++i) {
            const double more = 1e-3 * density * dx * dx * dx; // a fifth over all steps
            model.state.points.mass[i] += more;
            arrived.kinetic += 0.5 * more * model.state.points.velocity[i].squaredNorm();
            arrived.gravity -= more * model.state.gravity.dot(model.state.points.position[i]);
        }
        dynamics.book(arrived);
        dynamics.step({dt, MaterialResponse::full, 0.0});
    }
    // the first half of a step still has the weight of before, a thousandth less
    CHECK(model.state.points.velocity[5].z() == doctest::Approx(-1.0 - 9.81 * dt * steps).epsilon(1e-3));
    const EnergyLedger& ledger = dynamics.ledger();
    CHECK(ledger.boundary > 0.1 * ledger.kinetic);
    CHECK(std::abs(ledger.error()) < 1e-3 * std::abs(ledger.gravity));
}

TEST_CASE("a vibrating elastic block keeps its energy, stress work found apart from kinetic energy")
{
    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        Model model = from_positions(lattice(6, 5, 5, dx), dx);
        const auto force = make_force_state(state, Influence::by_name("constant", model.state.horizon));
        find_first_families(model, *force);
        for (std::size_t i = 0; i < model.size(); ++i)
            model.state.points.velocity[i] =
                Vector3(1e-5 * std::cos(std::numbers::pi * model.state.points.position[i].x() / (6 * dx)), 0.0, 0.0);
        ContactForces contact({});
        Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
        dynamics.start();
        dynamics.open_ledger();
        double worst = 0.0;
        double least_kinetic = 1e300;
        for (int step = 0; step < 400; ++step) {
            dynamics.step({2e-5, MaterialResponse::full, 0.0});
            worst = std::max(worst, std::abs(dynamics.ledger().error()));
            least_kinetic = std::min(least_kinetic, dynamics.ledger().kinetic);
        }
        // round-off but for the energy of third order in the strain, v/c = 2e-7, over a few periods
        CHECK(worst < 1e-6 * dynamics.ledger().opening);
        CHECK(least_kinetic < 0.5 * dynamics.ledger().opening); // energy went into stress and came back
    }
}

TEST_CASE("points that tremble more slowly than their body drifts come to rest in it under local damping")
{
    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        Model model = from_positions(lattice(4, 4, 4, dx), dx);
        const auto force = make_force_state(state, Influence::by_name("constant", model.state.horizon));
        find_first_families(model, *force);
        const Vector3 drift(0.1, -0.2, 0.1), tremble(1e-4, 1e-4, -1e-4);
        for (std::size_t i = 0; i < model.size(); ++i) {
            const long layers = std::lround(model.state.points.position[i].sum() / dx - 1.5);
            model.state.points.velocity[i] = drift + (layers % 2 == 0 ? tremble : -tremble);
        }
        ContactForces contact({});
        Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
        dynamics.start();
        for (int step = 0; step < 1000; ++step)
            dynamics.step({2e-5, MaterialResponse::elastic, 0.8});
        double left = 0.0; // of the forces, at their largest over a few periods
        for (int step = 0; step < 100; ++step) {
            dynamics.step({2e-5, MaterialResponse::elastic, 0.8});
            left = std::max(left, dynamics.residual());
        }
        MESSAGE("left of the forces: " << left);
        CHECK(left < 1e-2); // damped by the sign of the velocity alone: 0.8
    }
}

TEST_CASE("a laterally confined column under its weight: sum of V sigma_zz is the moment of the forces, exactly")
{
    // sum_i V_i sigma_zz,i = -sum_i f_i z_i for the conjugate states (virtual power with v = z e_z); with the floor
    // holding the lowest row and gravity, this is -(W (z_mean - z_floor row)), whatever the stiffness.
    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        Model model = from_positions(lattice(1, 1, 16, dx), dx);
        model.neighbourhood.isometries.set_generators({Isometry::shift(0, dx), Isometry::shift(1, dx)});
        model.state.gravity = Vector3(0.0, 0.0, -9.81);
        const auto force = make_force_state(state, Influence::by_name("constant", model.state.horizon));
        find_first_families(model, *force);
        ContactForces contact({});
        Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
        std::uint32_t lowest = 0;
        for (std::uint32_t i = 0; i < model.size(); ++i)
            if (model.state.points.position[i].z() < model.state.points.position[lowest].z())
                lowest = i;
        dynamics.hold({{lowest, Vector3::UnitX()}, {lowest, Vector3::UnitY()}, {lowest, Vector3::UnitZ()}});
        dynamics.start();
        int steps = 0;
        do {
            dynamics.step({4e-5, MaterialResponse::elastic, 0.8});
            REQUIRE(++steps < 60000);
        } while (dynamics.residual() > 1e-7 || steps < 10);
        std::vector<double> means = model.state.point_states.values;
        mean_point_states(model, *force, means);
        double stress = 0.0, moment = 0.0, upper_error = 0.0;
        for (std::size_t i = 0; i < model.size(); ++i) {
            const double z = model.state.points.position[i].z();
            stress += model.state.points.volume[i] * means[6 * i + 2];
            moment -= model.state.points.mass[i] * 9.81 * (z - model.state.points.position[lowest].z());
            const double depth = 16 * dx - z;
            if (z > 7 * dx && depth > 3 * dx) // a horizon away from the floor row's spike and from the surface
                upper_error = std::max(upper_error, std::abs(means[6 * i + 2] / (-density * 9.81 * depth) - 1.0));
        }
        CHECK(stress == doctest::Approx(moment).epsilon(1e-5).scale(0.0));
        MESSAGE("largest relative difference from rho g depth away from the ends: " << upper_error);
        CHECK(upper_error < 0.1);
    }
}
