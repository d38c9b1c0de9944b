// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a sound case becomes.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

TEST_CASE("a minimal case gets the documented defaults")
{
    const CaseDescription read = read_text(minimal_case);
    const CaseDescription defaults;
    CHECK(read.gravity == defaults.gravity);
    CHECK(read.discretization.horizon_ratio == defaults.discretization.horizon_ratio);
    CHECK(read.discretization.refresh == defaults.discretization.refresh);
    CHECK(read.discretization.skin_ratio == defaults.discretization.skin_ratio);
    CHECK(read.operators.force_state == defaults.operators.force_state);
    CHECK(read.operators.influence == defaults.operators.influence);
    CHECK(read.time.safety == defaults.time.safety);
    CHECK_FALSE(read.time.step.has_value());
    CHECK(read.checkpoint_every == defaults.checkpoint_every);
    CHECK(read.history_every == defaults.history_every);
    CHECK(read.energy_error_limit == defaults.energy_error_limit);
    CHECK_FALSE(read.comparison.has_value());
    CHECK(read.boundaries.empty());
    CHECK(read.contacts.empty());
    CHECK(read.outputs.empty());
    CHECK(read.warnings.empty());
    const BodyDescription body;
    CHECK(read.bodies.at(0).initial_stress.kind == body.initial_stress.kind);
    CHECK(read.bodies.at(0).water.kind == body.water.kind);
    CHECK(read.bodies.at(0).velocity == body.velocity);
}

TEST_CASE("a quasi-static stage gets the documented defaults")
{
    const CaseDescription read =
        read_text(with(minimal_case, "type = \"dynamic\"\nduration = \"0.5 s\"", "type = \"quasi_static\""));
    const StageDescription defaults;
    const StageDescription& stage = read.stages.at(0);
    CHECK(stage.rollers.empty());
    CHECK(stage.residual == defaults.residual);
    CHECK(stage.damping == defaults.damping);
    CHECK(stage.maximum_steps == defaults.maximum_steps);
    CHECK(stage.response == defaults.response);
}

TEST_CASE("sections of the framework arrive in SI")
{
    const CaseDescription read = read_text(full_case);
    CHECK(read.title == "full");
    CHECK(read.gravity == Vector3(1.0, 0.0, -9.8));
    CHECK(read.discretization.spacing == 0.005);
    CHECK(read.discretization.horizon_ratio == 2.1);
    CHECK(read.discretization.refresh == RefreshRule::every_step);
    CHECK(read.discretization.skin_ratio == 0.25);
    CHECK(read.operators.force_state == "bond_projection");
    CHECK(read.operators.influence == "linear");
    CHECK(read.time.safety == 0.5);
    CHECK(read.time.step == 2e-6);
    CHECK(read.checkpoint_every == 300.0);
    CHECK(read.history_every == 0.002);
    CHECK(read.energy_error_limit == 0.02);
    REQUIRE(read.comparison.has_value());
    CHECK(read.comparison->law == "axisymmetric_column");
    CHECK(read.comparison->radius == 0.1);
    CHECK(read.comparison->height == 0.12);
}

TEST_CASE("materials and bodies keep the order of the file")
{
    const CaseDescription read = read_text(full_case);
    REQUIRE(read.materials.size() == 2);
    CHECK(read.materials[0].name == "soil");
    CHECK(read.materials[1].name == "air");
    REQUIRE(read.bodies.size() == 2);
    CHECK(read.bodies[0].name == "heap");
    CHECK(read.bodies[1].name == "bubble");
}

TEST_CASE("a plugin gets exactly the parameters that it declares, in SI and with defaults")
{
    const CaseDescription read = read_text(full_case);
    const Parameters& given = read.materials[0].model.parameters;
    CHECK(read.materials[0].model.name == "test_clay");
    CHECK(given.real("stiffness") == 25e6);
    CHECK(given.integer("exponent") == 3);
    CHECK_FALSE(given.boolean("associated"));
    CHECK(given.text("surface") == "cone");
    CHECK(given.real_list("path") == std::vector<double>{0.5, 0.5});
    CHECK(given.text_list("notes").at(0) == "a \"quoted\" note");
    CHECK_FALSE(given.has("porosity"));
    const Parameters& defaulted = read.materials[1].model.parameters;
    CHECK(defaulted.integer("exponent") == 2);
    CHECK(defaulted.boolean("associated"));
    CHECK(defaulted.text("surface") == "ellipse");
    CHECK_FALSE(defaulted.has("path"));
}

TEST_CASE("the grain density and porosity of a material are the framework's")
{
    const CaseDescription read = read_text(full_case);
    CHECK(read.materials[0].grain_density == doctest::Approx(2200.0).epsilon(1e-15));
    CHECK(read.materials[0].porosity == 0.2);
}

TEST_CASE("a body knows geometry, material, water, velocity and initial stress")
{
    const BodyDescription body = read_text(full_case).bodies[0];
    CHECK(body.geometry.name == "test_shell");
    CHECK(body.geometry.parameters.real("inner") == 0.01);
    CHECK(body.geometry.parameters.real_list("centre") == std::vector<double>{0.0, 0.0, 1.0});
    CHECK(body.material == "soil");
    CHECK(body.water.kind == WaterKind::uniform);
    CHECK(body.water.suction == 20e3);
    CHECK(body.water.saturation == 0.3);
    CHECK(body.velocity == Vector3(0.0, 0.001, 0.0));
    CHECK(body.angular_velocity == Vector3(0.0, 0.0, 2.0));
    CHECK(body.strain_rate.row(0) == Eigen::RowVector3d(1.0, 4.0, 5000.0));
    CHECK(body.strain_rate.row(1) == Eigen::RowVector3d(4.0, 2.0, 0.0));
    CHECK(body.strain_rate.row(2) == Eigen::RowVector3d(5000.0, 0.0, -3.0));
    CHECK(body.initial_stress.kind == InitialStressKind::geostatic);
    CHECK(body.initial_stress.lateral_coefficient == 0.53);
    CHECK(body.initial_stress.overconsolidation_ratio == 1.25);
}

TEST_CASE("boundaries, contacts, stages and outputs keep their order and values")
{
    const CaseDescription read = read_text(full_case);
    REQUIRE(read.boundaries.size() == 2);
    CHECK(read.boundaries[0].kind == ImageKind::symmetry);
    CHECK(read.boundaries[0].plane.axis == 1);
    CHECK(read.boundaries[0].plane.offset == -0.1);
    CHECK(read.boundaries[1].period == 1.0);
    REQUIRE(read.contacts.size() == 3);
    CHECK(read.contacts[0].between == std::vector<std::string>{"heap", "bubble"});
    CHECK(read.contacts[0].law.parameters.real("friction") == 0.3);
    REQUIRE(read.stages.size() == 2);
    CHECK(read.stages[0].name == "settle");
    REQUIRE(read.stages[0].rollers.size() == 2);
    CHECK(read.stages[0].rollers[0].offset == 0.1);
    CHECK(read.stages[0].rollers[1].axis == 2);
    CHECK(read.stages[0].residual == 1e-4);
    CHECK(read.stages[0].damping == 0.7);
    CHECK(read.stages[0].maximum_steps == 100);
    CHECK(read.stages[0].response == MaterialResponse::full);
    CHECK(read.stages[1].duration == 0.5);
    CHECK(read.stages[1].rest_speed == 0.005);
    CHECK(read.stages[1].residual == 0.01);
    REQUIRE(read.outputs.size() == 1);
    CHECK(read.outputs[0].writer.name == "test_writer");
    CHECK(read.outputs[0].every == 0.01);
    CHECK(read.outputs[0].times == std::vector<double>{0.0, 0.001});
}

TEST_CASE("plugin folders of a case are relative to the case file")
{
    const TemporaryFolder folder;
    write_file(folder / "sub/case.toml", full_case);
    PluginRegistry registry = test_registry();
    const CaseDescription read = read_case(folder / "sub/case.toml", {}, registry);
    REQUIRE(read.plugin_paths.size() == 1);
    CHECK(read.plugin_paths[0] == folder / "sub/more_plugins");
    const auto& searched = registry.searched();
    CHECK(std::find(searched.begin(), searched.end(), folder / "sub/more_plugins") != searched.end());
}

TEST_CASE("a former name is accepted with a warning that gives the place and the new name")
{
    const CaseDescription read = read_text(with(minimal_case, "stiffness", "modulus"));
    CHECK(read.materials[0].model.parameters.real("stiffness") == 25e6);
    REQUIRE(read.warnings.size() == 1);
    CHECK(contains(read.warnings[0], "case.toml:8:1: warning: 'modulus' is now called 'stiffness'"));
}

TEST_CASE("a horizon that lattice neighbours lie on exactly is warned of")
{
    // 3 spacings: (3,0,0) and (2,2,1) and their like lie on the sphere.
    const CaseDescription read = read_text(with(minimal_case, "\"5 mm\"", "\"5 mm\"\nhorizon = 3"));
    REQUIRE(read.warnings.size() == 1);
    CHECK(contains(read.warnings[0], "horizon"));
}

TEST_CASE("a material that no body is made of is warned of")
{
    const CaseDescription read = read_text(minimal_case + R"([material.sand]
model = "test_clay"
grain_density = 2600
porosity = 0.4
stiffness = "1 MPa"
)");
    REQUIRE(read.warnings.size() == 1);
    CHECK(contains(read.warnings[0], "'sand'"));
}
