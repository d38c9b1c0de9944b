// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Linear elasticity against Hooke's law.
#include "law_driver.hpp"
#include "material/linear_elastic/linear_elastic.hpp"
#include "pack_of_points.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

const double bulk = 25e6;
const double shear = 15e6;

LinearElastic law()
{
    return LinearElastic(
        parameter_values(LinearElastic::parameters(), {{"bulk_modulus", bulk}, {"shear_modulus", shear}}));
}

} // namespace

TEST_CASE("a volumetric strain changes the mean stress by K times it, and nothing else")
{
    MaterialPoint<LinearElastic> point(law(), Stress{});
    point.step(Strain::isotropic(-1e-3 / 3.0));
    CHECK(mean_stress(point.now.stress) == doctest::Approx(bulk * 1e-3).epsilon(1e-14));
    CHECK(shear_stress(point.now.stress) <= 1e-14 * bulk * 1e-3);
}

TEST_CASE("a shear strain changes the shear stress by 2 G times its tensor component")
{
    MaterialPoint<LinearElastic> point(law(), Stress{});
    point.step(Strain{0.0, 0.0, 0.0, 1e-3, 0.0, 0.0});
    CHECK(point.now.stress.xy == doctest::Approx(2.0 * shear * 1e-3).epsilon(1e-14));
    CHECK(trace(point.now.stress) == 0.0);
}

TEST_CASE("uniaxial stress gives Young's modulus and Poisson's ratio of K and G")
{
    MaterialPoint<LinearElastic> point(law(), Stress{});
    point.step_holding_stress({false, true, true, false, false, false}, Strain{1e-3, 0, 0, 0, 0, 0}, 1e-6);
    const double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
    const double poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    // the driver leaves 1e-6 Pa of the 38 kPa of axial stress
    CHECK(point.now.stress.xx == doctest::Approx(young * 1e-3).epsilon(1e-9));
    CHECK(point.strain.yy == doctest::Approx(-poisson * 1e-3).epsilon(1e-9));
}

TEST_CASE("the stress after a closed strain path is the stress before it")
{
    Random random;
    MaterialPoint<LinearElastic> point(law(), random.tensor(1e3));
    const Stress before = point.now.stress;
    Strain back;
    for (int n = 0; n < 100; ++n) {
        const Strain increment = random.tensor(1e-3);
        back -= increment;
        point.step(increment);
    }
    point.step(back);
    // 100 sums of stresses up to some 1e6 Pa, each rounded to 1e-16 of itself
    CHECK(norm(point.now.stress - before) <= 1e-7);
}

TEST_CASE("a pack gives what its lanes give one by one")
{
    Random random;
    Lanes<0> lanes{};
    for (auto& lane : lanes) {
        lane.stress = random.tensor(1e4);
        lane.strain_increment = random.tensor(1e-3);
    }
    const auto result = law().update(packed(lanes));
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const Stress expected = law().update(lanes[lane]).stress;
        const Stress found = lane_of(result.stress, lane);
        // the same four operations; only the compiler's choice of fused ones may differ
        CHECK(norm(found - expected) <= 4e-16 * norm(expected) + 4e-16 * 2.0 * shear * 1e-3);
    }
}
