// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What bonds keep when families are found anew.
#include "support/specimens.hpp"

#include <doctest/doctest.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;

/// Hooke's law that remembers its volumetric strain, as a variable of the point.
struct HookeWithMemory : Hooke {
    static constexpr std::size_t state_count = 1;
    static std::vector<StateVariable> state_variables()
    {
        return {{"volumetric_strain", "-", "accumulated tr D dt", 0.0, false, true}};
    }
    using Hooke::Hooke;
    template <class Real>
    LawResult<Real, 1> update(const LawInput<Real, 1>& old) const
    {
        return {elastic_stress(old.stress, old.strain_increment, bulk_modulus(), shear_modulus()),
                {old.state[0] + trace(old.strain_increment)}};
    }
    template <class Real>
    std::array<Real, 1> initial_state(const LawInput<Real, 1>& settled, double) const
    {
        return settled.state;
    }
};

constexpr std::size_t memory = 6; // its row

/// A jittered block whose points remember random volumetric strains.
Model with_memory(const ForceState& force)
{
    Model model = from_positions(jittered(lattice(5, 5, 5, dx), dx, 0.2), dx);
    model.state.bodies[0].material = std::make_shared<LawMaterial<HookeWithMemory>>(Parameters{});
    model.allocate();
    find_first_families(model, force);
    model.gather_ends();
    force.evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0}); // finds the active bonds
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b)
            bond_value(model, i, b, memory) = value(generator);
    return model;
}

/// Calls check(force state's name, force state, block) with every operator, the points' variables being collected.
template <class Check>
void for_every_block_with_memory(const Check& check)
{
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        Model model = with_memory(force);
        collect_point_variables(model, force);
        check(state, force, model);
    });
}

Vector3 turned(const Vector3& x, const Vector3& centre, double angle)
{
    return centre + Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -0.5).normalized()) * (x - centre);
}

} // namespace

TEST_CASE("a uniformly stressed block keeps its stress, turned with it, through many refreshes")
{
    const SymmetricTensor<double> initial{-4e3, -2e3, -3e3, 1e3, 0.5e3, -0.7e3};
    const int steps = 60;
    const double dt = 1e-3, total = 1.1; // rad
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        Model model = from_positions(jittered(lattice(6, 6, 6, dx), dx, 0.1), dx);
        find_first_families(model, force);
        set_stress(model, [&](std::size_t, std::size_t) { return initial; });
        model.gather_ends();
        force.evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0}); // finds the active bonds
        const std::vector<Vector3> start = model.state.points.position;
        const Vector3 centre = dx * Vector3(3, 3, 3);
        const Vector3 shift = Vector3(0.3, -0.2, 0.1) * dx;
        for (int step = 1; step <= steps; ++step) {
            for (std::size_t i = 0; i < model.size(); ++i) {
                const Vector3 next = turned(start[i], centre, total * step / steps) + step * shift;
                model.state.points.velocity[i] = (next - model.state.points.position[i]) / dt;
                model.state.points.position[i] = next;
            }
            refresh_families(model, force);
            force.evaluate(model, {StressUpdate::advance, MaterialResponse::full, dt});
        }
        const Eigen::Matrix3d r = Eigen::AngleAxisd(total, Vector3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
        const Eigen::Matrix3d expected = r * matrix(initial) * r.transpose();
        double worst = 0.0;
        for (std::size_t i = 0; i < model.size(); ++i)
            for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b) {
                const auto v = [&](std::size_t c) { return bond_value(model, i, b, c); };
                worst = std::max(worst, (matrix({v(0), v(1), v(2), v(3), v(4), v(5)}) - expected).norm());
            }
        CHECK(worst < 1e-10 * expected.norm());
    });
}

TEST_CASE("a bond that stays keeps its own stress, a new bond takes the mean of its ends")
{
    Model model = from_positions(lattice(6, 6, 6, dx), dx);
    const auto force = make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon));
    find_first_families(model, *force);
    set_stress(model, [](std::size_t i, std::size_t b) {
        return SymmetricTensor<double>::isotropic(1000.0 * static_cast<double>(i) + static_cast<double>(b));
    });
    model.gather_ends();
    force->evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
    const Model before = model;
    // one point moves by a spacing: some of its bonds die, some are born, those of the others stay
    const std::size_t mover = (2 * 6 + 2) * 6 + 2;
    model.state.points.position[mover] += Vector3(0.6, 0.5, 0.4) * dx;
    std::vector<double> means = model.state.point_states.values;
    mean_point_states(model, *force, means);
    refresh_families(model, *force);
    std::size_t kept = 0, born = 0;
    Model old = before;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const FamilyView now = model.neighbourhood.families[i];
        const FamilyView then = old.neighbourhood.families[i];
        for (std::size_t b = 0; b < now.count; ++b) {
            const std::uint32_t j = now.neighbours[b];
            const auto* at = std::find(then.neighbours, then.neighbours + then.count, j);
            const double stress = bond_value(model, i, b, 0);
            if (at != then.neighbours + then.count) {
                CHECK(stress == bond_value(old, i, static_cast<std::size_t>(at - then.neighbours), 0));
                ++kept;
            } else {
                const double mean =
                    0.5 * (model.state.point_states.values[i * 6] + model.state.point_states.values[j * 6]);
                CHECK(stress == doctest::Approx(mean).epsilon(1e-14));
                ++born;
            }
        }
    }
    CHECK(born > 10);
    CHECK(kept > 100 * born / 10);
}

TEST_CASE("the mean state of a point is the weighted mean over its bonds")
{
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        Model model = from_positions(jittered(lattice(5, 5, 5, dx), dx, 0.2), dx);
        find_first_families(model, force);
        std::mt19937 generator(11);
        std::uniform_real_distribution<double> value(-1.0, 1.0);
        set_stress(model,
                   [&](std::size_t, std::size_t) { return SymmetricTensor<double>::isotropic(value(generator)); });
        set_velocity(model, [](const Vector3& x) { return x; }); // D = 1, so the power is V sum w tr(sigma)
        force.evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
        std::vector<double> means = model.state.point_states.values;
        mean_point_states(model, force, means);
        std::size_t whole = 0; // the share of an inactive bond has no power, and no part in the mean
        for (std::size_t i = 0; i < model.size(); ++i)
            if (model.result.inactive_bonds[i] == 0) {
                CHECK(3.0 * means[6 * i] == doctest::Approx(model.result.stress_work[i] / model.state.points.volume[i])
                                                .epsilon(1e-9)
                                                .scale(1.0));
                ++whole;
            }
        CHECK(whole > 9 * model.size() / 10);
    });
}

TEST_CASE("variables of the point are the mean of its bonds once these were set")
{
    for_every_operator(3.015 * dx, [&](const std::string& state, const std::string& influence, ForceState& force) {
        CAPTURE(state);
        CAPTURE(influence);
        Model model = with_memory(force);
        Model before = model;
        collect_point_variables(model, force);
        std::vector<double> weights;
        for (std::size_t i = 0; i < model.size(); ++i) {
            weights.resize(model.neighbourhood.families[i].packs * pack_width);
            force.bond_weights(before, i, weights);
            double mean = 0.0;
            for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b)
                mean += weights[b] * bond_value(before, i, b, memory);
            CHECK(model.state.point_states.values[7 * i + memory] == doctest::Approx(mean).epsilon(1e-12).scale(1.0));
        }
    });
}

TEST_CASE("bonds go on from the variables of their points, which neither fade nor mix through many refreshes")
{
    for_every_block_with_memory([](const std::string& state, ForceState& force, Model& model) {
        const std::vector<double> start = model.state.point_states.values;
        for (int refresh = 0; refresh < 20; ++refresh) {
            set_velocity(model, [&](const Vector3&) { return Vector3(refresh % 2 == 0 ? 0.1 : -0.1, 0.0, 0.0); });
            for (Vector3& x : model.state.points.position)
                x.x() += 1e-3 * model.state.points.velocity[0].x();
            refresh_families(model, force);
            force.evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-3});
        }
        for (std::size_t i = 0; i < model.size(); ++i) {
            CHECK(model.state.point_states.values[7 * i + memory] ==
                  doctest::Approx(start[7 * i + memory]).epsilon(1e-10).scale(1.0));
            for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b) {
                const std::size_t j = model.neighbourhood.families[i].neighbours[b];
                const double own = start[7 * i + memory], other = start[7 * j + memory];
                const double begun = state == "bond_projection" ? 0.5 * (own + other) : own;
                CHECK(bond_value(model, i, b, memory) == doctest::Approx(begun).epsilon(1e-10).scale(1.0));
            }
        }
    });
}

TEST_CASE("a uniform expansion moves the variables of all points by its own amount")
{
    for_every_block_with_memory([](const std::string&, ForceState& force, Model& model) {
        const std::vector<double> start = model.state.point_states.values;
        const double dt = 1e-4;
        set_velocity(model, [](const Vector3& x) { return x; });
        force.evaluate(model, {StressUpdate::advance, MaterialResponse::full, dt});
        double expected = model.result.volume_rate[0];
        CHECK(expected == doctest::Approx(3.0 * dt).epsilon(1e-3).scale(0.0));
        refresh_families(model, force);
        for (std::size_t i = 0; i < model.size(); ++i)
            CHECK(model.state.point_states.values[7 * i + memory] - start[7 * i + memory] ==
                  doctest::Approx(expected).epsilon(1e-9).scale(0.0));
    });
}

TEST_CASE("a point whose only sound bond outgrew the horizon is a free grain and keeps its variables")
{
    // Three neighbours too far from each other to share sub-horizons, and a fourth within reach of all, beyond
    // which the bond to it is stretched before families are found anew.
    const double delta = 3.015 * dx;
    const std::vector<Vector3> positions{Vector3::Zero(), 0.9 * delta * Vector3::UnitX(),
                                         0.9 * delta * Vector3::UnitY(), 0.9 * delta * Vector3::UnitZ(),
                                         0.99 * delta * Vector3::Constant(1.0).normalized()};
    for (const std::string state : {"energy_conjugate", "energy_conjugate_mean"}) {
        CAPTURE(state);
        const auto force = make_force_state(state, Influence::by_name("linear", delta));
        const double spacing = 1.7 * dx; // so that all five are linked
        Model model = from_positions(positions, spacing, delta / spacing);
        model.state.bodies[0].material = std::make_shared<LawMaterial<HookeWithMemory>>(Parameters{});
        model.allocate();
        find_first_families(model, *force);
        model.gather_ends();
        force->evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
        REQUIRE(model.result.detached[0] == 0);
        REQUIRE(model.result.inactive_bonds[0] == 3);
        for (std::size_t b = 0; b < model.neighbourhood.families[0].count; ++b)
            bond_value(model, 0, b, memory) = 0.25;
        collect_point_variables(model, *force);
        REQUIRE(model.state.point_states.values[memory] == 0.25);
        model.state.points.position[4] *= 1.02;
        model.gather_ends();
        force->evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-3});
        CHECK(model.result.detached[0] == 1);
        CHECK(model.result.volume_rate[0] == 0.0);
        refresh_families(model, *force);
        CHECK(model.state.point_states.values[memory] == 0.25);
    }
}
