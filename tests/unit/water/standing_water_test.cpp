// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The lift of standing water on bodies in motion, against closed forms without added mass.
#include "support/specimens.hpp"
#include "time/dynamics.hpp"
#include "water/standing_water.hpp"

#include <doctest/doctest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace specimens;

namespace {

constexpr double dx = 0.02;
constexpr double g = 9.81;
constexpr double time_step = 1e-4; ///< a third of the stable one of the lightest block [s]

/// An elastic plate 0.12 x 0.12 x 0.06 m whose bottom lies `height` above the water surface.
struct Plate {
    Model model = from_positions(lattice(6, 6, 3, dx), dx);
    std::unique_ptr<ForceState> force =
        make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    ContactForces contact{std::vector<ContactAssignment>{}};
    Dynamics dynamics{model, *force, contact, {0.1 * dx, false}};

    Plate(double its_density, double height)
    {
        model.state.gravity = {0.0, 0.0, -g};
        model.state.bodies[0].water_level = 0.0;
        for (std::size_t i = 0; i < model.size(); ++i) {
            model.state.points.mass[i] = its_density * model.state.points.volume[i];
            model.state.points.position[i].z() += height;
        }
        find_first_families(model, *force);
        dynamics.start();
        dynamics.open_ledger();
    }
    double height() const
    {
        double sum = 0.0;
        for (const Vector3& x : model.state.points.position)
            sum += x.z();
        return sum / static_cast<double>(model.size());
    }
    void run(double time)
    {
        for (int step = 0; step < static_cast<int>(std::lround(time / time_step)); ++step)
            dynamics.step({time_step, MaterialResponse::full, 0.0});
    }
};

} // namespace

TEST_CASE("a block under water moves with (rho_w/rho - 1) g: a light one rises, a heavy one sinks")
{
    for (const double its_density : {600.0, 1000.0, 1720.0}) {
        CAPTURE(its_density);
        Plate plate(its_density, -1.0);
        const double before = plate.height();
        plate.run(0.1);
        // under a constant force velocity Verlet is exact; the sum of 1000 steps rounds off
        const double travel = 0.5 * (1000.0 / its_density - 1.0) * g * 0.01;
        CHECK(plate.height() - before == doctest::Approx(travel).epsilon(1e-9).scale(1e-3));
        const double work = 1000.0 * g * 108.0 * dx * dx * dx * travel; // 108 points
        CHECK(plate.dynamics.ledger().boundary == doctest::Approx(work).epsilon(1e-9).scale(1e-3));
        CHECK(std::abs(plate.dynamics.ledger().error()) < 1e-10);
    }
}

TEST_CASE("a block floats about the draught of Archimedes, with the period of a raft, and its energy is kept")
{
    const double density = 600.0, thickness = 3.0 * dx;
    const double draught = density / 1000.0 * thickness;
    const double amplitude = 0.01;
    Plate plate(density, amplitude - draught);
    // omega^2 = rho_w g A/m = g/draught
    const double period = 2.0 * std::numbers::pi * std::sqrt(draught / g);
    std::vector<double> sink; // of the middle below its place of equilibrium [m]
    double most_work = 0.0, worst_error = 0.0;
    for (int step = 0; step < static_cast<int>(std::lround(2.0 * period / time_step)); ++step) {
        plate.run(time_step);
        sink.push_back(0.5 * thickness - draught - plate.height());
        const EnergyLedger& ledger = plate.dynamics.ledger();
        most_work = std::max(most_work, std::abs(ledger.boundary));
        worst_error = std::max(worst_error, std::abs(ledger.error()));
    }
    // the plate gives way by rho g h^2/(2E) = 4 um
    const auto [least, largest] = std::ranges::minmax_element(sink);
    CHECK(*largest == doctest::Approx(amplitude).epsilon(1e-3));
    CHECK(*least == doctest::Approx(-amplitude).epsilon(1e-3));
    CHECK(sink.back() == doctest::Approx(-amplitude).epsilon(1e-3));
    // the middle passes its place of equilibrium a quarter of a period after the start
    const auto passed = std::ranges::find_if(sink, [](double below) { return below > 0.0; });
    CHECK(static_cast<double>(passed - sink.begin()) * time_step == doctest::Approx(0.25 * period).epsilon(2e-3));
    CHECK(worst_error < 1e-5 * most_work); // the stress is not linear in the motion of a step
}

TEST_CASE("a block that comes up from the deep leaves the water with the work that its buoyancy did")
{
    Plate plate(300.0, -0.2);
    const double start = plate.height();
    plate.run(0.3);
    const EnergyLedger& ledger = plate.dynamics.ledger();
    CHECK(plate.height() > 0.05); // out of the water
    const double volume = 108.0 * dx * dx * dx;
    // all points lose the whole of their buoyancy at the surface: rho_w g V times the depth from which they came
    CHECK(ledger.boundary == doctest::Approx(-1000.0 * g * volume * start).epsilon(1e-5));
    CHECK(std::abs(ledger.error()) < 1e-5 * ledger.boundary);
}

TEST_CASE("still water pushes up and nowhere else, and its lift does not depend on threads")
{
    Model model = from_positions(jittered(lattice(10, 10, 10, dx), dx, 0.2), dx);
    model.state.gravity = {0.0, 0.0, -g};
    model.state.bodies[0].water_level = 0.103;
    for (std::size_t i = 0; i < model.size(); ++i)
        model.state.points.velocity[i] = {0.1, 0.2, std::sin(static_cast<double>(i))};
    const int before = omp_get_max_threads();
    std::vector<double> power;
    std::vector<std::vector<double>> lift(2);
    for (const int threads : {1, 3}) {
        omp_set_num_threads(threads);
        std::vector<Vector3> force(model.size(), Vector3::Zero());
        power.push_back(add_buoyancy(model, lift[power.size()], force));
        for (std::size_t i = 0; i < model.size(); ++i) {
            CHECK(force[i].x() == 0.0);
            CHECK(force[i].y() == 0.0);
            CHECK(force[i].z() >= 0.0);
        }
    }
    omp_set_num_threads(before);
    CHECK(power[0] == power[1]);
    CHECK(lift[0] == lift[1]);
}
