// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The utility routines that user routines call, by their definitions.
#include "abaqus/material_of_library.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <cmath>
#include <vector>

using namespace periporo;
using namespace periporo::test;

namespace {

using Tensor6 = SymmetricTensor<double>;

const Tensor6 s{-10.0, 4.0, 7.0, 3.0, -5.0, 2.0};

Eigen::Matrix3d matrix(const Tensor6& a)
{
    return (Eigen::Matrix3d() << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz).finished();
}

} // namespace

TEST_CASE("the utility routines give invariants, principal values and directions, and rotate tensors")
{
    const double angle = 0.6;
    Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    const auto material =
        material_of_library("utilities", "umat",
                            {{"state_variables", std::int64_t{32}},
                             {"properties", std::vector<double>(rotation.data(), rotation.data() + 9)}});
    MaterialPoint point(*material, s);
    REQUIRE(point.step(Tensor6{}, 1e-4).converged);
    const auto state = [&](int n) { return point.state(static_cast<std::size_t>(n - 1)); };

    const Eigen::Matrix3d stress = matrix(s);
    Eigen::Matrix3d strain = 0.5 * stress; // the same numbers as strains, with engineering shear
    strain.diagonal() = stress.diagonal();
    CHECK(state(1) == doctest::Approx(stress.trace() / 3.0).epsilon(1e-14));
    CHECK(state(2) == doctest::Approx(deviator_stress(s)).epsilon(1e-14));
    for (int k = 0; k < 3; ++k) {
        // a principal value makes the determinant vanish; its terms are of the size 1000
        CHECK(std::abs((stress - state(3 + k) * Eigen::Matrix3d::Identity()).determinant()) <= 1e-11);
        CHECK(std::abs((strain - state(30 + k) * Eigen::Matrix3d::Identity()).determinant()) <= 1e-11);
        const Eigen::Vector3d direction(state(9 + k), state(12 + k), state(15 + k)); // AN(k, i) at 8 + k + 3 (i - 1)
        CHECK((stress * direction - state(6 + k) * direction).norm() <= 1e-13 * stress.norm());
        CHECK(direction.norm() == doctest::Approx(1.0).epsilon(1e-14));
    }
    const Eigen::Matrix3d turned = rotation * stress * rotation.transpose();
    const Eigen::Matrix3d turned_strain = rotation * strain * rotation.transpose();
    const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int c = 0; c < 6; ++c) {
        const auto [i, j] = pairs[c];
        CHECK(std::abs(state(18 + c) - turned(i, j)) <= 1e-13);
        CHECK(std::abs(state(24 + c) - (c < 3 ? 1.0 : 2.0) * turned_strain(i, j)) <= 1e-13);
    }
}

TEST_CASE("the principal values for VUMATs read shear in the order of VUMATs")
{
    const auto material = material_of_library("utilities", "vumat", {{"state_variables", std::int64_t{3}}});
    MaterialPoint point(*material, s);
    REQUIRE(point.step(Tensor6{}, 1e-4).converged);
    const Eigen::Matrix3d stress = matrix(s);
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(std::abs((stress - point.state(k) * Eigen::Matrix3d::Identity()).determinant()) <= 1e-11);
}
