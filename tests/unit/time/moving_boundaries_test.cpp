// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Obstacles and points with a prescribed motion against closed forms, and the work that they do.
#include "contact/short_range/short_range.hpp"
#include "support/half_space.hpp"
#include "support/specimens.hpp"
#include "time/dynamics.hpp"

#include <doctest/doctest.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double stiffness = 500.0; // [N/m]

std::shared_ptr<const Contact> law(double friction, double restitution = 1.0)
{
    Parameters parameters;
    parameters.set("stiffness", stiffness);
    parameters.set("friction", friction);
    parameters.set("restitution", restitution);
    auto made = std::make_shared<ShortRange>(parameters);
    made->scale({dx, 3.015 * dx, ContactPartner::surface});
    return made;
}

/// A grain and an obstacle that fills the space behind a plane.
struct Meeting {
    Meeting(const Vector3& grain, const Vector3& normal, double friction)
        : model(from_positions({grain}, dx)), contact({{law(friction), {0}, 0, {}}}),
          force(make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon))),
          dynamics(model, *force, contact, {0.1 * dx, false})
    {
        model.state.obstacles.push_back({"wall", std::make_shared<periporo::test::HalfSpace>(normal)});
        find_first_families(model, *force);
    }
    void start()
    {
        dynamics.start();
        dynamics.open_ledger();
    }
    void run(double time, double step)
    {
        for (long n = 0; n < std::lround(time / step); ++n)
            dynamics.step({step, MaterialResponse::full, 0.0});
    }
    double mass() const { return model.state.points.mass[0]; }

    Model model;
    ContactForces contact;
    std::unique_ptr<ForceState> force;
    Dynamics dynamics;
};

} // namespace

TEST_CASE("a wall of speed V throws a resting grain forwards with 2 V, and that is the work of the wall")
{
    const double v = 0.4;
    Meeting meeting({0.7 * dx, 0.0, 0.0}, Vector3::UnitX(), 0.0);
    meeting.model.state.obstacles[0].velocity = {v, 0.0, 0.0};
    meeting.start();
    const double period = std::sqrt(meeting.mass() / stiffness);
    meeting.run(0.2 * dx / v + 4.0 * period, 1e-3 * period);
    // Verlet is of second order in omega dt = 1e-3; what the end of the contact cuts off is of the same order
    CHECK(meeting.model.state.points.velocity[0].x() == doctest::Approx(2.0 * v).epsilon(1e-5).scale(0.0));
    const double kinetic = 0.5 * meeting.mass() * 4.0 * v * v;
    CHECK(meeting.dynamics.ledger().boundary == doctest::Approx(kinetic).epsilon(1e-5).scale(0.0));
    CHECK(std::abs(meeting.dynamics.ledger().error()) < 1e-5 * kinetic);
    // overlap v/omega of a reach of half a spacing
    CHECK(meeting.contact.deepest_overlap()[0] == doctest::Approx(v * period / (0.5 * dx)).epsilon(1e-4).scale(0.0));
}

TEST_CASE("a belt drags a grain to its speed within v/(mu g), and half of its work is friction")
{
    const double v = 0.2, mu = 0.3, g = 9.81;
    Meeting meeting({0.0, 0.0, 0.0}, Vector3::UnitZ(), mu);
    const double weight = meeting.mass() * g;
    meeting.model.state.points.position[0].z() = 0.5 * dx - weight / stiffness;
    meeting.model.state.gravity = {0.0, 0.0, -g};
    meeting.model.state.obstacles[0].velocity = {0.0, v, 0.0};
    meeting.start();
    const double time = v / (mu * g);
    const double step = time / 2000.0;
    meeting.run(0.5 * time, step);
    CHECK(meeting.model.state.points.velocity[0].y() == doctest::Approx(0.5 * v).epsilon(2e-3).scale(0.0));
    // friction sets in at once, and its work is summed as the motion takes it: nothing but round-off is missing
    CHECK(meeting.dynamics.ledger().friction > 0.5 * 0.5 * meeting.mass() * v * v);
    CHECK(std::abs(meeting.dynamics.ledger().error()) < 1e-12 * meeting.mass() * v * v);
    meeting.run(0.6 * time, step);
    CHECK(meeting.model.state.points.velocity[0].y() == doctest::Approx(v).epsilon(1e-9).scale(0.0));
    const EnergyLedger& ledger = meeting.dynamics.ledger();
    const double kinetic = 0.5 * meeting.mass() * v * v;
    // sums over 2000 steps of a force that sets in at once: one step of error
    CHECK(ledger.boundary == doctest::Approx(2.0 * kinetic).epsilon(1e-3).scale(0.0));
    CHECK(ledger.friction == doctest::Approx(kinetic).epsilon(1e-3).scale(0.0));
    CHECK(std::abs(ledger.error()) < 1e-12 * kinetic);
}

TEST_CASE("the work of a wall that pushes a grain has an error of second order in the step")
{
    // While they touch the grain is a mass on a spring whose other end moves: F = k v/omega sin(omega t).
    const double v = 0.2, end = 1.5; // omega t of the end, before they part at pi
    const auto error_in = [&](int steps) {
        Meeting meeting({0.5 * dx, 0.0, 0.0}, Vector3::UnitX(), 0.0);
        meeting.model.state.obstacles[0].velocity = {v, 0.0, 0.0};
        meeting.start();
        const double time = end * std::sqrt(meeting.mass() / stiffness);
        meeting.run(time, time / steps);
        const EnergyLedger& ledger = meeting.dynamics.ledger();
        const double exact = meeting.mass() * v * v * (1.0 - std::cos(end));
        CHECK(std::abs(ledger.error()) < 1e-12 * exact); // the force is linear in the motion of a step
        return ledger.boundary / exact - 1.0;
    };
    const double five = error_in(5), ten = error_in(10), twenty = error_in(20);
    CHECK(std::abs(five) < 0.02); // (omega dt)^2/12 = 0.0075 is the scale of a trapezoid's error
    // the term of fourth order over that of second, (omega dt)^2 = 0.09 and 0.02
    CHECK(five / ten == doctest::Approx(4.0).epsilon(0.09).scale(0.0));
    CHECK(ten / twenty == doctest::Approx(4.0).epsilon(0.03).scale(0.0));
}

TEST_CASE("a shorter last step keeps the second order of the motion, and the ledger closed")
{
    const double v = 0.2, end = 1.5;
    const auto error_in = [&](int steps) {
        Meeting meeting({0.5 * dx, 0.0, 0.0}, Vector3::UnitX(), 0.0);
        meeting.model.state.obstacles[0].velocity = {v, 0.0, 0.0};
        meeting.start();
        const double step = end * std::sqrt(meeting.mass() / stiffness) / (steps + 0.6);
        meeting.run(steps * step, step);
        meeting.run(0.6 * step, 0.6 * step);
        const double kinetic = 0.5 * meeting.mass() * v * v;
        CHECK(std::abs(meeting.dynamics.ledger().error()) < 1e-12 * kinetic);
        CHECK(meeting.dynamics.ledger().boundary ==
              doctest::Approx(2.0 * kinetic * (1.0 - std::cos(end))).epsilon(2e-3));
        return meeting.model.state.points.velocity[0].x() / (v * (1.0 - std::cos(end))) - 1.0;
    };
    // the last step has an error of third order by itself: of 0.04 of the other for omega dt = 0.07
    const double coarse = error_in(20), fine = error_in(40);
    CHECK(std::abs(coarse) < 1e-3);
    CHECK(coarse / fine == doctest::Approx(std::pow(40.6 / 20.6, 2)).epsilon(0.04).scale(0.0));
}

TEST_CASE("an obstacle is found again after it has come from afar")
{
    Meeting meeting({0.0, 0.0, 0.0}, Vector3::UnitX(), 0.0);
    meeting.model.state.obstacles[0].shift = {-20.0 * dx, 0.0, 0.0};
    meeting.model.state.obstacles[0].velocity = {1.0, 0.0, 0.0};
    meeting.start();
    meeting.run(0.3, 1e-5);
    CHECK(meeting.model.state.points.velocity[0].x() == doctest::Approx(2.0).epsilon(1e-3).scale(0.0));
}

TEST_CASE("a grain that falls from afar is caught by the floor, and bounces to where it came from")
{
    Meeting meeting({0.0, 0.0, 20.0 * dx}, Vector3::UnitZ(), 0.0);
    meeting.model.state.gravity = {0.0, 0.0, -9.81};
    meeting.start();
    const double fall = std::sqrt(2.0 * 19.5 * dx / 9.81);
    double lowest = 1.0, highest = 0.0;
    for (int n = 0; n < 25000; ++n) {
        meeting.run(1e-5, 1e-5);
        lowest = std::min(lowest, meeting.model.state.points.position[0].z());
    }
    for (int n = 0; n < static_cast<int>((2.2 * fall - 0.25) / 1e-5); ++n) {
        meeting.run(1e-5, 1e-5);
        highest = std::max(highest, meeting.model.state.points.position[0].z());
    }
    CHECK(lowest < 0.5 * dx);
    // Verlet at omega dt = 5e-3: of second order
    CHECK(highest == doctest::Approx(20.0 * dx).epsilon(1e-4).scale(0.0));
    CHECK(std::abs(meeting.dynamics.ledger().error()) < 1e-4 * meeting.mass() * 9.81 * 19.5 * dx);
}

TEST_CASE("a heap that is pushed down a slope stops on a rough one and slides on on a smooth one")
{
    const double slope = 0.35, v = 0.2, g = 9.81; // 20 degrees
    const Vector3 normal(std::sin(slope), 0.0, std::cos(slope)), down(std::cos(slope), 0.0, -std::sin(slope));
    const Vector3 across = normal.cross(down);
    std::vector<Vector3> heap; // layers of 5 x 5, 3 x 3 and 1 points
    for (int layer = 0; layer < 3; ++layer)
        for (int i = layer - 2; i <= 2 - layer; ++i)
            for (int j = layer - 2; j <= 2 - layer; ++j)
                heap.push_back(dx * (i * down + j * across + (layer + 0.5) * normal));
    const auto travel = [&](double friction, double time, double& speed) {
        Model model = from_positions(heap, dx);
        model.state.gravity = {0.0, 0.0, -g};
        model.state.obstacles.push_back({"slope", std::make_shared<periporo::test::HalfSpace>(normal)});
        const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
        find_first_families(model, *force);
        ContactForces contact({{law(friction, 0.1), {0}, 0, {}}}); // with 1 it would hop on downhill
        Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
        set_velocity(model, [&](const Vector3&) { return Vector3(v * down); });
        dynamics.start();
        const double step = 2e-5;
        for (long n = 0; n < std::lround(time / step); ++n)
            dynamics.step({step, MaterialResponse::full, 0.0});
        Vector3 moved = Vector3::Zero(), velocity = Vector3::Zero();
        for (std::size_t i = 0; i < model.size(); ++i) {
            moved += (model.state.points.position[i] - heap[i]) / static_cast<double>(model.size());
            velocity += model.state.points.velocity[i] / static_cast<double>(model.size());
        }
        speed = velocity.dot(down);
        return moved.dot(down);
    };
    double speed = 0.0;
    const double smooth = travel(0.0, 0.1, speed);
    // without friction nothing along the slope but gravity
    CHECK(speed == doctest::Approx(v + 0.1 * g * std::sin(slope)).epsilon(1e-9).scale(0.0));
    CHECK(smooth == doctest::Approx(0.1 * v + 0.005 * g * std::sin(slope)).epsilon(1e-3).scale(0.0));
    const double braking = g * (0.7 * std::cos(slope) - std::sin(slope));
    const double rough = travel(0.7, 1.5 * v / braking, speed);
    // The reaction bounces about the weight, and friction with it, as the heap lands: a tenth of the way
    CHECK(rough == doctest::Approx(0.5 * v * v / braking).epsilon(0.1).scale(0.0));
    CHECK(std::abs(speed) < 0.01 * v);
    const double later = travel(0.7, 2.5 * v / braking, speed);
    CHECK(std::abs(later - rough) < 0.01 * rough);
}

TEST_CASE("what a contact holds is lost, and told, when its obstacle is taken away")
{
    Meeting meeting({0.0, 0.0, 0.0}, Vector3::UnitZ(), 0.0);
    meeting.model.state.points.position[0].z() = 0.5 * dx;
    meeting.start();
    meeting.model.state.points.position[0].z() = 0.3 * dx;
    meeting.start();
    const double stored = 0.5 * stiffness * std::pow(0.2 * dx, 2);
    CHECK(meeting.contact.energy() == doctest::Approx(stored).epsilon(1e-12).scale(0.0));
    meeting.model.state.obstacles[0].present = false;
    meeting.dynamics.start();
    CHECK(meeting.contact.energy() == 0.0);
    CHECK(meeting.dynamics.ledger().boundary == doctest::Approx(-stored).epsilon(1e-12).scale(0.0));
}

TEST_CASE(
    "a point that begins deep in an obstacle takes the room it finds, without energy, and the whole when it leaves")
{
    Meeting meeting({0.0, 0.0, 0.1 * dx}, Vector3::UnitZ(), 0.0);
    meeting.start();
    CHECK(meeting.contact.energy() == 0.0);
    const auto energy_at = [&](double height) {
        meeting.model.state.points.position[0].z() = height * dx;
        meeting.model.gather_ends();
        std::vector<Vector3> force(1, Vector3::Zero());
        meeting.contact.add_reactions(meeting.model, 1e-5, ContactForces::Approach::none, force);
        return meeting.contact.energy();
    };
    const auto spring = [](double overlap) { return 0.5 * stiffness * std::pow(overlap * dx, 2); };
    CHECK(energy_at(0.05) == doctest::Approx(spring(0.05)).epsilon(1e-12).scale(0.0));
    CHECK(energy_at(0.3) == 0.0);
    CHECK(energy_at(0.1) == doctest::Approx(spring(0.2)).epsilon(1e-12).scale(0.0));
    CHECK(energy_at(0.9) == 0.0);
    CHECK(energy_at(0.1) == doctest::Approx(spring(0.4)).epsilon(1e-12).scale(0.0));
}

TEST_CASE("points that are pulled do the work that a bar takes up")
{
    // Eight layers; the last is pulled for a while too short for the wave to come back from the first, which is held.
    const double v = 0.01;
    Model model = from_positions(lattice(3, 3, 8, dx), dx);
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    ContactForces contact(std::vector<ContactAssignment>{});
    Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
    std::vector<HeldDirection> held;
    for (std::uint32_t i = 0; i < model.size(); ++i) {
        const double z = model.state.points.position[i].z();
        if (z < dx || z > 7.0 * dx)
            for (Eigen::Index c = 0; c < 3; ++c)
                held.push_back({i, Vector3::Unit(c), z > dx && c == 2 ? v : 0.0});
    }
    dynamics.hold(held);
    dynamics.open_ledger(); // before the points have their speed: getting it is work too
    dynamics.start();
    const double step = 2e-6;
    for (int n = 0; n < 1000; ++n)
        dynamics.step({step, MaterialResponse::full, 0.0});
    const EnergyLedger& ledger = dynamics.ledger();
    for (const HeldDirection& at : held)
        CHECK(std::abs(model.state.points.velocity[at.point].dot(at.direction) - at.speed) < 1e-12 * v);
    CHECK(ledger.stress_work > 0.0);
    CHECK(ledger.boundary > 0.0);
    // Force and stress are linear in the strain of 1e-3 but for the strain itself; its share of a step is 1e-6
    CHECK(std::abs(ledger.error()) < 1e-5 * ledger.boundary);
}

namespace {

/// A bar of unit cells side by side, in which no strain but that along z can be, with all its points held.
struct HeldBar {
    explicit HeldBar(int layers)
        : model(from_positions(lattice(1, 1, layers, dx), dx)),
          force(make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon))),
          dynamics(model, *force, contact, {0.1 * dx, false})
    {
        model.neighbourhood.isometries.set_generators({Isometry::shift(0, dx), Isometry::shift(1, dx)});
        find_first_families(model, *force);
    }
    void hold(const std::function<bool(double)>& which, const std::function<double(double)>& speed)
    {
        std::vector<HeldDirection> held;
        for (std::uint32_t i = 0; i < model.size(); ++i)
            if (const double z = model.state.points.position[i].z(); which(z))
                held.push_back({i, Vector3::UnitZ(), speed(z)});
        dynamics.hold(held);
        dynamics.start();
        dynamics.open_ledger();
    }
    void run(double time, int steps)
    {
        for (int n = 0; n < steps; ++n)
            dynamics.step({time / steps, MaterialResponse::full, 0.0});
    }

    Model model;
    std::unique_ptr<ForceState> force;
    ContactForces contact{std::vector<ContactAssignment>{}};
    Dynamics dynamics;
};

} // namespace

TEST_CASE("the work of a linear bar's tension is exact in a few steps")
{
    const double strain = 1e-6, time = 1e-3;
    for (const int steps : {1, 5, 10, 20}) {
        CAPTURE(steps);
        HeldBar bar(8);
        bar.hold([](double) { return true; }, [&](double z) { return strain / time * z; });
        bar.run(time, steps);
        const double modulus = 2.0e6 + 4.0 / 3.0 * 1.2e6; // K + 4 G/3
        const double exact = 0.5 * modulus * strain * strain * 8 * dx * dx * dx;
        // the bar is linear but for terms of the strain; force at the end of a step: 1/steps too much
        CHECK(bar.dynamics.ledger().boundary == doctest::Approx(exact).epsilon(10.0 * strain).scale(0.0));
        CHECK(std::abs(bar.dynamics.ledger().error()) < 10.0 * strain * exact);
    }
}

TEST_CASE("the work of a bar's end that pulls a free layer has an error of second order in the step")
{
    // Two layers are a mass on a spring. Its stiffness follows from the force of a first, small motion of the held end.
    const double v = 1e-5, end = 1.5;
    const auto lower = [](double z) { return z < dx; };
    const auto speed = [&](double) { return -v; };
    double spring = 0.0;
    {
        HeldBar bar(2);
        bar.hold([](double) { return true; }, [&](double z) { return z < dx ? -v : 0.0; });
        bar.run(1e-6, 1);
        spring = 2.0 * bar.dynamics.ledger().boundary / std::pow(v * 1e-6, 2);
    }
    const auto error_in = [&](int steps) {
        HeldBar bar(2);
        bar.hold(lower, speed);
        const double mass = bar.model.state.points.mass[1];
        const double time = end * std::sqrt(mass / spring);
        bar.run(time, steps);
        return bar.dynamics.ledger().boundary / (mass * v * v * (1.0 - std::cos(end))) - 1.0;
    };
    const double five = error_in(5), ten = error_in(10), twenty = error_in(20);
    CHECK(std::abs(five) < 0.02); // as of the wall above; with the force at the end of a step 0.2
    CHECK(five / ten == doctest::Approx(4.0).epsilon(0.09).scale(0.0));
    CHECK(ten / twenty == doctest::Approx(4.0).epsilon(0.03).scale(0.0));
}
