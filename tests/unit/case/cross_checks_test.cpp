// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors between tables.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

TEST_CASE("a body of a material that is not there is an error with the nearest one")
{
    const std::string text = with(minimal_case, "material = \"soil\"", "material = \"siol\"");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "\"siol\""));
    CHECK(contains(error.hint, "did you mean 'soil'?"));
}

TEST_CASE("a contact with a body that is not there is an error at that body")
{
    const std::string text = with(full_case, "[\"heap\", \"bubble\"]", "[\"heap\", \"buble\"]");
    const CaseDiagnostic error = error_of(text);
    CHECK(place_of(error) == place_in(text, "\"buble\""));
    CHECK(contains(error.hint, "did you mean 'bubble'?"));
    CHECK(contains(error.hint, "heap, bubble"));
}

TEST_CASE("a contact is between one or two bodies or obstacles")
{
    for (const std::string list : {"[]", "[\"heap\", \"heap\", \"bubble\"]"}) {
        CAPTURE(list);
        const std::string text = with(full_case, "between = [\"heap\", \"bubble\"]", "between = " + list);
        CHECK(contains(error_of(text).message, "one or two things"));
    }
    CHECK(errors_of(with(full_case, "[\"heap\", \"bubble\"]", "[\"heap\"]")).empty());
}

TEST_CASE("two stages of one name are an error at the second")
{
    const std::string text = minimal_case + "[[stage]]\nname = 'collapse'\ntype = \"dynamic\"\nduration = 1\n";
    CHECK(place_of(error_of(text)) == place_in(text, "'collapse'"));
}

TEST_CASE("without gravity there is no geostatic stress, but a body may settle under its suction")
{
    const std::string text = with(full_case, "[\"1 m/s2\", 0, \"-9.8 m/s2\"]", "[0, 0, 0]");
    const std::vector<CaseDiagnostic> errors = errors_of(text);
    REQUIRE(errors.size() == 1);
    CHECK(place_of(errors[0]) == place_in(text, "\"geostatic\""));
}

TEST_CASE("an output that is never written is an error")
{
    const std::string text = with(full_case, "every = \"10 ms\"\ntimes = [0, \"1 ms\"]\n", "");
    CHECK(place_of(error_of(text)) == place_in(text, "[[output]]"));
    CHECK(errors_of(with(full_case, "every = \"10 ms\"\n", "")).empty());
}
