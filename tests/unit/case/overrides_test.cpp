// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Overrides of the command line.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

TEST_CASE("an override replaces a value, as TOML or as bare text")
{
    CHECK(read_text(minimal_case, {"discretization.spacing=0.01"}).discretization.spacing == 0.01);
    CHECK(read_text(minimal_case, {"discretization.spacing=10 mm"}).discretization.spacing == 0.01);
    CHECK(read_text(minimal_case, {"discretization.spacing = \"10 mm\""}).discretization.spacing == 0.01);
    CHECK(read_text(minimal_case, {"title=a b"}).title == "a b");
    CHECK(read_text(minimal_case, {"gravity=[0, 0, -1]"}).gravity == Vector3(0.0, 0.0, -1.0));
}

TEST_CASE("an override adds a key, and the table it needs")
{
    CHECK(read_text(minimal_case, {"time.safety=0.5"}).time.safety == 0.5);
    CHECK(read_text(minimal_case, {"body.heap.initial_stress.type=geostatic", "body.heap.initial_stress.K0=0.4"})
              .bodies[0]
              .initial_stress.lateral_coefficient == 0.4);
}

TEST_CASE("the later of two overrides wins")
{
    CHECK(read_text(minimal_case, {"time.safety=0.5", "time.safety=0.25"}).time.safety == 0.25);
}

TEST_CASE("entries of lists go by number from 0 or by name")
{
    CHECK(read_text(full_case, {"stage.1.duration=2"}).stages[1].duration == 2.0);
    CHECK(read_text(full_case, {"stage.collapse.duration=2"}).stages[1].duration == 2.0);
    CHECK(read_text(full_case, {"contact.0.friction=0.7"}).contacts[0].law.parameters.real("friction") == 0.7);
}

TEST_CASE("an override reaches the members of plain lists")
{
    CHECK(read_text(full_case, {"gravity.2=-1.5"}).gravity == Vector3(1.0, 0.0, -1.5));
}

TEST_CASE("an unknown key is an error of the override, without a place in the file")
{
    const CaseDiagnostic error = error_of(minimal_case, {"discretization.spacin=1"});
    CHECK(error.override_text == "discretization.spacin=1");
    CHECK(error.file.empty());
    CHECK(error.line == 0);
    CHECK(contains(error.hint, "did you mean 'spacing'?"));
}

TEST_CASE("a wrong value is an error of the override")
{
    const CaseDiagnostic error = error_of(minimal_case, {"discretization.spacing=1 kg"});
    CHECK(error.override_text == "discretization.spacing=1 kg");
    CHECK(contains(error.message, "units of kg"));
}

TEST_CASE("a misspelt body is no new body")
{
    const CaseDiagnostic error = error_of(minimal_case, {"body.haep.suction=0"});
    CHECK(contains(error.message, "there is no [body.haep]"));
    CHECK(contains(error.hint, "did you mean 'heap'?"));
}

TEST_CASE("an entry that a list does not have is an error that names or counts those it has")
{
    CHECK(contains(error_of(full_case, {"stage.colapse.duration=1"}).hint, "did you mean 'collapse'?"));
    CHECK(contains(error_of(full_case, {"stage.2.duration=1"}).hint, "2 entries"));
}

TEST_CASE("a path through a value is an error")
{
    CHECK(contains(error_of(minimal_case, {"discretization.spacing.x=1"}).message, "has no 'x'"));
}

TEST_CASE("an override that is malformed is an error")
{
    for (const std::string text :
         {"spacing", "=1", ".a=1", "a..b=1", "title=", "title=[1", "title=\"a", "include=[]"}) {
        CAPTURE(text);
        CHECK(error_of(minimal_case, {text}).override_text == text);
    }
}

TEST_CASE("an override that takes away what others need shows in the file")
{
    const CaseDiagnostic error = error_of(minimal_case, {"stage.0.type=quasi_static"});
    CHECK(error.override_text.empty());
    CHECK(place_of(error) == place_in(minimal_case, "duration"));
}
