// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The estimate of the largest frequency and the step that follows.
#include "support/specimens.hpp"
#include "time/dynamics.hpp"
#include "time/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;

/// Largest omega^2 from the whole matrix, column by column.
double dense_frequency(Model& model, const ForceState& force)
{
    const auto n = static_cast<Eigen::Index>(3 * model.size());
    Eigen::MatrixXd k(n, n);
    for (Eigen::Index c = 0; c < n; ++c) {
        for (std::size_t i = 0; i < model.size(); ++i)
            model.state.points.velocity[i] = Vector3::Zero();
        model.state.points.velocity[static_cast<std::size_t>(c / 3)][c % 3] = 1.0;
        model.gather_ends();
        force.evaluate(model, {StressUpdate::tangent, MaterialResponse::elastic, 0.0});
        for (Eigen::Index r = 0; r < n; ++r)
            k(r, c) = -model.result.internal_force[static_cast<std::size_t>(r / 3)][r % 3] / model.state.points.mass[0];
    }
    return std::sqrt(k.eigenvalues().real().maxCoeff());
}

/// An elastic block that moves, by very little, in its highest mode.
struct BlockInHighestMode {
    explicit BlockInHighestMode(const char* influence)
        : model(from_positions(lattice(5, 5, 5, dx), dx)),
          force(make_force_state("energy_conjugate", Influence::by_name(influence, model.state.horizon)))
    {
        find_first_families(model, *force);
        FrequencyEstimate estimate;
        omega = estimate.update(model, *force);
        double largest = 0.0;
        for (const Vector3& value : estimate.mode())
            largest = std::max(largest, value.norm());
        for (std::size_t i = 0; i < model.size(); ++i)
            model.state.points.velocity[i] = 1e-9 * estimate.mode()[i] / largest;
        dynamics.start();
        dynamics.open_ledger();
    }

    Model model;
    std::unique_ptr<ForceState> force;
    ContactForces contact{{}};
    Dynamics dynamics{model, *force, contact, {1e9, false}};
    double omega = 0.0;
};

/// The lowest layer of a lattice on springs and dashpots that push and pull.
class Bedding : public Contact {
public:
    Bedding(double stiffness, double damping) : stiffness_(stiffness), damping_(damping) {}
    void scale(const ContactScale&) override {}
    double cutoff() const override { return dx; }
    double friction() const override { return 0.0; }
    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const double overlap = 0.5 * dx - pairs[p].distance;
            const double braking = damping_ * pairs[p].approach_speed;
            responses[p] = {stiffness_ * overlap + braking, stiffness_, 0.5 * stiffness_ * overlap * overlap, braking};
        }
    }
    const RigidSurface* surface() const override { return &plane_; }

private:
    struct Plane : RigidSurface {
        double distance(const Vector3& position, Vector3& normal) const override
        {
            normal = Vector3::UnitZ();
            return position.z();
        }
    };
    double stiffness_;
    double damping_;
    Plane plane_;
};

} // namespace

TEST_CASE("the largest frequency of the dense operator is found, from below")
{
    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        Model model = from_positions(jittered(lattice(4, 4, 5, dx), dx, 0.1), dx);
        const auto force = make_force_state(state, Influence::by_name("constant", model.state.horizon));
        find_first_families(model, *force);
        const double exact = dense_frequency(model, *force);
        FrequencyEstimate estimate;
        const double found = estimate.update(model, *force);
        CHECK(found <= exact * (1.0 + 1e-9)); // a Ritz value comes from below
        CHECK(found > 0.99 * exact);
    }
}

TEST_CASE("the estimate changes no state and no result of the model")
{
    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        Model model = from_positions(jittered(lattice(4, 4, 5, dx), dx, 0.1), dx);
        const auto force = make_force_state(state, Influence::by_name("linear", model.state.horizon));
        find_first_families(model, *force);
        set_velocity(model, [](const Vector3& x) { return Vector3(x.y(), -0.3 * x.x(), 0.1); });
        force->evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-5});
        const Model before = model;
        FrequencyEstimate().update(model, *force);
        CHECK(model.state.points.velocity == before.state.points.velocity);
        CHECK(model.result.internal_force == before.result.internal_force);
        CHECK(model.result.stress_work == before.result.stress_work);
        CHECK(model.result.volume_rate == before.result.volume_rate);
        CHECK(model.result.active == before.result.active);
        for (std::size_t i = 0; i < model.size(); ++i) {
            REQUIRE(model.ends[i].v() == before.ends[i].v());
            for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b)
                REQUIRE(model.bond_state(i, b)[0] == before.bond_state(i, b)[0]);
        }
    }
}

TEST_CASE("a stiff place that arises away from the last highest mode is found within a renewal")
{
    // 768 points; the highest mode is in the bulk. Then one corner point becomes light, and its mode the highest.
    Model model = from_positions(jittered(lattice(8, 8, 12, dx), dx, 0.1), dx);
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    FrequencyEstimate estimate;
    const double before = estimate.update(model, *force);
    model.state.points.mass[0] /= 8.0;
    const double renewed = estimate.update(model, *force);
    const int after_change = estimate.evaluations();
    FrequencyEstimate anew;
    double converged = 0.0;
    for (int search = 0; search < 5; ++search) // each goes on from the mode of the last
        converged = std::max(converged, anew.update(model, *force));
    REQUIRE(converged > 1.2 * before); // the test would see nothing otherwise
    CHECK(renewed > 0.98 * converged);
    // where nothing has changed the value is known again after a few evaluations, and stays where it was
    const double again = estimate.update(model, *force);
    CHECK(estimate.evaluations() <= 5);
    CHECK(estimate.evaluations() < after_change);
    CHECK(again == doctest::Approx(renewed).epsilon(FrequencyEstimate::residual));
}

TEST_CASE("an elastic block is stable at the step the estimate allows and not at 1.1 times 2/omega")
{
    const auto grows = [](double factor) {
        BlockInHighestMode block("constant");
        const double first = block.dynamics.mean_speed();
        double largest = 0.0;
        for (int step = 0; step < 60; ++step) {
            block.dynamics.step({factor * 2.0 / block.omega, MaterialResponse::full, 0.0});
            largest = std::max(largest, block.dynamics.mean_speed());
        }
        return largest > 10.0 * first;
    };
    CHECK_FALSE(grows(0.95));
    CHECK(grows(1.1));
}

TEST_CASE("a block in its highest mode settles under local damping at the step that is left, and not at 1.1 times it")
{
    const auto grows = [](double factor) {
        BlockInHighestMode block("linear");
        const double first = block.dynamics.mean_speed();
        for (int step = 0; step < 60; ++step)
            block.dynamics.step({factor * local_damping_factor(0.8) * 2.0 / block.omega, MaterialResponse::full, 0.8});
        return !(block.dynamics.mean_speed() <= first); // beyond the limit it soon is no number
    };
    CHECK_FALSE(grows(0.95));
    CHECK(grows(1.1));
}

TEST_CASE(
    "a block on dashpots is stable at the step that comes out for both, not much beyond, nor without counting them")
{
    struct Ground {
        double stiffness; // over that of the operator at its highest frequency
        double damping;   // c/m over that frequency
    };
    for (const Ground& ground : {Ground{0.3, 0.0}, Ground{0.1, 0.8}, Ground{0.0, 4.0}}) {
        CAPTURE(ground.stiffness);
        CAPTURE(ground.damping);
        const auto growth = [&](double factor) {
            BlockInHighestMode block("constant");
            const double mass = block.model.state.points.mass[0];
            block.contact =
                ContactForces({{std::make_shared<Bedding>(ground.stiffness * mass * std::pow(block.omega, 2),
                                                          ground.damping * mass * block.omega),
                                {0}}});
            block.contact.find_candidates(block.model, 0.1 * dx);
            FrequencyEstimate estimate;
            double step = 0.0;
            constexpr double unresolved = 1e9; // the contacts need not be resolved here, only be stable
            for (int renewal = 0; renewal < 6; ++renewal)
                step =
                    stable_step(block.model, *block.force, block.contact, estimate, 1.0, step, true, unresolved).step;
            CHECK(step < 0.97 * 2.0 / block.omega);
            for (std::size_t i = 0; i < block.model.size(); ++i) // the lowest layer meets the ground
                if (block.model.state.points.position[i].z() < dx)
                    block.model.state.points.velocity[i].z() += 1e-9 * (i % 2 == 0 ? 1.0 : -1.0);
            block.dynamics.start();
            const double first = block.dynamics.mean_speed();
            double largest = 0.0;
            for (int n = 0; n < 120; ++n) {
                block.dynamics.step({factor * step, MaterialResponse::full, 0.0});
                largest = std::max(largest, block.dynamics.mean_speed());
            }
            return largest / first;
        };
        CHECK(growth(0.98) < 3.0);
        CHECK_FALSE(growth(1.15) < 10.0);
    }
}

TEST_CASE("a damped oscillator in leapfrog steps is stable just below the limit and not just above it")
{
    const double omega_squared = 9.0, damping = 2.5;
    const auto largest = [&](double factor) {
        const double dt = factor * damped_limit(omega_squared, damping);
        double x = 1.0, v = 0.0, reached = 0.0; // v of the last mid-step
        for (int step = 0; step < 4000; ++step) {
            v += dt * (-omega_squared * x - damping * v);
            x += dt * v;
            reached = step < 2000 ? reached : std::max(reached, std::abs(x));
        }
        return reached;
    };
    CHECK(largest(0.99) < 1e-3);
    CHECK(largest(1.01) > 1e3);
    CHECK(damped_limit(omega_squared, 0.0) == doctest::Approx(2.0 / 3.0).epsilon(1e-15));
}
