// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whole runs of grains and soil at obstacles: corners that hold them, plates that they go through.
#include "cli/program.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace periporo::test;

namespace {

const std::string grain = R"(
[discretization]
spacing = "10 mm"
[material.e]
model = "linear_elastic"
grain_density = "2600 kg/m3"
porosity = 0.0
bulk_modulus = "4 MPa"
shear_modulus = "2.4 MPa"
)";

/// A plate 2 mm thick that comes at 5 m/s. Its law stops a grain within v (m/k)^(1/2) = 11 mm.
const std::string thin_plate = R"(title = "a grain and a thin plate")" + grain + R"(
[body.grain]
geometry = { generator = "box", size = ["10 mm", "10 mm", "10 mm"], origin = ["-5 mm", "-5 mm", "0 mm"] }
material = "e"
[obstacle.plate]
geometry = { generator = "box", size = ["80 mm", "80 mm", "2 mm"], origin = ["-40 mm", "-40 mm", "15 mm"] }
velocity = ["0 m/s", "0 m/s", "-5 m/s"]
[[contact]]
law = "short_range"
between = ["grain", "plate"]
modulus = "0.05 MPa"
friction = 0.0
[[stage]]
name = "press"
type = "dynamic"
duration = "6 ms"
)";

/// A floor and a wall in one, and gravity into the corner between them.
const std::string corner = R"(title = "a grain in a corner"
gravity = ["6.936 m/s2", "0 m/s2", "-6.936 m/s2"])" +
                           grain + R"(
[geometry.floor]
generator = "box"
size = ["200 mm", "200 mm", "50 mm"]
origin = ["-150 mm", "-100 mm", "-50 mm"]
[geometry.wall]
generator = "box"
size = ["50 mm", "200 mm", "200 mm"]
origin = ["0 mm", "-100 mm", "-50 mm"]
[body.grain]
geometry = { generator = "box", size = ["10 mm", "10 mm", "10 mm"], origin = ["-10 mm", "-5 mm", "0 mm"] }
material = "e"
[obstacle.corner]
geometry = { generator = "boolean", operation = "union", of = ["floor", "wall"] }
[[contact]]
law = "short_range"
between = ["grain", "corner"]
modulus = "0.1 MPa"
friction = 0.0
restitution = 0.1
[[stage]]
name = "rest"
type = "quasi_static"
maximum_steps = 1000
)";

/// A box of soil in a container made of one box less another.
const std::string container = R"(title = "soil in a container"
[discretization]
spacing = "20 mm"
[material.soil]
model = "mohr_coulomb"
grain_density = "2650 kg/m3"
porosity = 0.4
bulk_modulus = "2.5 MPa"
shear_modulus = "1.5 MPa"
friction_angle = "30 deg"
dilatancy_angle = "0 deg"
cohesion = "0 Pa"
[geometry.outer]
generator = "box"
size = ["100 mm", "100 mm", "90 mm"]
origin = ["-10 mm", "-10 mm", "-10 mm"]
[geometry.inner]
generator = "box"
size = ["80 mm", "80 mm", "100 mm"]
[body.soil]
geometry = { generator = "box", size = ["80 mm", "80 mm", "60 mm"] }
material = "soil"
initial_stress = { type = "geostatic", K0 = 0.5 }
[obstacle.can]
geometry = { generator = "boolean", operation = "difference", of = ["outer", "inner"] }
[[contact]]
law = "short_range"
between = ["soil", "can"]
modulus = "2 MPa"
friction = 0.3
restitution = 0.1
[[stage]]
name = "settle"
type = "quasi_static"
maximum_steps = 2000
)";

nlohmann::json summary(const ProgramFolder& folder, const std::string& results)
{
    return nlohmann::json::parse(ProgramFolder::read(folder.path() / results / "summary.json"));
}

} // namespace

TEST_CASE("a grain that goes through a plate stops the run, which says where, when and the ways out")
{
    const ProgramFolder folder;
    folder.write("plate.toml", thin_plate);
    const ProgramResult result = folder.run("run plate.toml --quiet --threads 1 --out stopped");
    CHECK(result.status == 1);
    for (const char* part : {"stage 'press', step", "point 0 of body 'grain' went through obstacle 'plate'",
                             "a stiffer law", "crossing = \"warn\" in contact 0", "last snapshot"}) {
        CAPTURE(part);
        CHECK(result.error.find(part) != std::string::npos);
    }
    CHECK(summary(folder, "stopped")["outcome"] == "failed");
}

TEST_CASE("a run that warns of crossings goes on, and counts them")
{
    const ProgramFolder folder;
    folder.write("plate.toml", thin_plate);
    const ProgramResult result =
        folder.run("run plate.toml --quiet --threads 1 --out warned --set contact.0.crossing=warn");
    CHECK(result.status == 0);
    CHECK(result.error.find("point 0 of body 'grain' went through obstacle 'plate'") != std::string::npos);
    const nlohmann::json warned = summary(folder, "warned");
    CHECK(warned["contacts"][0]["crossed_points"] == 1);
    // What the contact had stored counts as dissipated: energy is lost, not missing. The work of the last push is known
    // to one step, in which the overlap of 6 mm grows by 5 m/s times the step.
    const double energy = 0.5 * 2600.0 * 1e-6 * 25.0; // of the grain at the speed of the plate [J]
    CHECK(std::abs(warned["energy"]["error"].get<double>()) < 0.1 * energy);
    CHECK(warned["energy"]["collision"].get<double>() > 0.0);
}

TEST_CASE("a plate holds a grain that its law can stop, however thin it is")
{
    const ProgramFolder folder;
    folder.write("plate.toml", thin_plate);
    // (k/m)^(1/2) = 797/s stops it within 6.3 mm of where it touches, 5 mm from the face: in the back half of the
    // plate. It flies off at twice the speed of the plate.
    const ProgramResult result = folder.run("run plate.toml --threads 1 --out held --quiet "
                                            "--set 'contact.0.modulus=0.165 MPa' --set 'time.step=0.05 ms'");
    CHECK(result.status == 0);
    const nlohmann::json held = summary(folder, "held");
    CHECK(held["contacts"][0]["crossed_points"] == 0);
    CHECK(held["contacts"][0]["deepest_overlap"].get<double>() > 1.2); // over 5 mm
    const double mass = 2600.0 * 1e-6;
    // Verlet: (omega dt)^2/24 = 7e-5 of the speed
    CHECK(held["energy"]["kinetic"].get<double>() == doctest::Approx(0.5 * mass * 100.0).epsilon(1e-3));
}

TEST_CASE("a grain in the corner of one obstacle, and soil in a container, come to equilibrium")
{
    const ProgramFolder folder;
    folder.write("corner.toml", corner);
    folder.write("container.toml", container);
    for (const std::string name : {"corner", "container"}) {
        const ProgramResult result = folder.run("run " + name + ".toml --quiet --threads 1 --out " + name);
        CAPTURE(result.error);
        CHECK(result.status == 0);
        CHECK(summary(folder, name)["outcome"] == "complete");
    }
}
