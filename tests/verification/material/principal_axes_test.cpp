// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Principal values and directions: of any tensor, to round-off.
#include "law_driver.hpp"
#include "material/mohr_coulomb/principal_axes.hpp"
#include "periporo/kit/packed.hpp"

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include <limits>

using namespace periporo;
using namespace periporo::test;

namespace {

// Fifteen rotations, each of a few roundings, and the sum of the dyads
constexpr double round_off = 32.0 * std::numeric_limits<double>::epsilon();

double error(const SymmetricTensor<double>& a)
{
    const PrincipalAxes<double> axes(a);
    CHECK(axes.values[0] >= axes.values[1]);
    CHECK(axes.values[1] >= axes.values[2]);
    return norm(axes.tensor(axes.values) - a) / norm(a);
}

SymmetricTensor<double> with_values(const std::array<double, 3>& values, const Tensor<double>& rotation)
{
    return rotated(SymmetricTensor<double>{values[0], values[1], values[2], 0.0, 0.0, 0.0}, rotation);
}

} // namespace

TEST_CASE("principal values and directions give back the tensor")
{
    Random random;
    double worst = 0.0;
    for (int n = 0; n < 20000; ++n)
        worst = std::max(worst, error(random.tensor(1e4)));
    CHECK(worst <= round_off);
}

TEST_CASE("equal, nearly equal and very different principal values do so as well")
{
    Random random;
    double worst = 0.0;
    for (const std::array<double, 3>& values :
         {std::array{1.0, 1.0, 1.0}, std::array{1.0, 1.0, -2.0}, std::array{1.0, -2.0, 1.0},
          std::array{2.0, -1.0, -1.0}, std::array{1.0, 1.0 + 1e-15, -2.0}, std::array{1.0, 1.0 + 1e-9, 1.0 - 1e-9},
          std::array{1.0, 0.0, 0.0}, std::array{1.0, 1e-9, -1e-15}, std::array{1e150, 1.0, -1e-150}})
        for (int n = 0; n < 1000; ++n)
            worst = std::max(worst, error(with_values(values, random.rotation())));
    CHECK(worst <= round_off);
}

TEST_CASE("single components and sums of equal ones do so as well")
{
    double worst = 0.0;
    for (int which = 1; which < 64; ++which) {
        const auto component = [&](int bit) { return (which >> bit & 1) != 0 ? 1.0 : 0.0; };
        worst = std::max(worst,
                         error({component(0), component(1), component(2), component(3), component(4), component(5)}));
    }
    CHECK(worst <= round_off);
}

TEST_CASE("the principal values are those of an independent method")
{
    Random random;
    for (int n = 0; n < 2000; ++n) {
        const SymmetricTensor<double> a = random.tensor(1e4);
        const PrincipalAxes<double> axes(a);
        Eigen::Matrix3d matrix;
        matrix << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
        const Eigen::Vector3d expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvalues();
        for (int i = 0; i < 3; ++i)
            CHECK(std::abs(axes.values[static_cast<std::size_t>(i)] - expected[2 - i]) <= round_off * norm(a));
    }
}

TEST_CASE("the zero tensor has zero principal values")
{
    const PrincipalAxes<double> axes(SymmetricTensor<double>{});
    CHECK(axes.values == std::array<double, 3>{0.0, 0.0, 0.0});
}

TEST_CASE("a pack gives back the tensors of its lanes")
{
    Random random;
    for (int n = 0; n < 2000; ++n) {
        std::vector<LawInput<double, 0>> lanes(pack_width);
        for (auto& lane : lanes)
            lane.stress = random.number() > 0.0 ? random.tensor(1e4) : with_values({1.0, 1.0, 3.0}, random.rotation());
        const PrincipalAxes<Pack> axes(kit::packed<Pack>(lanes).stress);
        const auto found = axes.tensor(axes.values);
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            CHECK(norm(kit::lane_of_tensor(found, lane) - lanes[lane].stress) <= round_off * norm(lanes[lane].stress));
    }
}
