// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The short-range repulsion between points, and of points and a surface.
#include "contact/short_range/short_range.hpp"
#include "contact_checks.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

// The paper's discretization.
const ContactScale scale{2.5e-3, 7.5e-3, ContactPartner::points};
const ContactScale above_surface{2.5e-3, 7.5e-3, ContactPartner::surface};
const double cell = 2.5e-3 * 2.5e-3 * 2.5e-3;
const ContactPair pair{0.0, 0.0, cell, cell, 3e-5, 3e-5};
const ContactPair rigid{0.0, 0.0, cell, 0.0, 3e-5, 0.0};

ShortRange short_range(std::map<std::string, ParameterValue> values, const ContactScale& lengths = scale)
{
    values["friction"] = 0.2;
    return made<ShortRange>(values, lengths);
}

} // namespace

TEST_CASE("the force grows linearly below the cut-off and goes on past zero distance")
{
    const ShortRange contact = short_range({{"stiffness", 1000.0}, {"cutoff", 1e-3}});
    CHECK(response_at(contact, 4e-4, pair).force == doctest::Approx(1000.0 * 6e-4).epsilon(1e-14));
    CHECK(response_at(contact, -1e-3, pair).force == doctest::Approx(1000.0 * 2e-3).epsilon(1e-14));
}

TEST_CASE("force and stiffness are the derivatives of the energy, which is the work done")
{
    for (const auto& lengths : {scale, above_surface})
        for (const ShortRange& contact :
             {short_range({{"stiffness", 1000.0}}, lengths), short_range({{"modulus", 4e6}}, lengths)}) {
            check_section(contact, pair, -0.5 * contact.cutoff(), contact.cutoff());
            check_reach(contact, pair);
            check_steepest_at_zero(contact, pair);
        }
}

TEST_CASE("blocks give what singles give, and both ends of a pair the same")
{
    const ShortRange contact = short_range({{"modulus", 4e6}, {"restitution", 0.5}});
    check_block(contact, pair);
    check_both_ends(contact, pair);
    check_block(short_range({{"modulus", 4e6}, {"restitution", 0.5}}, above_surface), rigid);
}

TEST_CASE("the paper's 4 MPa on its discretization is a spring of 236 N/m")
{
    const ShortRange contact = short_range({{"modulus", 4e6}});
    // 18 x 4e6 x (2.5e-3)^6/(pi (7.5e-3)^5) = 18 x 4e6 x 2.5e-3/(3^5 pi)
    const double expected = 18.0 * 4e6 * 2.5e-3 / (243.0 * std::numbers::pi);
    CHECK(response_at(contact, 0.0, pair).stiffness == doctest::Approx(expected).epsilon(1e-13));
    CHECK(expected == doctest::Approx(236.0).epsilon(0.002));
}

TEST_CASE("between points a modulus makes the stiffness proportional to both volumes")
{
    const ShortRange contact = short_range({{"modulus", 4e6}});
    ContactPair larger = pair;
    larger.volume_a *= 3.0;
    larger.volume_b *= 0.5;
    CHECK(response_at(contact, 0.0, larger).force ==
          doctest::Approx(1.5 * response_at(contact, 0.0, pair).force).epsilon(1e-14).scale(0.0));
}

TEST_CASE("at a surface a modulus is the stiffness of a cell's face on one cell's length, rigid or not")
{
    const ShortRange contact = short_range({{"modulus", 4e6}}, above_surface);
    // C dx^2/dx = 4e6 x 2.5e-3
    CHECK(response_at(contact, 0.0, rigid).stiffness == doctest::Approx(1e4).epsilon(1e-14));
    CHECK(response_at(contact, 0.0, pair).stiffness == doctest::Approx(1e4).epsilon(1e-14));
    CHECK(response_at(short_range({{"stiffness", 123.0}}, above_surface), 0.0, rigid).stiffness == 123.0);
}

TEST_CASE("points touch at 0.8 spacings, 2 mm on the paper's discretization, and half a spacing above a surface")
{
    CHECK(short_range({{"modulus", 4e6}}).cutoff() == doctest::Approx(2e-3).epsilon(1e-14).scale(0.0));
    CHECK(short_range({{"modulus", 4e6}}, above_surface).cutoff() == 1.25e-3);
    for (const auto& lengths : {scale, above_surface})
        CHECK(short_range({{"modulus", 4e6}, {"cutoff", 1.5e-3}}, lengths).cutoff() == 1.5e-3);
}

TEST_CASE("it brings no surface of its own, and has the friction it was given")
{
    const ShortRange contact = short_range({{"modulus", 4e6}});
    CHECK(contact.surface() == nullptr);
    CHECK(contact.friction() == 0.2);
}

TEST_CASE("both or neither of stiffness and modulus are refused")
{
    const char* message = "give exactly one of stiffness (N/m) and modulus (Pa)";
    CHECK_THROWS_WITH_AS(short_range({}), message, std::invalid_argument);
    CHECK_THROWS_WITH_AS(short_range({{"stiffness", 1.0}, {"modulus", 1.0}}), message, std::invalid_argument);
}
