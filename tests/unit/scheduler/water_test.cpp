// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Suction and saturation of the points of a case.
#include "case/reader.hpp"
#include "scheduler/build_model.hpp"
#include "support/case_text.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

using namespace periporo;
using namespace periporo::test;

namespace {

/// A block of two by two by ten points of 0.1 m, from z = 0 up, with texts for its material, its body and its stage.
struct Block {
    TemporaryFolder folder;
    CaseDescription description;
    BuiltModel built;

    Block(const std::string& material, const std::string& body, const std::string& stage = "")
    {
        write_file(folder / "suction.csv", "z [cm], x, y, suction [kPa] # from a probe\n5, 0, 0, 7\n95, 0, 0, 3\n");
        write_file(folder / "below.csv", "x, y, z, suction\n0, 0, 0, 1\n0, 0, 1, -2\n");
        write_file(folder / "case.toml", R"(title = "wet block"
[discretization]
spacing = "100 mm"
[material.soil]
model = "linear_elastic"
grain_density = "2500 kg/m3"
porosity = 0.4
bulk_modulus = "1 MPa"
shear_modulus = "1 MPa"
)" + material + R"(
[body.block]
geometry = { generator = "box", size = ["200 mm", "200 mm", "1 m"], origin = ["0 m", "0 m", "0 m"] }
material = "soil"
)" + body + R"(
[[stage]]
name = "run"
type = "dynamic"
duration = "1 s"
)" + stage);
        PluginRegistry registry;
        description = read_case(folder / "case.toml", {{}, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry);
        built = build_model(description, built_plugins());
    }

    /// Water that has entered the stage.
    Water begun()
    {
        Water water(description, built_plugins());
        water.begin_stage(built.model, description.stages[0]);
        return water;
    }
};

const std::string curve = "retention = { curve = \"van_genuchten\", air_entry = \"2 kPa\", exponent = 2.0, "
                          "residual_saturation = 0.1 }\n";

/// van Genuchten (1980), with the numbers of `curve`.
double van_genuchten(double suction)
{
    return 0.1 + 0.9 / std::sqrt(1.0 + std::pow(suction / 2e3, 2));
}

} // namespace

TEST_CASE("above a water table the suction is that of water at rest, and the mass is that of grains and water")
{
    Block block(curve, "water = { type = \"hydrostatic\", water_table = \"z = 300 mm\", largest_suction = \"5 kPa\" }");
    const Points& points = block.built.model.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double height = points.position[i].z() - 0.3;
        const double suction = std::min(5e3, std::max(0.0, 1000.0 * 9.81 * height));
        CHECK(points.suction[i] == doctest::Approx(suction).epsilon(1e-12));
        CHECK(points.saturation[i] == doctest::Approx(van_genuchten(suction)).epsilon(1e-12));
        const double density = 2500.0 * 0.6 + van_genuchten(suction) * 0.4 * 1000.0;
        CHECK(points.mass[i] / points.volume[i] == doctest::Approx(density).epsilon(1e-12));
    }
}

TEST_CASE("a field gives each point the suction of the nearest row, whatever the order of its columns")
{
    Block block(curve, "water = { type = \"field\", file = \"suction.csv\" }");
    const Points& points = block.built.model.points;
    for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(points.suction[i] == (points.position[i].z() < 0.5 ? 7e3 : 3e3));
    check_mentions(message_of_error([] { Block(curve, "water = { type = \"field\", file = \"below.csv\" }"); }),
                   {"water of body 'block'", "below.csv: line 3", "at least 0"});
}

TEST_CASE("suction goes evenly from one value to the other, the saturation along the curve")
{
    Block block(curve, "water = { type = \"uniform\", suction = \"8 kPa\" }",
                "water = [{ body = \"block\", type = \"uniform\", suction = \"2 kPa\", over = \"0.5 s\" }]");
    Model& model = block.built.model;
    Water water = block.begun();
    for (const auto& [time, suction] : {std::pair{0.0, 8e3}, {0.125, 6.5e3}, {0.5, 2e3}, {0.75, 2e3}}) {
        CAPTURE(time);
        water.follow(model, time);
        CHECK(model.points.suction[7] == doctest::Approx(suction).epsilon(1e-14));
        CHECK(model.points.saturation[7] == doctest::Approx(van_genuchten(suction)).epsilon(1e-14));
    }
}

TEST_CASE("water that comes adds its weight, and brings the energy of where it comes and how fast the soil is there")
{
    Block block(curve, "water = { type = \"uniform\", suction = \"8 kPa\" }",
                "water = [{ body = \"block\", type = \"uniform\", suction = \"2 kPa\", over = \"0.5 s\" }]");
    Model& model = block.built.model;
    Points& points = model.points;
    points.velocity[9] = {1.0, 2.0, -2.0};
    points.volume[9] *= 1.1; // takes up no water
    Water water = block.begun();
    const auto mass = [](double suction) { return 1e-3 * (2500.0 * 0.6 + van_genuchten(suction) * 0.4 * 1000.0); };
    double height = 0.0; // sum of the heights of the points [m]
    for (const Vector3& x : points.position)
        height += x.z();
    double before = 8e3;
    for (const auto& [time, suction] : {std::pair{0.25, 5e3}, {0.5, 2e3}, {0.75, 2e3}}) {
        CAPTURE(time);
        const ArrivedEnergy arrived = water.follow(model, time);
        const double came = mass(suction) - mass(before);
        before = suction;
        for (std::size_t i = 0; i < points.size(); ++i)
            REQUIRE(points.mass[i] == doctest::Approx(mass(suction)).epsilon(1e-14));
        CHECK(arrived.kinetic == doctest::Approx(4.5 * came).epsilon(1e-12));
        CHECK(arrived.gravity == doctest::Approx(9.81 * height * came).epsilon(1e-12));
    }
}

TEST_CASE("without a curve the saturation goes evenly, and what gets dry is dry at the end")
{
    Block block("", "water = { type = \"uniform\", suction = \"8 kPa\", saturation = 0.2 }",
                "water = [{ body = \"block\", type = \"dry\" }]");
    Model& model = block.built.model;
    Water water = block.begun();
    water.follow(model, 0.25);
    CHECK(model.points.suction[3] == doctest::Approx(6e3));
    CHECK(model.points.saturation[3] == doctest::Approx(0.15));
    water.follow(model, 1.0);
    CHECK(model.points.suction[3] == 0.0);
    CHECK(model.points.saturation[3] == 0.0);
}

TEST_CASE("a dry body with a curve is not saturated, until its water changes")
{
    Block block(curve, "", "water = [{ body = \"block\", type = \"uniform\", suction = \"2 kPa\" }]");
    Model& model = block.built.model;
    Water water = block.begun();
    water.follow(model, 0.0);
    CHECK(model.points.saturation[0] == 0.0);
    water.follow(model, 0.5);
    CHECK(model.points.suction[0] == doctest::Approx(1e3));
    CHECK(model.points.saturation[0] == doctest::Approx(van_genuchten(1e3)));
}

TEST_CASE("a curve that knows the porosity follows the volume of the point: phi = 1 - (1 - phi0) V0/V")
{
    Block block("retention = { curve = \"van_genuchten_porosity\", air_entry = \"2 kPa\", exponent = 2.0, "
                "reference_porosity = 0.4, void_ratio_exponent = 3.0 }\n",
                "water = { type = \"uniform\", suction = \"3 kPa\" }");
    Model& model = block.built.model;
    model.allocate();
    model.update_records(); // finds the water
    Water water = block.begun();
    const double before = model.points.saturation[5];
    CHECK(before == doctest::Approx(1.0 / std::sqrt(1.0 + std::pow(1.5, 2))));
    model.points.volume[5] *= 1.2;
    CHECK(porosity_of(model, 5) == doctest::Approx(0.5)); // 1 - 0.6/1.2
    water.follow(model, 0.1);
    // air enters at 2 kPa (e0/e)^3, with e0 = 2/3 and e = 1
    CHECK(model.points.saturation[5] == doctest::Approx(1.0 / std::sqrt(1.0 + std::pow(3e3 / (2e3 * 8.0 / 27.0), 2))));
    CHECK(model.points.saturation[6] == doctest::Approx(before));
}
