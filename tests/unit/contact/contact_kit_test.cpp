// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The contact laws of the program pass the contact kit.
#include "contact/adhesive/adhesive.hpp"
#include "contact/hertz/hertz.hpp"
#include "contact/penalty/penalty.hpp"
#include "contact/rigid_plane/rigid_plane.hpp"
#include "contact/short_range/short_range.hpp"
#include "periporo/contact_kit.hpp"

#include <doctest/doctest.h>

using namespace periporo;

namespace {

constexpr double least_restitution = 0.048; // of damping_ratio(), with zeta = 2

/// A law with these values at several coefficients of restitution.
template <class Law>
void check_sound(std::map<std::string, ParameterValue> given)
{
    given["friction"] = 0.3;
    for (const double restitution : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        CAPTURE(restitution);
        given["restitution"] = restitution;
        kit::ContactRange range;
        range.restitution = std::max(restitution, least_restitution);
        for (const std::string& fault :
             kit::check_contact_law<Law>(kit::parameters_of(Law::parameters(), given), range))
            FAIL_CHECK(fault);
    }
}

} // namespace

TEST_CASE("the contact laws of the program have no faults, at any restitution, between points and at a surface")
{
    check_sound<ShortRange>({{"stiffness", 1000.0}, {"cutoff", 0.008}});
    check_sound<ShortRange>({{"modulus", 1e6}, {"cutoff", 0.008}});
    check_sound<Penalty>({{"modulus", 1e6}, {"cutoff", 0.008}});
    check_sound<Penalty>({{"normal_stiffness", 1e8}, {"cutoff", 0.008}});
    check_sound<Hertz>({{"young_modulus", 3e6}, {"poisson_ratio", 0.25}, {"cutoff", 0.008}});
    check_sound<RigidPlane>({{"modulus", 1e6},
                             {"point", std::vector<double>{0.001, 0.002, 0.003}},
                             {"normal", std::vector<double>{1.0, 2.0, -2.0}}});
}

TEST_CASE("the adhesive law pulls no more than its strength on the face of a point")
{
    const Parameters parameters = kit::parameters_of(
        Adhesive::parameters(),
        {{"modulus", 1e6}, {"strength", 500.0}, {"friction", 0.3}, {"restitution", 0.5}, {"contact_distance", 0.008}});
    kit::ContactRange range;
    range.pull_limit = 500.0 * 4.0 * range.spacing * range.spacing; // the face of the largest points, of 8 cells
    for (const std::string& fault : kit::check_contact_law<Adhesive>(parameters, range))
        FAIL_CHECK(fault);
    range.pull_limit *= 0.2; // below the pull on the face of a cell
    CHECK_FALSE(kit::check_contact_law<Adhesive>(parameters, range).empty());
}
