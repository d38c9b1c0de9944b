// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The resolved case reproduces the case by itself.
#include "case/resolved.hpp"
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

void check_same(const PluginChoice& a, const PluginChoice& b)
{
    CHECK(a.name == b.name);
    CHECK(a.parameters.values() == b.parameters.values());
}

/// Every member of two descriptions, bit by bit, but for the file.
void check_same(const CaseDescription& a, const CaseDescription& b)
{
    CHECK(a.title == b.title);
    CHECK(a.gravity == b.gravity);
    CHECK(a.discretization.spacing == b.discretization.spacing);
    CHECK(a.discretization.horizon_ratio == b.discretization.horizon_ratio);
    CHECK(a.discretization.refresh == b.discretization.refresh);
    CHECK(a.discretization.skin_ratio == b.discretization.skin_ratio);
    CHECK(a.operators.force_state == b.operators.force_state);
    CHECK(a.operators.influence == b.operators.influence);
    CHECK(a.time.safety == b.time.safety);
    CHECK(a.time.step == b.time.step);
    REQUIRE(a.materials.size() == b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
        CHECK(a.materials[i].name == b.materials[i].name);
        check_same(a.materials[i].model, b.materials[i].model);
        CHECK(a.materials[i].grain_density == b.materials[i].grain_density);
        CHECK(a.materials[i].porosity == b.materials[i].porosity);
    }
    REQUIRE(a.bodies.size() == b.bodies.size());
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        CHECK(a.bodies[i].name == b.bodies[i].name);
        check_same(a.bodies[i].geometry, b.bodies[i].geometry);
        CHECK(a.bodies[i].material == b.bodies[i].material);
        CHECK(a.bodies[i].water.kind == b.bodies[i].water.kind);
        CHECK(a.bodies[i].water.suction == b.bodies[i].water.suction);
        CHECK(a.bodies[i].water.saturation == b.bodies[i].water.saturation);
        CHECK(a.bodies[i].velocity == b.bodies[i].velocity);
        CHECK(a.bodies[i].angular_velocity == b.bodies[i].angular_velocity);
        CHECK(a.bodies[i].strain_rate == b.bodies[i].strain_rate);
        CHECK(a.bodies[i].initial_stress.kind == b.bodies[i].initial_stress.kind);
        CHECK(a.bodies[i].initial_stress.lateral_coefficient == b.bodies[i].initial_stress.lateral_coefficient);
        CHECK(a.bodies[i].initial_stress.overconsolidation_ratio == b.bodies[i].initial_stress.overconsolidation_ratio);
    }
    REQUIRE(a.boundaries.size() == b.boundaries.size());
    for (std::size_t i = 0; i < a.boundaries.size(); ++i) {
        CHECK(a.boundaries[i].kind == b.boundaries[i].kind);
        CHECK(a.boundaries[i].plane.axis == b.boundaries[i].plane.axis);
        CHECK(a.boundaries[i].plane.offset == b.boundaries[i].plane.offset);
        CHECK(a.boundaries[i].period == b.boundaries[i].period);
    }
    REQUIRE(a.contacts.size() == b.contacts.size());
    for (std::size_t i = 0; i < a.contacts.size(); ++i) {
        check_same(a.contacts[i].law, b.contacts[i].law);
        CHECK(a.contacts[i].between == b.contacts[i].between);
    }
    REQUIRE(a.stages.size() == b.stages.size());
    for (std::size_t i = 0; i < a.stages.size(); ++i) {
        CHECK(a.stages[i].name == b.stages[i].name);
        CHECK(a.stages[i].kind == b.stages[i].kind);
        REQUIRE(a.stages[i].rollers.size() == b.stages[i].rollers.size());
        for (std::size_t j = 0; j < a.stages[i].rollers.size(); ++j) {
            CHECK(a.stages[i].rollers[j].axis == b.stages[i].rollers[j].axis);
            CHECK(a.stages[i].rollers[j].offset == b.stages[i].rollers[j].offset);
        }
        CHECK(a.stages[i].residual == b.stages[i].residual);
        CHECK(a.stages[i].damping == b.stages[i].damping);
        CHECK(a.stages[i].maximum_steps == b.stages[i].maximum_steps);
        CHECK(a.stages[i].response == b.stages[i].response);
        CHECK(a.stages[i].duration == b.stages[i].duration);
        CHECK(a.stages[i].rest_speed == b.stages[i].rest_speed);
    }
    REQUIRE(a.outputs.size() == b.outputs.size());
    for (std::size_t i = 0; i < a.outputs.size(); ++i) {
        check_same(a.outputs[i].writer, b.outputs[i].writer);
        CHECK(a.outputs[i].every == b.outputs[i].every);
        CHECK(a.outputs[i].times == b.outputs[i].times);
    }
    REQUIRE(a.comparison.has_value() == b.comparison.has_value());
    if (a.comparison) {
        CHECK(a.comparison->law == b.comparison->law);
        CHECK(a.comparison->radius == b.comparison->radius);
        CHECK(a.comparison->height == b.comparison->height);
    }
    CHECK(a.checkpoint_every == b.checkpoint_every);
    CHECK(a.history_every == b.history_every);
    CHECK(a.energy_error_limit == b.energy_error_limit);
    CHECK(a.plugin_paths == b.plugin_paths);
}

} // namespace

TEST_CASE("the resolved case reads back to the same description")
{
    for (const std::string& text : {minimal_case, full_case}) {
        const CaseDescription original = read_text(text);
        check_same(original, read_text(original.resolved));
    }
}

TEST_CASE("the resolved text of a resolved case is itself")
{
    const std::string once = read_text(full_case).resolved;
    CHECK(read_text(once).resolved == once);
}

TEST_CASE("overrides are part of the resolved case")
{
    const CaseDescription original = read_text(full_case, {"discretization.spacing=7 mm", "stage.1.duration=3"});
    const CaseDescription again = read_text(original.resolved);
    CHECK(again.discretization.spacing == 0.007);
    CHECK(again.stages[1].duration == 3.0);
}

TEST_CASE("includes are part of the resolved case and it includes nothing")
{
    const TemporaryFolder folder;
    write_file(folder / "base.toml", full_case);
    write_file(folder / "case.toml", "include = [\"base.toml\"]\ntitle = \"mine\"\n");
    PluginRegistry registry = test_registry();
    const CaseDescription original = read_case(folder / "case.toml", {}, registry);
    CHECK_FALSE(contains(original.resolved, "\ninclude"));
    check_same(original, read_text(original.resolved));
}

TEST_CASE("plugin folders are absolute in the resolved case")
{
    const CaseDescription original = read_text(full_case);
    REQUIRE(original.plugin_paths.size() == 1);
    CHECK(original.plugin_paths[0].is_absolute());
    CHECK(contains(original.resolved, original.plugin_paths[0].string()));
}

TEST_CASE("a former name is resolved to the present one")
{
    CHECK(contains(read_text(with(minimal_case, "stiffness", "modulus")).resolved, "stiffness = 25000000.0  # Pa"));
}

TEST_CASE("numbers are written so that no bit is lost and that they stay floats")
{
    CHECK(toml_text(0.1) == "0.1");
    CHECK(toml_text(3.0) == "3.0");
    CHECK(toml_text(1.0 / 3.0) == "0.3333333333333333");
    CHECK(toml_text(std::int64_t{3}) == "3");
    CHECK(toml_text(std::string("a\"b\\c\nd")) == "\"a\\\"b\\\\c\\u000Ad\"");
}
