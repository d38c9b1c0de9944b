// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Grains that move in corners, over edges and along valleys of one obstacle: forces, energy, equilibrium, crossing.
#include "contact/short_range/short_range.hpp"
#include "support/archives.hpp"
#include "support/corners.hpp"
#include "support/specimens.hpp"
#include "time/dynamics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <random>

using namespace specimens;
using periporo::test::NamedShape;
using periporo::test::Shape;

namespace {

constexpr double dx = 0.01;
constexpr double stiffness = 500.0; // [N/m]
constexpr double reach = 0.5 * dx;

std::shared_ptr<const Contact> law(double friction, double restitution)
{
    Parameters parameters;
    parameters.set("stiffness", stiffness);
    parameters.set("friction", friction);
    parameters.set("restitution", restitution);
    auto made = std::make_shared<ShortRange>(parameters);
    made->scale({dx, 3.015 * dx, ContactPartner::surface});
    return made;
}

/// Grains that meet obstacles, each under a law of its own.
struct Scene {
    Scene(const std::vector<Vector3>& grains, const std::vector<Shape>& shapes, double friction, double restitution)
        : model(from_positions(grains, dx)), contact(assignments(shapes.size(), friction, restitution)),
          force(make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon))),
          dynamics(model, *force, contact, {0.1 * dx, false})
    {
        for (const Shape& shape : shapes)
            model.state.obstacles.push_back({"obstacle", shape});
        model.state.gravity = Vector3::Zero();
        find_first_families(model, *force);
    }
    static std::vector<ContactAssignment> assignments(std::size_t count, double friction, double restitution)
    {
        std::vector<ContactAssignment> result;
        for (std::uint32_t o = 0; o < count; ++o)
            result.push_back({law(friction, restitution), {0}, o, {}});
        return result;
    }
    void start()
    {
        dynamics.start();
        dynamics.open_ledger();
    }
    void step(double time_step, double damping = 0.0) { dynamics.step({time_step, MaterialResponse::full, damping}); }
    /// Kinetic, stored and that of gravity [J].
    double energy() const
    {
        double sum = contact.energy();
        for (std::size_t i = 0; i < model.size(); ++i)
            sum += model.state.points.mass[i] * (0.5 * model.state.points.velocity[i].squaredNorm() -
                                                 model.state.gravity.dot(model.state.points.position[i]));
        return sum;
    }

    Model model;
    ContactForces contact;
    std::unique_ptr<ForceState> force;
    Dynamics dynamics;
};

/// The largest change of the energy of a grain that is thrown, without friction, over its first kinetic energy.
double energy_error(const Shape& shape, const Vector3& from, const Vector3& velocity, const Vector3& gravity,
                    double duration, double time_step)
{
    Scene scene({from}, {shape}, 0.0, 1.0);
    scene.model.state.points.velocity[0] = velocity;
    scene.model.state.gravity = gravity;
    scene.start();
    const double before = scene.energy();
    double error = 0.0;
    double most_stored = 0.0;
    for (long n = 0; n < std::lround(duration / time_step); ++n) {
        scene.step(time_step);
        error = std::max(error, std::abs(scene.energy() - before));
        most_stored = std::max(most_stored, scene.contact.energy());
    }
    const double kinetic = 0.5 * scene.model.state.points.mass[0] * velocity.squaredNorm();
    CHECK(most_stored > 0.1 * kinetic); // it touches
    CHECK(scene.contact.crossings().empty());
    return error / kinetic;
}

void check_energy(const Shape& shape, const Vector3& from, const Vector3& velocity, const Vector3& gravity,
                  double duration)
{
    const double time_step = 1e-4; // (k/m)^(1/2) dt = 0.05
    double coarse = 0.0;
    double fine = 0.0;
    const int throws = 8; // at other parts of a step: where a face is met the force has a kink, which falls by chance
    for (int n = 0; n < throws; ++n) {
        const Vector3 start = from + n * time_step / throws * velocity;
        coarse += energy_error(shape, start, velocity, gravity, duration, time_step) / throws;
        fine += energy_error(shape, start, velocity, gravity, duration, time_step / 4.0) / throws;
    }
    // Verlet's energy is wrong by (omega dt)^2/8 of what a spring exchanges, here 3e-4; faces come and go.
    CHECK(coarse < 3e-3);
    CHECK(fine < coarse / 12.0); // 16 but for what is left of chance
}

} // namespace

TEST_CASE("one obstacle with a corner pushes as three obstacles with a face each, dashpots included")
{
    using periporo::test::box;
    const Vector3 low = Vector3::Constant(-periporo::test::wall);
    std::vector<Shape> faces;
    for (int axis = 0; axis < 3; ++axis)
        faces.push_back(box(low, Vector3::Constant(periporo::test::far) - periporo::test::far * Vector3::Unit(axis)));
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> place(0.3 * reach, 1.3 * reach);
    std::uniform_real_distribution<double> speed(-0.05, 0.05); // the springs push harder than the dashpots pull
    for (const NamedShape& corner : periporo::test::solid_corners())
        for (const double restitution : {1.0, 0.5}) {
            CAPTURE(corner.name);
            for (int n = 0; n < 50; ++n) {
                const Vector3 grain(place(generator), place(generator), place(generator));
                if (((grain.array() - reach).abs() < 0.1 * reach).any())
                    continue; // a face whose spring is weaker than that
                Scene one({grain}, {corner.shape}, 0.0, restitution);
                Scene three({grain}, faces, 0.0, restitution);
                std::vector<Vector3> forces;
                const Vector3 velocity(speed(generator), speed(generator), speed(generator));
                for (Scene* scene : {&one, &three}) {
                    scene->model.state.points.velocity[0] = velocity;
                    scene->model.gather_ends();
                    scene->contact.find_candidates(scene->model, 0.0);
                    std::vector<Vector3> force(1, Vector3::Zero());
                    scene->contact.add_reactions(scene->model, 1e-5, ContactForces::Approach::real, force);
                    forces.push_back(force[0]);
                }
                // places of the faces to 1e-8 of the reach
                CHECK((forces[0] - forces[1]).norm() <= 1e-7 * stiffness * reach);
                CHECK(std::abs(one.contact.energy() - three.contact.energy()) <= 1e-7 * stiffness * reach * reach);
            }
        }
}

TEST_CASE("a grain that is thrown into a corner of one obstacle keeps its energy")
{
    for (const NamedShape& corner : periporo::test::solid_corners()) {
        CAPTURE(corner.name);
        check_energy(corner.shape, Vector3(2.0, 2.2, 2.5) * reach, {-0.5, -0.7, -0.8}, Vector3::Zero(), 0.06);
    }
}

TEST_CASE("a grain that is thrown over an edge, along a valley or into a notch keeps its energy")
{
    using periporo::test::box;
    const Vector3 low = Vector3::Constant(-periporo::test::wall);
    SUBCASE("edge of a box")
    {
        check_energy(box(low, Vector3::Zero()), Vector3(-1.0, -2.0, 2.0) * reach, {0.3, 0.05, -0.4}, Vector3::Zero(),
                     0.06);
    }
    SUBCASE("edge of a union")
    {
        check_energy(periporo::test::boolean("union", {box(low, Vector3::Zero()),
                                                       box(low + Vector3(0.0, 0.04, 0.0), Vector3(0.0, 0.06, 0.0))}),
                     Vector3(-1.0, -2.0, 2.0) * reach, {0.3, 0.2, -0.4}, Vector3::Zero(), 0.06);
    }
    SUBCASE("valley of a terrain")
    {
        const Shape valley = periporo::test::heightfield(0.16, 16, [](double x, double y) {
            return 0.7 * std::abs(x) + 0.1 * std::abs(y) * (y > 0.0 ? 1.0 : -1.0);
        });
        check_energy(valley, {0.004, 0.08, 0.02}, {0.1, -0.5, -0.2}, {0.0, 0.0, -9.81}, 0.2);
    }
    SUBCASE("notch")
    {
        const Shape notch =
            periporo::test::geometry("prism", {{"polygon", std::vector{-0.1, -0.1, 0.1, -0.1, 0.1, 0.05, 0.02, 0.05,
                                                                       0.0, -0.02, -0.02, 0.05, -0.1, 0.05}},
                                               {"height", 0.2}});
        check_energy(notch, {0.004, 0.03, 0.1}, {0.3, -0.6, 0.2}, Vector3::Zero(), 0.1);
    }
}

TEST_CASE("a grain comes to rest in a corner of one obstacle, where it comes to rest among three")
{
    const Vector3 gravity(-5.0, -3.0, -8.0);
    for (const NamedShape& corner : periporo::test::solid_corners()) {
        CAPTURE(corner.name);
        const Vector3 start = Vector3(1.05, 1.1, 1.0) * reach;
        Scene settling({start}, {corner.shape}, 0.0, 1.0);
        Scene bouncing({start}, {corner.shape}, 0.0, 0.1);
        for (Scene* scene : {&settling, &bouncing}) {
            const double damping = scene == &settling ? 0.8 : 0.0;
            scene->model.state.gravity = gravity;
            scene->start();
            for (int n = 0; n < 2000; ++n) // 20 ms of 38/s; omega = 527/s
                scene->step(damping > 0.0 ? 5e-4 : 5e-5, damping);
            // each face carries its part of the weight: m g = k o
            const Vector3 rest = Vector3::Constant(reach) + scene->model.state.points.mass[0] / stiffness * gravity;
            CHECK((scene->model.state.points.position[0] - rest).norm() < 1e-6 * reach);
            CHECK(scene->dynamics.residual() < 1e-3);
        }
    }
}

TEST_CASE("the friction of a groove is that of the pushes of its two sides")
{
    // Sides at 45 degrees: a weight W presses with W/2^(1/2) on each, and friction holds 2^(1/2) mu W along the groove.
    const Shape groove = periporo::test::heightfield(0.08, 8, [](double x, double) { return std::abs(x); });
    const double overlap = 0.1 * reach;
    const double mu = 0.3;
    Scene scene({Vector3(0.0, 0.013, std::sqrt(2.0) * (reach - overlap))}, {groove}, mu, 1.0);
    scene.model.state.points.velocity[0] = {0.0, 1.0, 0.0};
    scene.model.gather_ends();
    scene.contact.find_candidates(scene.model, 0.0);
    std::vector<Vector3> force(1, Vector3::Zero());
    scene.contact.add_reactions(scene.model, 1e-5, ContactForces::Approach::none, force);
    const double weight = force[0].z();
    CHECK(weight == doctest::Approx(stiffness * std::sqrt(2.0) * overlap).epsilon(1e-7));
    scene.contact.add_surface_friction(scene.model, 1e-5, force);
    CHECK(force[0].y() == doctest::Approx(-std::sqrt(2.0) * mu * weight).epsilon(1e-7));
}

TEST_CASE("a thin plate throws a grain back as a thick wall does, as long as its law can stop it")
{
    using periporo::test::box;
    const double speed = 1.5; // sinks in by v/omega = 2.8 mm: more than half of the plate's thickness
    std::vector<Vector3> back;
    for (const double thickness : {4e-3, 0.1}) {
        // a reach of 0.5 mm: what is deeper lies in the plate
        Parameters parameters;
        parameters.set("stiffness", stiffness);
        parameters.set("friction", 0.0);
        parameters.set("restitution", 1.0);
        parameters.set("cutoff", 5e-4);
        auto thin_law = std::make_shared<ShortRange>(parameters);
        thin_law->scale({dx, 3.015 * dx, ContactPartner::surface});
        Scene scene({Vector3(0.0, 0.0, 2e-3)}, {box({-0.1, -0.1, -thickness}, {0.1, 0.1, 0.0})}, 0.0, 1.0);
        scene.contact = ContactForces({{thin_law, {0}, 0, {}}});
        scene.model.state.points.velocity[0] = {0.2, 0.0, -speed};
        scene.start();
        for (int n = 0; n < 800; ++n) {
            scene.step(1e-5);
            REQUIRE(scene.contact.crossings().empty());
        }
        back.push_back(scene.model.state.points.velocity[0]);
    }
    CHECK(back[0].z() == doctest::Approx(speed).epsilon(1e-5)); // (omega dt)^2/24 = 1e-6
    CHECK((back[0] - back[1]).norm() < 1e-12);
}

TEST_CASE("a grain that goes through a plate is seen once, and does not gain energy")
{
    using periporo::test::box;
    for (const double speed : {4.0, 30.0, 3000.0}) { // sinks through, and leaps over the plate in a step
        CAPTURE(speed);
        Scene scene({Vector3(0.0, 0.0, 0.021)}, {box({-0.1, -0.1, -2e-3}, {0.1, 0.1, 0.0})}, 0.0, 1.0);
        scene.model.state.points.velocity[0] = {0.0, 0.0, -speed};
        scene.start();
        const double before = scene.energy();
        int crossings = 0;
        for (int n = 0; n < 200 && scene.model.state.points.position[0].z() > -0.05; ++n) {
            scene.step(1e-4 * std::min(1.0, 30.0 / speed) * (speed > 1000.0 ? 10.0 : 1.0));
            crossings += static_cast<int>(scene.contact.crossings().size());
        }
        CHECK(crossings == 1);
        CHECK(scene.model.state.points.position[0].z() < -0.02);
        CHECK(scene.contact.crossed_points()[0] == 1);
        CHECK(scene.energy() <= before * (1.0 + 1e-3)); // half of (omega dt)^2
    }
}

TEST_CASE("a plate that comes fast is held to the same")
{
    using periporo::test::box;
    Scene scene({Vector3(0.0, 0.0, -0.021)}, {box({-0.1, -0.1, 0.0}, {0.1, 0.1, 2e-3})}, 0.0, 1.0);
    scene.model.state.obstacles[0].velocity = {0.0, 0.0, -300.0};
    scene.start();
    int crossings = 0;
    for (int n = 0; n < 3; ++n) {
        scene.step(1e-4);
        crossings += static_cast<int>(scene.contact.crossings().size());
    }
    CHECK(crossings == 1);
}

TEST_CASE("a contact that is restored goes on with the same bits")
{
    using periporo::test::box;
    const Vector3 low = Vector3::Constant(-periporo::test::wall);
    // one grain deep in a thin plate, nearer to its back; others in the corner and on its way to it
    const Shape shape =
        periporo::test::boolean("union", {box({-0.1, -0.1, -2e-3}, {0.1, 0.1, 0.0}), box(low, Vector3(0.0, 0.1, 0.1))});
    const std::vector<Vector3> grains{{0.05, 0.05, 1.1 * reach}, {0.9 * reach, 0.0, 0.9 * reach}, {0.02, 0.0, 0.02}};
    const auto launch = [&](Scene& scene) {
        scene.model.state.points.velocity = {{0.0, 0.1, -3.8}, {-0.3, 0.0, -0.4}, {-0.4, 0.0, -0.4}};
        scene.model.state.obstacles[0].velocity = {0.01, 0.0, 0.02};
    };
    Scene whole(grains, {shape}, 0.2, 0.8);
    launch(whole);
    whole.start();
    for (int n = 0; n < 300; ++n)
        whole.step(1e-5);
    REQUIRE(whole.model.state.points.position[0].z() - whole.model.state.obstacles[0].shift.z() <
            -1.1e-3); // nearer to the back
    Scene resumed(grains, {shape}, 0.2, 0.8);
    launch(resumed);
    resumed.start();
    periporo::test::save_and_restore(whole.contact, resumed.contact, grains.size(), std::size_t{1});
    resumed.contact.resume(resumed.model, 0.1 * dx);
    resumed.model.state.obstacles[0].shift = whole.model.state.obstacles[0].shift;
    resumed.model.state.points = whole.model.state.points;
    resumed.model.gather_ends();
    for (int n = 0; n < 1000; ++n) {
        whole.step(1e-5);
        resumed.step(1e-5);
    }
    CHECK(whole.contact.crossed_points()[0] == 0);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        CAPTURE(i);
        CHECK(whole.model.state.points.position[i] == resumed.model.state.points.position[i]);
        CHECK(whole.model.state.points.position[i].z() > 0.0); // it was held
    }
}

TEST_CASE("a grain that crosses a plate right after it was restored loses the energy that it had stored")
{
    using periporo::test::box;
    const Shape plate = box({-0.1, -0.1, -2e-3}, {0.1, 0.1, 0.0});
    const std::vector<Vector3> grains{{0.05, 0.05, 1.1 * reach}};
    const auto launched = [&](int steps) {
        auto scene = std::make_unique<Scene>(grains, std::vector<Shape>{plate}, 0.2, 0.8);
        scene->model.state.points.velocity = {{0.0, 0.0, -6.0}};
        scene->start();
        for (int n = 0; n < steps; ++n)
            scene->step(1e-5);
        return scene;
    };
    const auto probe = launched(0);
    int before = 0; // steps before the one in which it crosses
    for (probe->step(1e-5); probe->contact.crossings().empty() && before < 1000; probe->step(1e-5))
        ++before;
    REQUIRE(before < 1000);
    const auto whole = launched(before), resumed = launched(0);
    periporo::test::save_and_restore(whole->contact, resumed->contact, grains.size(), std::size_t{1});
    periporo::test::save_and_restore(whole->dynamics, resumed->dynamics);
    resumed->contact.resume(resumed->model, 0.1 * dx);
    resumed->model.state.points = whole->model.state.points;
    for (Scene* scene : {whole.get(), resumed.get()}) {
        scene->step(1e-5);
        CHECK(scene->contact.crossings().size() == 1);
    }
    CHECK(whole->contact.energy_of_crossings() > 0.0);
    CHECK(resumed->contact.energy_of_crossings() == whole->contact.energy_of_crossings());
    CHECK(resumed->dynamics.ledger().collision == whole->dynamics.ledger().collision);
}
