// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a misspelt name was meant to be.
#include "sdk/nearest_name.hpp"

#include <doctest/doctest.h>

using namespace periporo;

TEST_CASE("a slip costs two: dropped, added, replaced or swapped letters")
{
    CHECK(edit_cost("friction", "friction") == 0);
    CHECK(edit_cost("frction", "friction") == 2);
    CHECK(edit_cost("fricttion", "friction") == 2);
    CHECK(edit_cost("fraction", "friction") == 2);
    CHECK(edit_cost("firction", "friction") == 2);
}

TEST_CASE("a letter in the wrong case costs less than a wrong letter")
{
    CHECK(edit_cost("k0", "K0") == 1);
    CHECK(edit_cost("k0", "L0") == 2);
}

TEST_CASE("the cost to an empty name is that of all its letters")
{
    CHECK(edit_cost("", "abc") == 6);
    CHECK(edit_cost("abc", "") == 6);
}

TEST_CASE("the nearest name wins, the earlier one of equals")
{
    CHECK(nearest_name("bulk_modulos", {"shear_modulus", "bulk_modulus"}) == "bulk_modulus");
    CHECK(nearest_name("bat", {"cat", "hat"}) == "cat");
}

TEST_CASE("a beginning or an end of a name is enough")
{
    CHECK(nearest_name("viscoplastic", {"linear_elastic", "viscoplastic_critical_state"}) ==
          "viscoplastic_critical_state");
}

TEST_CASE("nothing is suggested when nothing is near")
{
    CHECK_FALSE(nearest_name("colour", {"bulk_modulus", "porosity"}).has_value());
    CHECK_FALSE(nearest_name("x", {}).has_value());
}
