// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Linear elasticity against Hooke's law.
#include "law_driver.hpp"
#include "material/linear_elastic/linear_elastic.hpp"
#include "periporo/kit/packed.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

const double bulk = 25e6;
const double shear = 15e6;

const LawMaterial<LinearElastic> material(parameter_values(LinearElastic::parameters(),
                                                           {{"bulk_modulus", bulk}, {"shear_modulus", shear}}));

} // namespace

TEST_CASE("a volumetric strain changes the mean stress by K times it, and nothing else")
{
    MaterialPoint point(material);
    step(point, Strain::isotropic(-1e-3 / 3.0));
    CHECK(mean_pressure(point.stress()) == doctest::Approx(bulk * 1e-3).epsilon(1e-14));
    CHECK(deviator_stress(point.stress()) <= 1e-14 * bulk * 1e-3);
}

TEST_CASE("a shear strain changes the shear stress by 2 G times its tensor component")
{
    MaterialPoint point(material);
    step(point, Strain{0.0, 0.0, 0.0, 1e-3, 0.0, 0.0});
    CHECK(point.stress().xy == doctest::Approx(2.0 * shear * 1e-3).epsilon(1e-14));
    CHECK(trace(point.stress()) == 0.0);
}

TEST_CASE("uniaxial stress gives Young's modulus and Poisson's ratio of K and G")
{
    MaterialPoint point(material);
    step_triaxial(point, 1e-3);
    const double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
    const double poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    // the driver leaves 1e-7 Pa of the 38 kPa of axial stress
    CHECK(point.stress().xx == doctest::Approx(young * 1e-3).epsilon(1e-9));
    CHECK(point.strain().yy == doctest::Approx(-poisson * 1e-3).epsilon(1e-9).scale(0.0));
}

TEST_CASE("the stress after a closed strain path is the stress before it")
{
    Random random;
    MaterialPoint point(material, random.tensor(1e3));
    const Stress before = point.stress();
    Strain back;
    for (int n = 0; n < 100; ++n) {
        const Strain increment = random.tensor(1e-3);
        back -= increment;
        step(point, increment);
    }
    step(point, back);
    // 100 sums of stresses up to some 1e6 Pa, each rounded to 1e-16 of itself
    CHECK(norm(point.stress() - before) <= 1e-7);
}

TEST_CASE("a pack gives what its lanes give one by one")
{
    Random random;
    std::vector<LawInput<double, 0>> lanes(pack_width);
    for (auto& lane : lanes) {
        lane.stress = random.tensor(1e4);
        lane.strain_increment = random.tensor(1e-3);
    }
    const auto result = material.law().update(kit::packed<Pack>(lanes));
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const Stress expected = material.law().update(lanes[lane]).stress;
        const Stress found = kit::lane_of_tensor(result.stress, lane);
        // the same four operations; only the compiler's choice of fused ones may differ
        CHECK(norm(found - expected) <= 4e-16 * norm(expected) + 4e-16 * 2.0 * shear * 1e-3);
    }
}
