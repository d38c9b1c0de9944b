// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What stops a run: a step that is too long, speed and energy from nowhere, lost points.
#include "scheduler/guards.hpp"
#include "small_run.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <limits>

using namespace periporo;
using namespace periporo::test;

namespace {

/// A block of 4 x 4 x 4 points of 10 mm that falls on a plane.
/// @param more lines of the tables [time] and [run] in the given order, or none
std::string block(double gap, double modulus, const std::string& time, const std::string& run)
{
    return fmt::format(
        "title = 'block'\n[discretization]\nspacing = '10 mm'\n[operator]\nforce_state = 'bond_projection'\n"
        "[material.a]\nmodel = 'linear_elastic'\ngrain_density = '2000 kg/m3'\nporosity = 0.0\n"
        "bulk_modulus = '4 MPa'\nshear_modulus = '2.4 MPa'\n"
        "[body.b]\nmaterial = 'a'\nvelocity = [0, 0, '-0.5 m/s']\n"
        "geometry = {{ generator = 'box', size = ['40 mm', '40 mm', '40 mm'], origin = [0, 0, '{} mm'] }}\n"
        "[[contact]]\nlaw = 'rigid_plane'\nbetween = ['b']\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
        "modulus = '{} Pa'\nfriction = 0.3\nrestitution = 0.1\n"
        "[[stage]]\nname = 'go'\ntype = 'dynamic'\nduration = '30 ms'\n[[output]]\nwriter = 'csv'\nevery = '1 s'\n"
        "[time]\n{}\n[run]\nhistory_every = '0.1 ms'\n{}\n",
        gap, modulus, time, run);
}

CaseDescription with_limit(double limit)
{
    CaseDescription description;
    description.energy_error_limit = limit;
    return description;
}

/// A resting block under gravity.
Model resting_block()
{
    Model model = specimens::from_positions(specimens::lattice(3, 3, 3, 0.01), 0.01);
    model.state.gravity = {0.0, 0.0, -9.81};
    return model;
}

} // namespace

TEST_CASE("a given step that is not stable is refused before the first step, with the stable one and a remedy")
{
    const SmallRun run = run_text(block(1.0, 1e5, "step = '1 ms'", ""));
    for (const char* part : {"0.001 s is not stable", "largest stable one is", "leave [time] step out"}) {
        CAPTURE(part);
        CHECK(contains(run.failure, part));
    }
    CHECK(run.summary.is_null()); // nothing is written of a case that is refused
}

TEST_CASE("a given step that is stable in flight and not on the ground is stopped before the ground is felt")
{
    // 8 mm away no contact counts yet. k/m = C/(rho dx^2) = 5e8/s2 allows a step of 0.09 ms, the body alone 0.19 ms.
    const SmallRun run = run_text(block(8.0, 1e8, "step = '0.12 ms'", ""));
    CHECK(contains(run.failure, "is not stable"));
    CHECK(run.summary.at("steps").get<int>() > 0);
    CHECK(run.energy("contact") == 0.0);
    CHECK(run_text(block(8.0, 1e8, "step = '0.02 ms'", "")).failure == "");
}

TEST_CASE("a run whose energy error passes the limit stops, says how much, who is fastest and the way out")
{
    const SmallRun run = run_text(block(1.0, 4e6, "", "energy_error_limit = 1e-9"));
    for (const char* part : {"stage 'go'", "per cent of the", "J turned over", "the fastest is point",
                             "of body 'b' at position", "[time] safety", "energy_error_limit"}) {
        CAPTURE(part);
        CHECK(contains(run.failure, part));
    }
    CHECK(run.summary.at("outcome") == "failed");
    CHECK(run_text(block(1.0, 4e6, "", "")).failure == "");
}

TEST_CASE("energy that came from nowhere and energy that was lost are held against what was turned over")
{
    const Model model = resting_block();
    EnergyLedger ledger;
    ledger.gravity = -1.0;
    ledger.friction = 0.5;
    ledger.kinetic = 0.5;
    ledger.turned_over = ledger.turnover();
    CHECK(ledger.error() == 0.0);
    CHECK(energy_error_beyond_limit(model, with_limit(0.1), ledger, 0.0).empty());
    ledger.kinetic += 0.2; // of 1.5 J turned over
    CHECK(contains(energy_error_beyond_limit(model, with_limit(0.1), ledger, 0.0),
                   "0.2 J came from nowhere, 13.3 per cent"));
    CHECK(energy_error_beyond_limit(model, with_limit(0.2), ledger, 0.0).empty());
    CHECK(energy_error_beyond_limit(model, with_limit(0.1), ledger, 0.2).empty()); // an earlier stage left it
    ledger.kinetic -= 0.4;
    CHECK(contains(energy_error_beyond_limit(model, with_limit(0.1), ledger, 0.0), "0.2 J were lost"));
}

TEST_CASE("a body that has hardly begun to move is not held against nothing")
{
    const Model model = resting_block();
    const double weight = 27.0 * specimens::density * 1e-6 * 9.81;
    EnergyLedger ledger;
    ledger.kinetic = 1e-5 * weight * model.state.spacing; // round-off of a start, no motion
    CHECK(energy_error_beyond_limit(model, with_limit(0.1), ledger, 0.0).empty());
    CHECK(energy_of_motion_from_nowhere(model, with_limit(0.1), ledger, 0.0).empty());
    ledger.kinetic = 0.1 * weight * model.state.spacing;
    CHECK_FALSE(energy_error_beyond_limit(model, with_limit(0.1), ledger, 0.0).empty());
    CHECK_FALSE(energy_of_motion_from_nowhere(model, with_limit(0.1), ledger, 0.0).empty());
}

TEST_CASE("motion that nothing gave is found, also where much was turned over, and names the fastest point")
{
    Model model = resting_block();
    model.state.points.velocity[7] = {0.0, 30.0, 0.0};
    EnergyLedger ledger;
    ledger.gravity = -1.0;
    ledger.friction = 100.0;
    ledger.kinetic = 1.9;
    CHECK(energy_of_motion_from_nowhere(model, with_limit(0.1), ledger, 0.0).empty());
    ledger.kinetic = 2.5;
    const std::string wrong = energy_of_motion_from_nowhere(model, with_limit(0.1), ledger, 0.0);
    CHECK(contains(wrong, "point 7 of body 'body'"));
    CHECK(contains(wrong, "30 m/s"));
    CHECK(energy_of_motion_from_nowhere(model, with_limit(1.0), ledger, 0.0).empty()); // the limit widens it
}

TEST_CASE("the way out of a force state that creates energy by itself names the others")
{
    const Model model = resting_block();
    EnergyLedger ledger;
    ledger.kinetic = 1.0;
    for (const char* state : {"volume_weighted", "unstabilized"}) {
        CaseDescription description = with_limit(0.1);
        description.operators.force_state = state;
        const std::string wrong = energy_error_beyond_limit(model, description, ledger, 0.0);
        CHECK(contains(wrong, state));
        CHECK(contains(wrong, "'energy_conjugate'"));
        CHECK(contains(wrong, "raise [run] energy_error_limit"));
    }
}

TEST_CASE("while a body settles no point moves ten times faster than a fall over its size, or what drives it")
{
    Model model = resting_block();
    // lower to upper corner 0.02 sqrt(3) m, and a spacing
    const double fall = std::sqrt(2.0 * 9.81 * (0.02 * std::sqrt(3.0) + 0.01));
    model.state.points.velocity[3].z() = 9.9 * fall;
    CHECK(faster_than_driven(model, {}, 9.81).empty());
    model.state.points.velocity[3].z() = 10.1 * fall;
    CHECK(contains(faster_than_driven(model, {}, 9.81), "point 3 of body 'body'"));
    CaseDescription driven;
    driven.held_regions.emplace_back().velocity = {2.0 * fall, 0.0, 0.0};
    CHECK(faster_than_driven(model, driven, 9.81).empty());
}

TEST_CASE("a point that is not finite, or far away, is named")
{
    Model model = resting_block();
    CHECK(lost_point(model).empty());
    model.state.points.velocity[5].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(contains(lost_point(model), "point 5 of body 'body'"));
    CHECK(contains(lost_point(model), "is not finite"));
    model.state.points.velocity[5].x() = 0.0;
    model.state.points.position[2].x() += 1001.0 * model.state.horizon;
    CHECK(contains(lost_point(model), "point 2 of body 'body'"));
    CHECK(contains(lost_point(model), "was lost"));
}
