// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The interface with a normal stiffness.
#include "contact/penalty/penalty.hpp"
#include "contact_checks.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

const double spacing = 2e-2;
const ContactScale scale{spacing, 3.015 * spacing, ContactPartner::points};
const ContactScale above_surface{spacing, 3.015 * spacing, ContactPartner::surface};
const double cell = spacing * spacing * spacing;
const ContactPair pair{0.0, 0.0, cell, cell, 1.6e-2, 1.6e-2};
const ContactPair rigid{0.0, 0.0, cell, 0.0, 1.6e-2, 0.0};

Penalty penalty(std::map<std::string, ParameterValue> values, const ContactScale& lengths)
{
    values["friction"] = 0.3;
    return made<Penalty>(values, lengths);
}

} // namespace

TEST_CASE("the normal stress on the face of a cell is the normal stiffness times the overlap")
{
    const Penalty contact = penalty({{"normal_stiffness", 1e9}, {"cutoff", 1e-2}}, above_surface);
    // 1e9 Pa/m x 1 mm = 1 MPa, on (2 cm)^2
    CHECK(response_at(contact, 9e-3, rigid).force == doctest::Approx(1e6 * 4e-4).epsilon(1e-13).scale(0.0));
    CHECK(response_at(contact, -1e-2, rigid).force == doctest::Approx(2e7 * 4e-4).epsilon(1e-13).scale(0.0));
}

TEST_CASE("a body that presses its layer of cells on a surface gives it the stress, however fine the cells are")
{
    for (const double fine : {1e-2, 5e-3, 1e-3}) {
        const Penalty contact =
            penalty({{"normal_stiffness", 1e9}, {"cutoff", 1e-2}}, {fine, 3.015 * fine, ContactPartner::surface});
        ContactPair point = rigid;
        point.volume_a = fine * fine * fine;
        const double per_area = response_at(contact, 9e-3, point).force / (fine * fine);
        CHECK(per_area == doctest::Approx(1e6).epsilon(1e-12).scale(0.0));
    }
}

TEST_CASE("between points the face is that of the smaller one, at a surface that of the point")
{
    ContactPair unequal = pair;
    unequal.volume_b = cell / 8.0; // half the edge, a quarter of the face
    const Penalty points = penalty({{"normal_stiffness", 1e9}}, scale);
    CHECK(response_at(points, 0.0, unequal).stiffness == doctest::Approx(1e9 * 1e-4).epsilon(1e-13).scale(0.0));
    std::swap(unequal.volume_a, unequal.volume_b);
    CHECK(response_at(points, 0.0, unequal).stiffness == doctest::Approx(1e9 * 1e-4).epsilon(1e-13).scale(0.0));
    const Penalty surface = penalty({{"normal_stiffness", 1e9}}, above_surface);
    std::swap(unequal.volume_a, unequal.volume_b);
    CHECK(response_at(surface, 0.0, unequal).stiffness == doctest::Approx(1e9 * 4e-4).epsilon(1e-13).scale(0.0));
}

TEST_CASE("a modulus is spread over one spacing")
{
    // 5 MPa/0.02 m x (0.02 m)^2
    for (const auto& lengths : {scale, above_surface})
        CHECK(response_at(penalty({{"modulus", 5e6}}, lengths), 0.0, pair).stiffness ==
              doctest::Approx(1e5).epsilon(1e-13).scale(0.0));
}

TEST_CASE("force and stiffness are the derivatives of the energy, which is the work done")
{
    for (const auto& lengths : {scale, above_surface}) {
        const Penalty contact = penalty({{"normal_stiffness", 1e9}}, lengths);
        check_section(contact, pair, -contact.cutoff(), contact.cutoff());
        check_reach(penalty({{"normal_stiffness", 1e9}, {"restitution", 0.3}}, lengths), pair);
        check_steepest_at_zero(contact, pair);
        check_block(penalty({{"modulus", 1e6}, {"restitution", 0.3}}, lengths), pair);
    }
    check_both_ends(penalty({{"modulus", 1e6}, {"restitution", 0.3}}, scale), pair);
}

TEST_CASE("points touch at 0.8 spacings, and half a spacing above a surface")
{
    CHECK(penalty({{"modulus", 4e6}}, scale).cutoff() == 0.8 * spacing);
    CHECK(penalty({{"modulus", 4e6}}, above_surface).cutoff() == 0.5 * spacing);
    CHECK(penalty({{"modulus", 4e6}, {"cutoff", 1.5e-3}}, scale).cutoff() == 1.5e-3);
    CHECK(penalty({{"modulus", 4e6}}, scale).friction() == 0.3);
}

TEST_CASE("both or neither of normal stiffness and modulus are refused")
{
    const char* message = "give exactly one of normal_stiffness (Pa/m) and modulus (Pa)";
    CHECK_THROWS_WITH_AS(penalty({}, scale), message, std::invalid_argument);
    CHECK_THROWS_WITH_AS(penalty({{"normal_stiffness", 1.0}, {"modulus", 1.0}}, scale), message, std::invalid_argument);
}
