// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The short-range repulsion between points.
#include "contact/short_range/short_range.hpp"
#include "contact_checks.hpp"

#include <map>

using namespace periporo;
using namespace periporo::test;

namespace {

// The paper's discretization.
const ContactScale scale{2.5e-3, 7.5e-3};
const double cell = 2.5e-3 * 2.5e-3 * 2.5e-3;
const ContactPair pair{0.0, 0.0, cell, cell, 3e-5, 3e-5};

ShortRange short_range(std::map<std::string, double> values)
{
    Parameters parameters;
    parameters.set("friction", 0.2);
    parameters.set("restitution", 1.0);
    for (const auto& [name, value] : values)
        parameters.set(name, value);
    ShortRange contact(parameters);
    contact.scale(scale);
    return contact;
}

} // namespace

TEST_CASE("the force grows linearly below the cut-off and goes on past zero distance")
{
    const ShortRange contact = short_range({{"stiffness", 1000.0}, {"cutoff", 1e-3}});
    CHECK(response_at(contact, 4e-4, pair).force == doctest::Approx(1000.0 * 6e-4).epsilon(1e-14));
    CHECK(response_at(contact, -1e-3, pair).force == doctest::Approx(1000.0 * 2e-3).epsilon(1e-14));
    check_reach(contact, pair);
}

TEST_CASE("force and stiffness are the derivatives of the energy, which is the work done")
{
    for (const ShortRange& contact : {short_range({{"stiffness", 1000.0}}), short_range({{"modulus", 4e6}})}) {
        check_derivatives(contact, -0.5 * contact.cutoff(), pair);
        check_work(contact, -0.5 * contact.cutoff(), pair);
        check_block(contact, pair);
    }
}

TEST_CASE("the paper's 4 MPa on its discretization is a spring of 236 N/m")
{
    const ShortRange contact = short_range({{"modulus", 4e6}});
    // 18 x 4e6 x (2.5e-3)^6/(pi (7.5e-3)^5) = 18 x 4e6 x 2.5e-3/(3^5 pi)
    const double expected = 18.0 * 4e6 * 2.5e-3 / (243.0 * std::numbers::pi);
    CHECK(response_at(contact, 0.0, pair).stiffness == doctest::Approx(expected).epsilon(1e-13));
    CHECK(expected == doctest::Approx(236.0).epsilon(0.002));
}

TEST_CASE("with a modulus the stiffness is proportional to both volumes")
{
    const ShortRange contact = short_range({{"modulus", 4e6}});
    ContactPair larger = pair;
    larger.volume_a *= 3.0;
    larger.volume_b *= 0.5;
    CHECK(response_at(contact, 0.0, larger).force ==
          doctest::Approx(1.5 * response_at(contact, 0.0, pair).force).epsilon(1e-14).scale(0.0));
}

TEST_CASE("the default reach is 0.8 spacings, 2 mm on the paper's discretization")
{
    CHECK(short_range({{"modulus", 4e6}}).cutoff() == doctest::Approx(2e-3).epsilon(1e-14).scale(0.0));
    CHECK(short_range({{"modulus", 4e6}, {"cutoff", 1.5e-3}}).cutoff() == 1.5e-3);
}

TEST_CASE("it is a law between points, with the friction it was given")
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
