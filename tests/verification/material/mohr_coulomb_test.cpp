// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mohr-Coulomb: strength and dilation in every kind of test, and the return to planes, edges and cut-off.
#include "frictional_laws.hpp"

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace periporo;
using namespace periporo::test;

namespace {

const double sin_friction = std::sin(35 * degree);
const double cos_friction = std::cos(35 * degree);
const double sin_dilatancy = std::sin(10 * degree);

Eigen::Matrix3d matrix(const SymmetricTensor<double>& a)
{
    return (Eigen::Matrix3d() << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz).finished();
}

// With principal stresses, the largest first: f of the planes (1, 3), (1, 2), (2, 3), and the flow of each.
constexpr int planes[3][2] = {{0, 2}, {0, 1}, {1, 2}};
double yield_function(const Eigen::Vector3d& s, int plane, double cohesion)
{
    const auto [i, j] = planes[plane];
    return s[i] - s[j] + (s[i] + s[j]) * sin_friction - 2.0 * cohesion * cos_friction;
}
Eigen::Vector3d flow(int plane)
{
    Eigen::Vector3d m = Eigen::Vector3d::Zero();
    m[planes[plane][0]] = 1.0 + sin_dilatancy;
    m[planes[plane][1]] = -(1.0 - sin_dilatancy);
    return m;
}

// The least distance of a strain to non-negative combinations of one or two of some directions. No active set of this
// law needs more: a third plane at the tip adds nothing to what two and the opening span.
double distance_to_cone(const Eigen::Vector3d& strain, const std::vector<Eigen::Vector3d>& directions)
{
    double least = strain.norm();
    for (const Eigen::Vector3d& a : directions) {
        least = std::min(least, (strain - a * std::max(0.0, a.dot(strain) / a.dot(a))).norm());
        for (const Eigen::Vector3d& b : directions) {
            // least squares by Cramer's rule; the directions are at large angles to each other
            const double determinant = a.dot(a) * b.dot(b) - a.dot(b) * a.dot(b);
            const double of_a = (b.dot(b) * a.dot(strain) - a.dot(b) * b.dot(strain)) / determinant;
            const double of_b = (a.dot(a) * b.dot(strain) - a.dot(b) * a.dot(strain)) / determinant;
            if (of_a >= 0.0 && of_b >= 0.0)
                least = std::min(least, (strain - a * of_a - b * of_b).norm());
        }
    }
    return least;
}

} // namespace

TEST_CASE("triaxial extension ends at the strength and dilation of the same plane as compression")
{
    const double cohesion = 100.0;
    const LawMaterial<MohrCoulomb> material(sand<MohrCoulomb>({{"cohesion", cohesion}}));
    MaterialPoint point = sheared(material, 1e-4, radial);
    const double ratio = (1.0 + sin_friction) / (1.0 - sin_friction);
    CHECK(-point.stress().zz == doctest::Approx((1000.0 - 2.0 * cohesion * std::sqrt(ratio)) / ratio).epsilon(1e-9));
    const Strain before = point.strain();
    step_holding_xx(point, 1e-4, radial);
    CHECK((point.strain().xx + point.strain().yy - before.xx - before.yy) / 1e-4 ==
          doctest::Approx(-(1.0 - sin_dilatancy) / (1.0 + sin_dilatancy)).epsilon(1e-9));
}

TEST_CASE("plane strain ends at N with the axial strain of steady flow (1 - sin psi)/(1 + sin psi) of the lateral one")
{
    const LawMaterial<MohrCoulomb> material(sand<MohrCoulomb>());
    MaterialPoint point = sheared(material, -1e-4, in_plane);
    const double ratio = (1.0 + sin_friction) / (1.0 - sin_friction);
    CHECK(-point.stress().zz == doctest::Approx(1000.0 * ratio).epsilon(1e-9));
    CHECK(point.stress().yy > point.stress().zz); // between the two others: one plane flows
    CHECK(point.stress().yy < point.stress().xx);
    const Strain before = point.strain();
    step_holding_xx(point, -1e-4, in_plane);
    CHECK(1e-4 / (point.strain().xx - before.xx) ==
          doctest::Approx((1.0 - sin_dilatancy) / (1.0 + sin_dilatancy)).epsilon(1e-9));
}

TEST_CASE("Drucker-Prager matched in compression takes the same path through triaxial compression")
{
    const LawMaterial<MohrCoulomb> pyramid(sand<MohrCoulomb>({{"cohesion", 200.0}}));
    const LawMaterial<DruckerPrager> cone(sand<DruckerPrager>({{"cohesion", 200.0}}));
    MaterialPoint one(pyramid, Stress::isotropic(-1000.0)), other(cone, Stress::isotropic(-1000.0));
    for (int n = 0; n < 200; ++n) {
        step_holding_xx(one, -1e-5, radial);
        step_holding_xx(other, -1e-5, radial);
        // each driver leaves 1e-12 of 1 kPa a step
        CHECK(norm(one.stress() - other.stress()) <= 200 * 1e-8);
        CHECK(norm(one.strain() - other.strain()) <= 200 * 1e-8 / shear_modulus);
        for (std::size_t s = 0; s < 3; ++s)
            CHECK(std::abs(one.state(s) - other.state(s)) <= 200 * 1e-8 / shear_modulus);
    }
    CHECK(one.state(FrictionalSoil::shear_strain) > 1e-3);
}

TEST_CASE("of any trial the end is on its planes, edges or cut-off, in the cone of the flow directions that meet there")
{
    // with a cut-off above the tip, and at it
    for (const auto& [cohesion, cut_off] : {std::pair{300.0, 150.0}, std::pair{0.0, 0.0}}) {
        CAPTURE(cohesion);
        const MohrCoulomb law(sand<MohrCoulomb>({{"cohesion", cohesion}, {"tensile_strength", cut_off}}));
        Random random;
        std::map<std::string, int> reached;
        double worst = 0.0;
        for (int n = 0; n < 10000; ++n) {
            auto input = random_input<MohrCoulomb>(random);
            if (n % 4 == 0) { // and with two equal principal values, not along the axes
                const double pair = input.stress.xx, single = input.stress.yy;
                input.stress = rotated(Stress{pair, pair, single, 0.0, 0.0, 0.0}, random.rotation());
                input.strain_increment = deviator(input.stress) * (random.number() / shear_modulus) +
                                         Strain::isotropic(random.number(-1e-4, 1e-4));
            }
            const auto after = law.update(input);
            REQUIRE_FALSE(after.failed);
            const double stress_round_off = 1e-14 * size_of(input);

            // in the principal axes of the trial, found by another method
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix(deviator(trial_stress(input))));
            const Eigen::Matrix3d rotation = axes.eigenvectors().rowwise().reverse();
            const Eigen::Matrix3d turned = rotation.transpose() * matrix(after.stress) * rotation;
            const Eigen::Vector3d stress = turned.diagonal();
            CHECK((turned - Eigen::Matrix3d(stress.asDiagonal())).norm() <= stress_round_off);
            CHECK(stress[0] >= stress[1] - stress_round_off);
            CHECK(stress[1] >= stress[2] - stress_round_off);

            const double opening = after.state[FrictionalSoil::opening];
            const double p = -stress.mean();
            CHECK(p >= -cut_off - stress_round_off);
            CHECK(opening >= 0.0);
            CHECK((opening == 0.0 || std::abs(p + cut_off) <= stress_round_off));

            // the plastic strain from the closed mass is the new opening and the flow of the planes that are reached
            const Strain plastic = elastic_strain(trial_stress(input) - after.stress) +
                                   Strain::isotropic((input.state[FrictionalSoil::opening] - opening) / 3.0);
            const Eigen::Vector3d strain = (rotation.transpose() * matrix(plastic) * rotation).diagonal();
            std::vector<Eigen::Vector3d> directions;
            for (int plane = 0; plane < 3; ++plane) {
                const double f = yield_function(stress, plane, cohesion);
                CHECK(f <= stress_round_off);
                if (f >= -stress_round_off)
                    directions.push_back(flow(plane));
            }
            const double distance = distance_to_cone(strain, directions) * shear_modulus / size_of(input);
            worst = std::max(worst, distance);
            const bool flows = after.state[FrictionalSoil::shear_strain] > input.state[FrictionalSoil::shear_strain];
            const char* place = !flows                                      ? "no flow"
                                : stress[0] - stress[2] <= stress_round_off ? "tip"
                                : stress[0] - stress[1] <= stress_round_off ? "extension edge"
                                : stress[1] - stress[2] <= stress_round_off ? "compression edge"
                                                                            : "plane";
            ++reached[std::string(place) + (opening > 0.0 ? ", cut-off" : "")];
        }
        // a few roundings of a trial stress, through an angle to the surface that amplifies little
        CHECK(worst <= 1e-14);
        std::string counts;
        for (const auto& [place, count] : reached)
            counts += place + " " + std::to_string(count) + "; ";
        MESSAGE(counts);
        for (const std::string place : {"no flow", "plane", "extension edge", "compression edge"}) {
            CAPTURE(place);
            CHECK(reached[place] > 100);
            CHECK((cut_off == 0.0 || reached[place + ", cut-off"] > 100));
        }
        CHECK((cut_off > 0.0 || reached["tip, cut-off"] > 100));
    }
}
