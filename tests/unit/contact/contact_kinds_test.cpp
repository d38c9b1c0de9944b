// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Each kind of contact alone: forces, energy, friction, bounds, and what it keeps from step to step.
#include "contact/one_body_contact.hpp"
#include "contact/rigid_surface_contact.hpp"
#include "contact/short_range/short_range.hpp"
#include "contact/two_body_contact.hpp"
#include "support/archives.hpp"
#include "support/half_space.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double stiffness = 500.0; // [N/m]
constexpr double slack = 0.1 * dx;
const ContactStep at_rest{1e-5, 0.0, 0.0};

/// Reaches 0.8 dx between points, and 0.5 dx above a surface.
std::shared_ptr<const Contact> law(double friction, ContactPartner partner)
{
    Parameters parameters;
    parameters.set("stiffness", stiffness);
    parameters.set("friction", friction);
    parameters.set("restitution", 1.0);
    auto made = std::make_shared<ShortRange>(parameters);
    made->scale({dx, 3.015 * dx, partner});
    return made;
}

void find_families(Model& model)
{
    find_first_families(model,
                        *make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon)));
    model.gather_ends();
}

/// Periodic along x, with a period of 10 spacings.
void make_periodic(Model& model)
{
    model.neighbourhood.isometries.set_generators({Isometry::shift(0, 10.0 * dx)});
}

struct Reactions {
    Reactions(ContactInteraction& contact, const Model& model, const ContactStep& step = at_rest)
        : force(model.size(), Vector3::Zero())
    {
        sums.reset(model.size(), model.state.obstacles.size());
        contact.add_reactions(model, step, sums, force);
    }
    ContactSums sums;
    std::vector<Vector3> force;
};

/// One point above a moving floor.
struct OnFloor {
    explicit OnFloor(double height, double friction = 0.3)
        : model(from_positions({{0.0, 0.0, height}}, dx)), contact({law(friction, ContactPartner::surface), {0}, 0}, 7)
    {
        model.state.obstacles.push_back({"floor", std::make_shared<test::HalfSpace>(Vector3::UnitZ())});
        model.state.obstacles[0].velocity = {0.0, 0.0, 2.0};
        find_families(model);
        contact.find_near_points(model, {}, SurfaceSearch::at_present(model));
    }
    Model model;
    RigidSurfaceContact contact;
};

ContactAssignment between_bodies(double friction = 0.0)
{
    return {law(friction, ContactPartner::points), {0, 1}};
}
ContactAssignment within_body(double friction = 0.0)
{
    return {law(friction, ContactPartner::points), {0, 0}};
}

/// Points of two bodies in turn.
Model in_turn(const std::vector<Vector3>& positions)
{
    Model model = from_positions(positions, dx);
    model.state.bodies.push_back(model.state.bodies.front());
    for (std::uint32_t i = 0; i < model.size(); ++i)
        model.state.points.body[i] = i % 2;
    return model;
}

/// A pair of pieces of one body that touch: they lay apart, farther than the body joins pieces, and have met since.
Model two_pieces(double distance)
{
    Model model = from_positions({Vector3::Zero(), 2.5 * dx * Vector3::UnitX()}, dx);
    model.state.bodies.front().joining_distance = 0.0;
    find_families(model);
    model.state.points.position[1].x() = distance;
    model.gather_ends();
    return model;
}

} // namespace

TEST_CASE("a rigid surface pushes a point with the force of its overlap, and the reaction and its power are summed")
{
    OnFloor scene(0.3 * dx); // the floor reaches 0.5 dx
    const Reactions made(scene.contact, scene.model);
    const double pushed = stiffness * 0.2 * dx;
    CHECK((made.force[0] - pushed * Vector3::UnitZ()).norm() < 1e-12 * pushed);
    CHECK(made.sums.energy[0] == doctest::Approx(0.5 * pushed * 0.2 * dx).epsilon(1e-12).scale(0.0));
    CHECK(made.sums.obstacle_reactions[0] == made.force[0]);
    CHECK(made.sums.obstacle_power.reaction == doctest::Approx(2.0 * pushed).epsilon(1e-12).scale(0.0));
    CHECK(scene.contact.deepest_overlap() == doctest::Approx(0.4).epsilon(1e-12).scale(0.0));
    CHECK(scene.contact.refresh_loss() == RefreshLoss::none);
}

TEST_CASE("friction of a rigid surface comes last: it stops the slip, with at most mu times the normal force")
{
    const double step = 1e-4;
    for (const double part : {0.5, 3.0}) { // of the speed that friction stops in a step
        OnFloor scene(0.3 * dx);
        const double grip = 0.3 * stiffness * 0.2 * dx;
        const double speed = part * grip * step / scene.model.state.points.mass[0];
        scene.model.state.points.velocity[0] = {speed, 0.0, 2.0};
        scene.model.gather_ends();
        Reactions made(scene.contact, scene.model);
        CHECK(made.force[0].x() == 0.0);
        scene.contact.add_friction_last(scene.model, step, made.sums, made.force);
        CHECK(made.force[0].x() == doctest::Approx(-std::min(part, 1.0) * grip).epsilon(1e-12).scale(0.0));
        CHECK(made.sums.friction[0].x() == made.force[0].x());
        CHECK((made.sums.obstacle_reactions[0] - made.force[0]).norm() < 1e-15 * grip);
    }
}

TEST_CASE("a rigid surface bounds the points that touch it, or may soon, and none while it is absent")
{
    for (const double height : {0.3, 0.9, 1.1}) { // the margin is half a spacing above the reach
        OnFloor scene(height * dx);
        const double squared = stiffness / scene.model.state.points.mass[0];
        CHECK(scene.contact.sharpest_possible(scene.model) ==
              doctest::Approx(std::sqrt(squared)).epsilon(1e-12).scale(0.0));
        std::vector<ContactBound> bounds(1);
        scene.contact.add_bounds(scene.model, 1.0, bounds);
        const double counts = height < 1.0 ? 1.0 : 0.0;
        CHECK(std::abs(bounds[0].stiffness(2, 2) - counts * squared) <= 1e-12 * squared);
        CHECK(bounds[0].stiffness.sum() == bounds[0].stiffness(2, 2)); // along the normal only
        CHECK(std::abs(bounds[0].sharpest - counts * squared) <= 1e-12 * squared);
        scene.model.state.obstacles[0].present = false;
        bounds.assign(1, {});
        scene.contact.add_bounds(scene.model, 1.0, bounds);
        CHECK(bounds[0].sharpest == 0.0);
        CHECK(Reactions(scene.contact, scene.model).force[0].isZero(0.0));
    }
}

TEST_CASE("a restored rigid surface keeps the shorter reach of a point that lay deep in it when it first acted")
{
    OnFloor whole(0.1 * dx), resumed(0.1 * dx), other(0.1 * dx);
    whole.contact.begin_stage(whole.model);
    CHECK(Reactions(whole.contact, whole.model).force[0].isZero(0.0));
    CHECK_FALSE(Reactions(other.contact, other.model).force[0].isZero(0.0)); // with the whole reach
    test::save_and_restore<ContactInteraction>(whole.contact, resumed.contact, std::size_t{1});
    resumed.contact.resume(resumed.model, slack, SurfaceSearch::at_present(resumed.model));
    CHECK(Reactions(resumed.contact, resumed.model).force[0].isZero(0.0));
}

TEST_CASE("the points of two bodies push each other apart with opposite forces, across a periodic boundary too")
{
    for (const bool periodic : {false, true}) {
        CAPTURE(periodic);
        // 0.6 dx apart; those of one body never touch
        const double second = periodic ? 9.7 : 0.9, third = periodic ? 9.9 : 0.7;
        Model model = in_turn({0.3 * dx * Vector3::UnitX(), second * dx * Vector3::UnitX(), 5.0 * dx * Vector3::UnitX(),
                               5.0 * dx * Vector3(1.0, 1.0, 0.0)});
        model.state.points.position[2] = {third * dx, 2.0 * dx, 0.0}; // out of reach
        if (periodic)
            make_periodic(model);
        find_families(model);
        TwoBodyContact contact(between_bodies(), 0);
        contact.find_candidates(model, slack);
        const Reactions made(contact, model);
        const double pushed = stiffness * 0.2 * dx;
        const double side = periodic ? 1.0 : -1.0;
        CHECK((made.force[0] - side * pushed * Vector3::UnitX()).norm() < 1e-12 * pushed);
        CHECK((made.force[0] + made.force[1]).norm() < 1e-12 * pushed); // positions of images are rounded
        CHECK(made.force[2].isZero(0.0));
        CHECK(made.sums.energy[0] + made.sums.energy[1] ==
              doctest::Approx(0.5 * pushed * 0.2 * dx).epsilon(1e-12).scale(0.0));
        CHECK(contact.deepest_overlap() == doctest::Approx(0.25).epsilon(1e-12).scale(0.0));
        CHECK(contact.refresh_loss() == RefreshLoss::none);
        std::vector<ContactBound> bounds(model.size());
        contact.add_bounds(model, 1.0, bounds);
        const double doubled = 2.0 * stiffness / model.state.points.mass[0];
        CHECK(bounds[0].stiffness(0, 0) == doctest::Approx(doubled).epsilon(1e-12).scale(0.0));
        CHECK(bounds[2].stiffness.isZero(0.0));
        CHECK(bounds[0].sharpest == doctest::Approx(doubled).epsilon(1e-12).scale(0.0)); // k over m/2
        CHECK(contact.sharpest_possible(model) == doctest::Approx(std::sqrt(doubled)).epsilon(1e-12).scale(0.0));
    }
}

TEST_CASE("friction that stops a slip is divided by the contacts of the end that has more, an image too")
{
    // The middle point slides past two points of the other body, one of them beyond a periodic boundary.
    Model model = in_turn({0.0 * dx * Vector3::UnitX(), 0.7 * dx * Vector3::UnitX(), Vector3(5.0, 5.0, 0.0) * dx,
                           9.3 * dx * Vector3::UnitX()});
    make_periodic(model);
    const double speed = 1e-6; // friction stops it within the step
    model.state.points.velocity[0] = {0.0, speed, 0.0};
    find_families(model);
    TwoBodyContact contact(between_bodies(0.5), 0);
    contact.find_candidates(model, slack);
    const Reactions made(contact, model);
    const double stopping = 0.5 * model.state.points.mass[0] * speed / at_rest.time_step; // of a pair alone
    CHECK(made.sums.friction[0].y() == doctest::Approx(-stopping).epsilon(1e-12).scale(0.0));
    for (const std::size_t neighbour : {1, 3}) // each has one contact, and the other end two
        CHECK(made.sums.friction[neighbour].y() == doctest::Approx(0.5 * stopping).epsilon(1e-12).scale(0.0));
}

TEST_CASE("pieces of one body that are apart touch, and close at rest in both directions")
{
    Model model = two_pieces(0.6 * dx);
    OneBodyContact contact(within_body(), 0);
    contact.find_candidates(model, slack);
    const Reactions made(contact, model);
    CHECK(made.force[0].x() == doctest::Approx(-stiffness * 0.2 * dx).epsilon(1e-12).scale(0.0));
    CHECK(made.force[0] == -made.force[1]);
    std::vector<double> energy(2, 0.0);
    CHECK(contact.refresh_loss() == RefreshLoss::of_closed_pairs);
    contact.add_stored_energy(model, energy);
    CHECK(energy == made.sums.energy);
    std::vector<ClosedPair> closed;
    contact.add_closed_pairs(model, closed);
    CHECK(closed.size() == 2);
    // The energy of the motion is m/4 v^2; a tenth of that stored is the limit.
    const double limit = std::sqrt(0.4 * (energy[0] + energy[1]) / model.state.points.mass[0]);
    for (const double part : {0.99, 1.01}) {
        model.state.points.velocity[1].x() = part * limit;
        model.gather_ends();
        closed.clear();
        contact.add_closed_pairs(model, closed);
        CHECK(closed.size() == (part < 1.0 ? 2 : 0));
    }
}

TEST_CASE("a detached point touches members of its family, images too, at the smaller reach of the two")
{
    for (const bool periodic : {false, true}) {
        CAPTURE(periodic);
        // 0.5 dx apart when both detach: that is their reach
        Model model = from_positions({0.1 * dx * Vector3::UnitX(), (periodic ? 9.6 : 0.6) * dx * Vector3::UnitX()}, dx);
        if (periodic)
            make_periodic(model);
        find_families(model);
        OneBodyContact contact(within_body(), 0);
        contact.find_candidates(model, slack);
        model.result.detached = {0, 0};
        CHECK(Reactions(contact, model).force[0].isZero(0.0));
        model.result.detached = {0, 1};
        CHECK(Reactions(contact, model).force[0].isZero(0.0));
        model.state.points.position[0].x() -= periodic ? 0.1 * dx : -0.1 * dx; // 0.4 dx apart
        model.gather_ends();
        const Reactions made(contact, model);
        const double pushed = stiffness * 0.1 * dx; // below the reach of the detached point, not that of the law
        CHECK(std::abs(made.force[0].x()) == doctest::Approx(pushed).epsilon(1e-9).scale(0.0));
        CHECK((made.force[0] + made.force[1]).norm() < 1e-9 * pushed);
    }
}

TEST_CASE("a restored contact within a body keeps the reach of detached points")
{
    Model model = from_positions({Vector3::Zero(), 0.5 * dx * Vector3::UnitX()}, dx);
    find_families(model);
    OneBodyContact whole(within_body(), 0), resumed(within_body(), 0), other(within_body(), 0);
    whole.find_candidates(model, slack);
    model.result.detached = {1, 1};
    Reactions(whole, model);
    model.state.points.position[1].x() = 0.4 * dx;
    model.gather_ends();
    test::save_and_restore<ContactInteraction>(whole, resumed, model.size());
    for (OneBodyContact* contact : {&resumed, &other})
        contact->resume(model, slack, {});
    const double pushed = stiffness * 0.1 * dx;
    CHECK(Reactions(resumed, model).force[1].x() == doctest::Approx(pushed).epsilon(1e-9).scale(0.0));
    CHECK(Reactions(other, model).force[1].isZero(0.0)); // takes 0.4 dx as its reach
}
