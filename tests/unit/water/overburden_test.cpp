// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The weight less buoyancy above a place.
#include "diagnostics/vertical_stress.hpp"
#include "support/specimens.hpp"
#include "water/overburden.hpp"

#include <doctest/doctest.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double g = 9.81;

/// A column of 10 layers from z = 0 up, with water up to `level`.
Model column(double level)
{
    Model model = from_positions(lattice(4, 4, 10, dx), dx);
    model.state.gravity = {0.0, 0.0, -g};
    model.state.bodies[0].water_level = level;
    return model;
}

} // namespace

TEST_CASE("below the water table a layer adds its weight in water, above it its weight")
{
    const double level = 0.06;
    const Model model = column(level);
    const Overburden overburden(model, 0);
    CHECK(overburden.top() == doctest::Approx(0.1).epsilon(1e-12));
    for (const double depth : {0.0, 0.013, 0.04, 0.0551, 0.1}) {
        CAPTURE(depth);
        const double above = std::min(depth, 0.1 - level), below = std::max(0.0, depth - (0.1 - level));
        CHECK(overburden.at(depth, 0) ==
              doctest::Approx(g * (density * above + (density - 1000.0) * below)).epsilon(1e-12));
    }
}

TEST_CASE("layers of different density add up from the top")
{
    Model model = column(-1.0);
    for (std::size_t i = 0; i < model.size(); ++i)
        if (model.state.points.position[i].z() < 0.05)
            model.state.points.mass[i] *= 1.2;
    const Overburden overburden(model, 0);
    CHECK(overburden.at(0.08, 0) == doctest::Approx(density * g * (0.05 + 1.2 * 0.03)).epsilon(1e-12));
}

TEST_CASE("a submerged column that carries its weight in water has no deviation in the profile of vertical stress")
{
    Model model = column(0.2);
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    set_stress(model, [&](std::size_t i, std::size_t) {
        SymmetricTensor<double> s;
        s.zz = -(density - 1000.0) * g * (0.1 - model.state.points.position[i].z());
        return s;
    });
    force->evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
    const auto profile = vertical_stress(model, *force, 0);
    REQUIRE(profile);
    CHECK(profile->largest_deviation < 1e-12); // sums of some 100 shares
}
