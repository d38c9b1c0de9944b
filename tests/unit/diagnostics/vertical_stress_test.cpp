// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The profile of the settled vertical stress.
#include "diagnostics/vertical_stress.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double g = 9.81;
constexpr int rows = 10;

/// A body in which all bonds of a point carry the vertical stress `at(height)`.
std::optional<VerticalStress> profile(const std::vector<Vector3>& points, const std::function<double(double)>& at,
                                      double gravity = g)
{
    Model model = from_positions(points, dx);
    model.state.gravity = {0.0, 0.0, -gravity};
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    set_stress(model, [&](std::size_t i, std::size_t) {
        SymmetricTensor<double> s;
        s.zz = at(model.state.points.position[i].z());
        return s;
    });
    force->evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
    return vertical_stress(model, *force, 0);
}

/// That of a column of `rows` layers.
std::optional<VerticalStress> profile(const std::function<double(double)>& at, double gravity = g)
{
    return profile(lattice(4, 4, rows, dx), at, gravity);
}

double weight_above(double height)
{
    return -density * g * (rows * dx - height);
}

} // namespace

TEST_CASE("a column that carries the weight above has no deviation, layer by layer from the top")
{
    const auto found = profile(weight_above);
    REQUIRE(found);
    REQUIRE(found->layers.size() == rows);
    for (std::size_t k = 0; k < rows; ++k) {
        CHECK(found->layers[k].depth == doctest::Approx((static_cast<double>(k) + 0.5) * dx).epsilon(1e-12).scale(0.0));
        CHECK(found->layers[k].stress ==
              doctest::Approx(weight_above((rows - 0.5 - static_cast<double>(k)) * dx)).epsilon(1e-12));
    }
    CHECK(found->largest_deviation < 1e-12); // sums of some 100 shares
}

TEST_CASE("a layer that misses half of the bottom stress is found, and near the floor it is no inner one")
{
    const double bottom = density * g * (rows - 0.5) * dx;
    const auto found = profile([&](double z) { return weight_above(z) + (z < dx ? 0.5 * bottom : 0.0); });
    REQUIRE(found);
    CHECK(found->largest_deviation == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(found->inner_deviation < 1e-12);
    const auto inside = profile([&](double z) { return weight_above(z) + (z > 5 * dx && z < 6 * dx ? bottom : 0.0); });
    CHECK(inside->inner_deviation == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("without gravity there is no profile")
{
    CHECK_FALSE(profile(weight_above, 0.0));
}

TEST_CASE("a slope has no profile, a column whose topmost layer is not whole has one")
{
    std::vector<Vector3> slope = lattice(20, 4, rows, dx);
    std::erase_if(slope, [](const Vector3& x) { return x.z() > rows * dx - 0.5 * x.x(); });
    CHECK_FALSE(profile(slope, weight_above));
    std::vector<Vector3> column = lattice(8, 8, rows, dx);
    std::erase_if(column, [](const Vector3& x) { return x.z() > (rows - 1) * dx && x.x() > 4 * dx; });
    CHECK(profile(column, weight_above));
}
