// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rigid plane and its reaction.
#include "contact/rigid_plane/rigid_plane.hpp"
#include "contact_checks.hpp"

#include <limits>

using namespace periporo;
using namespace periporo::test;

namespace {

const double spacing = 5e-3;
const ContactPair pair{0.0, 0.0, spacing* spacing* spacing, 0.0, 2e-4, 0.0};

RigidPlane rigid_plane(std::map<std::string, ParameterValue> values, std::vector<double> point = {0.0, 0.0, 0.0},
                       std::vector<double> normal = {0.0, 0.0, 1.0})
{
    values["point"] = std::move(point);
    values["normal"] = std::move(normal);
    values["friction"] = 0.5;
    // whatever partner the framework has in mind, this one is a surface
    return made<RigidPlane>(values, {spacing, 3.015 * spacing, ContactPartner::points});
}

} // namespace

TEST_CASE("distance is signed and measured along the normal, whatever length the normal was given")
{
    const RigidPlane plane = rigid_plane({{"modulus", 4e6}}, {1.0, 2.0, 3.0}, {0.0, 30.0, 40.0});
    Vector3 normal = Vector3::Zero();
    const Vector3 unit(0.0, 0.6, 0.8);
    const Vector3 along(0.3, 0.8, -0.6); // in the plane
    CHECK(plane.distance(Vector3(1.0, 2.0, 3.0) + 0.25 * unit + 5.0 * along, normal) ==
          doctest::Approx(0.25).epsilon(1e-14));
    CHECK((normal - unit).norm() <= 1e-15);
    CHECK(plane.distance(Vector3(1.0, 2.0, 3.0) - 0.25 * unit, normal) == doctest::Approx(-0.25).epsilon(1e-14));
}

TEST_CASE("it brings its surface along and has the friction it was given")
{
    const RigidPlane plane = rigid_plane({{"modulus", 4e6}});
    CHECK(plane.surface() == static_cast<const RigidSurface*>(&plane));
    CHECK(plane.friction() == 0.5);
}

TEST_CASE("points half a spacing above the plane just touch it by default")
{
    const RigidPlane plane = rigid_plane({{"modulus", 4e6}});
    CHECK(plane.cutoff() == 0.5 * spacing);
    CHECK(response_at(plane, 0.5 * spacing, pair).force == 0.0);
    CHECK(response_at(plane, 0.499 * spacing, pair).force > 0.0);
    CHECK(rigid_plane({{"modulus", 4e6}, {"cutoff", 1e-3}}).cutoff() == 1e-3);
    check_reach(plane, pair);
}

TEST_CASE("a modulus is the stiffness of a cell's face on one cell's length")
{
    // C dx^2/dx = 4e6 x 5e-3
    CHECK(response_at(rigid_plane({{"modulus", 4e6}}), 0.0, pair).stiffness == doctest::Approx(2e4).epsilon(1e-14));
    CHECK(response_at(rigid_plane({{"stiffness", 123.0}}), 0.0, pair).stiffness == 123.0);
}

TEST_CASE("the force grows linearly and goes on behind the plane")
{
    const RigidPlane plane = rigid_plane({{"stiffness", 1000.0}, {"cutoff", 1e-3}});
    CHECK(response_at(plane, 4e-4, pair).force == doctest::Approx(1000.0 * 6e-4).epsilon(1e-14));
    CHECK(response_at(plane, -3e-3, pair).force == doctest::Approx(1000.0 * 4e-3).epsilon(1e-14));
}

TEST_CASE("force and stiffness are the derivatives of the energy, which is the work done")
{
    const RigidPlane plane = rigid_plane({{"modulus", 4e6}});
    check_section(plane, pair, -plane.cutoff(), plane.cutoff());
    check_steepest_at_zero(plane, pair);
    check_block(rigid_plane({{"modulus", 4e6}, {"restitution", 0.5}}), pair);
}

TEST_CASE("a normal without direction is refused")
{
    const char* message = "normal must be a direction: three numbers that are not all zero";
    CHECK_THROWS_WITH_AS(rigid_plane({{"modulus", 1.0}}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}), message,
                         std::invalid_argument);
    // the records keep it from cases, not from programs
    Parameters parameters = kit::parameters_of(
        RigidPlane::parameters(),
        {{"modulus", 1.0}, {"point", std::vector(3, 0.0)}, {"normal", std::vector(3, 1.0)}, {"friction", 0.0}});
    parameters.set("normal", std::vector{0.0, std::numeric_limits<double>::quiet_NaN(), 1.0});
    CHECK_THROWS_WITH_AS(RigidPlane{parameters}, message, std::invalid_argument);
}

TEST_CASE("both or neither of stiffness and modulus are refused")
{
    const char* message = "give exactly one of stiffness (N/m) and modulus (Pa)";
    CHECK_THROWS_WITH_AS(rigid_plane({}), message, std::invalid_argument);
    CHECK_THROWS_WITH_AS(rigid_plane({{"stiffness", 1.0}, {"modulus", 1.0}}), message, std::invalid_argument);
}
