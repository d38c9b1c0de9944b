// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pieces of one body that meet: by contact, at the distance of contact, without energy from nowhere.
#include "contact/rigid_plane/rigid_plane.hpp"
#include "contact/short_range/short_range.hpp"
#include "material/drucker_prager/drucker_prager.hpp"
#include "support/specimens.hpp"
#include "time/dynamics.hpp"

#include <doctest/doctest.h>

#include <numeric>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double touch = 0.8 * dx; // of short_range by default
constexpr double g = 9.81;

struct ElasticSolid : Hooke {
    using Hooke::Hooke;
    static constexpr bool closes = false;
};

Parameters contact_parameters(double restitution, double friction)
{
    Parameters parameters;
    parameters.set("modulus", 1e6);
    parameters.set("friction", friction);
    parameters.set("restitution", restitution);
    return parameters;
}

std::shared_ptr<const Material> cohesionless_soil()
{
    Parameters parameters;
    parameters.set("bulk_modulus", 2.0e6);
    parameters.set("shear_modulus", 1.2e6);
    parameters.set("friction_angle", 0.52);
    parameters.set("dilatancy_angle", 0.0);
    parameters.set("cohesion", 0.0);
    parameters.set("tensile_strength", 0.0);
    parameters.set("match", std::string("compression"));
    return std::make_shared<LawMaterial<DruckerPrager>>(parameters);
}

/// Two blocks of one body, 4 x 4 points wide and 3 high, the upper one with its lowest row `gap` above the other's top
/// row.
Model two_blocks(double gap, std::shared_ptr<const Material> material)
{
    std::vector<Vector3> x = lattice(4, 4, 3, dx);
    const std::size_t lower = x.size();
    for (std::size_t i = 0; i < lower; ++i)
        x.push_back(x[i] + Vector3(0.0, 0.0, 2.0 * dx + gap));
    Model model = from_positions(x, dx);
    model.state.bodies.front().material = std::move(material);
    model.state.bodies.front().joining_distance = 0.0;
    model.allocate();
    return model;
}

bool is_upper(const Model& model, std::size_t i)
{
    return i >= model.size() / 2;
}

/// Least distance between points of the two blocks.
double distance_between(const Model& model)
{
    double least = 1.0;
    for (std::size_t i = 0; i < model.size() / 2; ++i)
        for (std::size_t j = model.size() / 2; j < model.size(); ++j)
            least = std::min(least, (model.state.points.position[i] - model.state.points.position[j]).norm());
    return least;
}

Vector3 momentum(const Model& model, bool upper)
{
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < model.size(); ++i)
        if (is_upper(model, i) == upper)
            sum += model.state.points.mass[i] * model.state.points.velocity[i];
    return sum;
}

std::shared_ptr<const Contact> between_pieces(double restitution, double friction)
{
    auto law = std::make_shared<ShortRange>(contact_parameters(restitution, friction));
    law->scale({dx, 3.015 * dx});
    return law;
}

struct Meeting {
    double first_push = 0.0;   ///< distance of the blocks when the upper one is first pushed [m]
    double nearest = 1.0;      ///< least distance of two points of different blocks [m]
    double speed_after = 0.0;  ///< at which the blocks part, over that at which they met
    double energy_error = 0.0; ///< largest, over the energy before
};

/// The upper block meets the lower one at 0.5 m/s, without gravity.
Meeting meet(const std::string& force_state, std::shared_ptr<const Material> material, double restitution)
{
    Model model = two_blocks(2.0 * dx, std::move(material));
    const auto force = make_force_state(force_state, Influence::by_name("linear", model.state.horizon));
    ContactForces contact({{between_pieces(restitution, 0.0), {0, 0}}});
    find_first_families(model, *force);
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    const double speed = 0.5;
    for (std::size_t i = 0; i < model.size(); ++i)
        model.state.points.velocity[i] = Vector3(0.0, 0.0, is_upper(model, i) ? -speed : 0.0);
    dynamics.start();
    dynamics.open_ledger();
    const double mass = model.state.points.mass[0] * static_cast<double>(model.size() / 2);
    const double energy = 0.5 * mass * speed * speed;
    Meeting meeting;
    for (int step = 0; step < 1500; ++step) { // 60 ms: 24 until they touch, some 6 of contact
        dynamics.step({4e-5, MaterialResponse::full, 0.0});
        const double distance = distance_between(model);
        meeting.nearest = std::min(meeting.nearest, distance);
        if (meeting.first_push == 0.0 && std::abs(momentum(model, true).z() + mass * speed) > 1e-6 * mass * speed)
            meeting.first_push = distance;
        meeting.energy_error = std::max(meeting.energy_error, std::abs(dynamics.ledger().error()) / energy);
    }
    const Vector3 both = momentum(model, true) + momentum(model, false);
    CHECK(both.x() == doctest::Approx(0.0).epsilon(1e-12));
    CHECK(both.z() == doctest::Approx(-mass * speed).epsilon(1e-10)); // rounding of 1,500 steps
    meeting.speed_after = (momentum(model, true) - momentum(model, false)).z() / (mass * speed);
    return meeting;
}

} // namespace

TEST_CASE("two blocks of one body that approach feel nothing until they touch, with every conjugate force state")
{
    for (const char* state : {"energy_conjugate", "energy_conjugate_mean", "bond_projection"}) {
        CAPTURE(state);
        const Meeting elastic = meet(state, std::make_shared<LawMaterial<ElasticSolid>>(Parameters{}), 1.0);
        // at most a step's way, 0.02 mm, within the reach of the law
        CHECK(elastic.first_push < touch);
        CHECK(elastic.first_push > touch - 0.05 * dx);
        CHECK(elastic.nearest > 0.5 * dx); // contact within 0.3 spacings of where it begins
        CHECK(elastic.energy_error < 0.01);
        // equal blocks exchange their motion, but for what rings on in them
        CHECK(elastic.speed_after > 0.8);
        CHECK(elastic.speed_after <= 1.0);
    }
}

TEST_CASE("blocks of cohesionless soil meet at the same distance and part no faster than their contact law has it")
{
    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        const Meeting soil = meet(state, cohesionless_soil(), 0.3);
        CHECK(soil.first_push < touch);
        CHECK(soil.first_push > touch - 0.05 * dx);
        CHECK(soil.nearest > 0.5 * dx);
        CHECK(soil.energy_error < 0.01);
        CHECK(soil.speed_after < 0.3 + 0.02);
    }
}

TEST_CASE("a block of soil that falls on its own lower part comes to rest on it, and its weight arrives at the floor")
{
    Model model = two_blocks(1.9 * dx, cohesionless_soil());
    model.state.gravity = Vector3(0.0, 0.0, -g);
    // a wide column: symmetry planes on all four sides
    model.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0), Isometry::reflection(0, 4.0 * dx),
                                                   Isometry::reflection(1, 0.0), Isometry::reflection(1, 4.0 * dx)});
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    Parameters floor = contact_parameters(0.1, 0.5);
    floor.set("point", std::vector<double>{0.0, 0.0, 0.0});
    floor.set("normal", std::vector<double>{0.0, 0.0, 1.0});
    const auto plane = std::make_shared<RigidPlane>(floor);
    plane->scale({dx, model.state.horizon});
    ContactForces contact({{plane, {0}}, {between_pieces(0.1, 0.5), {0, 0}}});
    find_first_families(model, *force);
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    dynamics.start();
    dynamics.open_ledger();
    const double mass = model.state.points.mass[0] * static_cast<double>(model.size());
    double reaction = 0.0, error = 0.0;
    std::size_t steps = 0;
    for (int step = 0; step < 5000; ++step) { // 0.2 s; the fall takes 0.045 s
        dynamics.step({4e-5, MaterialResponse::full, 0.0});
        error = std::max(error, std::abs(dynamics.ledger().error()));
        if (step < 4000)
            continue;
        reaction += contact.reactions_of_obstacles().back().z();
        ++steps;
    }
    const double released = -dynamics.ledger().gravity;
    CHECK(released > 0.9 * 0.5 * mass * g * 0.8 * dx); // the upper half fell over 0.8 spacings or more
    CHECK(error < 0.01 * released);
    // what still rings is a few per cent of the weight on the mean over 40 ms
    CHECK(reaction / static_cast<double>(steps) == doctest::Approx(mass * g).epsilon(0.02));
    CHECK(distance_between(model) > 0.5 * dx);
    CHECK(distance_between(model) < 1.1 * dx);
    CHECK(dynamics.mean_speed() < 0.02 * std::sqrt(2.0 * g * dx));
}
