// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pore pressure, saturation and mass of the points of a case.
#include "assembly/build_model.hpp"
#include "case/reader.hpp"
#include "operator/refresh.hpp"
#include "support/archives.hpp"
#include "support/case_text.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"
#include "time/dynamics.hpp"
#include "water/standing_water.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
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
        Water water = built.water;
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
    const Points& points = block.built.model.state.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double height = points.position[i].z() - 0.3;
        const double suction = std::min(5e3, std::max(0.0, 1000.0 * 9.81 * height));
        CHECK(points.suction(i) == doctest::Approx(suction).epsilon(1e-12));
        CHECK(points.saturation[i] == doctest::Approx(van_genuchten(suction)).epsilon(1e-12));
        const double density = 2500.0 * 0.6 + van_genuchten(suction) * 0.4 * 1000.0;
        CHECK(points.mass[i] / points.volume[i] == doctest::Approx(density).epsilon(1e-12));
    }
}

TEST_CASE("a field gives each point the suction of the nearest row, whatever the order of its columns")
{
    Block block(curve, "water = { type = \"field\", file = \"suction.csv\" }");
    const Points& points = block.built.model.state.points;
    for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(points.suction(i) == (points.position[i].z() < 0.5 ? 7e3 : 3e3));
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
        CHECK(model.state.points.suction(7) == doctest::Approx(suction).epsilon(1e-14));
        CHECK(model.state.points.saturation[7] == doctest::Approx(van_genuchten(suction)).epsilon(1e-14));
    }
}

TEST_CASE("water that comes adds its weight, and brings the energy of where it comes and how fast the soil is there")
{
    Block block(curve, "water = { type = \"uniform\", suction = \"8 kPa\" }",
                "water = [{ body = \"block\", type = \"uniform\", suction = \"2 kPa\", over = \"0.5 s\" }]");
    Model& model = block.built.model;
    Points& points = model.state.points;
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
    CHECK(model.state.points.suction(3) == doctest::Approx(6e3));
    CHECK(model.state.points.saturation[3] == doctest::Approx(0.15));
    water.follow(model, 1.0);
    CHECK(model.state.points.suction(3) == 0.0);
    CHECK(model.state.points.saturation[3] == 0.0);
}

TEST_CASE("a dry body with a curve is not saturated, until its water changes")
{
    Block block(curve, "", "water = [{ body = \"block\", type = \"uniform\", suction = \"2 kPa\" }]");
    Model& model = block.built.model;
    Water water = block.begun();
    water.follow(model, 0.0);
    CHECK(model.state.points.saturation[0] == 0.0);
    water.follow(model, 0.5);
    CHECK(model.state.points.suction(0) == doctest::Approx(1e3));
    CHECK(model.state.points.saturation[0] == doctest::Approx(van_genuchten(1e3)));
}

TEST_CASE("a curve that knows the porosity follows the volume of the point: phi = 1 - (1 - phi0) V0/V")
{
    Block block("retention = { curve = \"van_genuchten_porosity\", air_entry = \"2 kPa\", exponent = 2.0, "
                "reference_porosity = 0.4, void_ratio_exponent = 3.0 }\n",
                "water = { type = \"uniform\", suction = \"3 kPa\" }");
    Model& model = block.built.model;
    model.allocate();
    model.gather_ends(); // finds the water
    Water water = block.begun();
    const double before = model.state.points.saturation[5];
    CHECK(before == doctest::Approx(1.0 / std::sqrt(1.0 + std::pow(1.5, 2))));
    model.state.points.volume[5] *= 1.2;
    CHECK(porosity_of(model, 5) == doctest::Approx(0.5)); // 1 - 0.6/1.2
    water.follow(model, 0.1);
    // air enters at 2 kPa (e0/e)^3, with e0 = 2/3 and e = 1
    CHECK(model.state.points.saturation[5] ==
          doctest::Approx(1.0 / std::sqrt(1.0 + std::pow(3e3 / (2e3 * 8.0 / 27.0), 2))));
    CHECK(model.state.points.saturation[6] == doctest::Approx(before));
}

namespace {

constexpr double g = 9.81;
/// rho_w g h [Pa]
double at_rest(double height)
{
    return 1000.0 * g * height;
}
/// A table through the faces of cells, with soil that is drier above it.
const std::string half_wet = "water = { type = \"hydrostatic\", water_table = \"z = 500 mm\", saturation = 0.25 }";
/// That table falls by 0.4 m in a second.
const std::string drawdown = "water = [{ body = \"block\", type = \"hydrostatic\", water_table = \"z = 100 mm\", "
                             "saturation = 0.25, over = \"1 s\" }]";
constexpr double grains = 2500.0 * 0.6 * 1e-3; ///< of a point of the block [kg]

/// Lifts all points of a model.
void lift(Model& model, double height)
{
    for (Vector3& x : model.state.points.position)
        x.z() += height;
}

} // namespace

TEST_CASE("below a water table the pore pressure is that of water at rest, and the soil is saturated without suction")
{
    for (const std::string& retention : {std::string(), curve}) {
        CAPTURE(retention);
        Block block(retention,
                    retention.empty() ? half_wet : "water = { type = \"hydrostatic\", water_table = \"z = 500 mm\" }");
        const Points& points = block.built.model.state.points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double height = points.position[i].z() - 0.5;
            CHECK(points.pore_pressure[i] == doctest::Approx(-at_rest(height)).epsilon(1e-12));
            if (height > 0.0)
                continue;
            CHECK(points.suction(i) == 0.0);
            // the face of the uppermost of these cells lies in the table, to round-off
            CHECK(points.saturation[i] == doctest::Approx(1.0).epsilon(1e-12));
            CHECK(points.mass[i] == doctest::Approx(grains + 0.4).epsilon(1e-12));
        }
    }
}

TEST_CASE("a bound on the suction does not bound the pressure below the table")
{
    Block block("", "water = { type = \"hydrostatic\", water_table = \"z = 500 mm\", largest_suction = \"1 kPa\", "
                    "saturation = 0.25 }");
    const std::vector<double>& pressure = block.built.model.state.points.pore_pressure;
    CHECK(*std::ranges::min_element(pressure) == -1e3);
    CHECK(*std::ranges::max_element(pressure) == doctest::Approx(at_rest(0.45)).epsilon(1e-12));
}

TEST_CASE("a cell that the table cuts is saturated where it is under water")
{
    Block block("", "water = { type = \"hydrostatic\", water_table = \"z = 530 mm\", saturation = 0.25 }");
    const Points& points = block.built.model.state.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::abs(points.position[i].z() - 0.55) > 0.01)
            continue;
        CHECK(points.suction(i) == doctest::Approx(at_rest(0.02)).epsilon(1e-10)); // difference of 0.55 and 0.53
        CHECK(points.saturation[i] == doctest::Approx(0.3 + 0.7 * 0.25).epsilon(1e-12));
    }
}

TEST_CASE("a table that falls, and one that rises, has water at rest around it at every moment")
{
    for (const bool rises : {false, true}) {
        CAPTURE(rises);
        const std::string low = "water = { type = \"hydrostatic\", water_table = \"z = 100 mm\", saturation = 0.25 }";
        const std::string rise = "water = [{ body = \"block\", type = \"hydrostatic\", water_table = \"z = 500 mm\", "
                                 "saturation = 0.25, over = \"1 s\" }]";
        Block block("", rises ? low : half_wet, rises ? rise : drawdown);
        Model& model = block.built.model;
        const Points& points = model.state.points;
        Water water = block.begun();
        for (const double time : {0.0, 0.25, 0.6, 1.0, 1.1}) {
            CAPTURE(time);
            water.follow(model, time);
            const double done = std::min(time, 1.0);
            const double level = rises ? 0.1 + 0.4 * done : 0.5 - 0.4 * done;
            CHECK(model.state.bodies[0].water_level == doctest::Approx(level).epsilon(1e-12));
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double height = points.position[i].z() - level;
                const double share = std::clamp(0.5 - height / 0.1, 0.0, 1.0);
                CHECK(points.pore_pressure[i] == doctest::Approx(-at_rest(height)).epsilon(1e-12).scale(1e3));
                CHECK(points.saturation[i] == doctest::Approx(0.25 + 0.75 * share).epsilon(1e-12));
                CHECK(points.mass[i] == doctest::Approx(grains + 0.4 * points.saturation[i]).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("water that comes altogether fills a body from its bottom, and leaves it there")
{
    const std::string suction = "type = \"uniform\", suction = \"2 kPa\", saturation = 0.25";
    const std::string table = "type = \"hydrostatic\", water_table = \"z = 500 mm\", saturation = 0.25";
    for (const bool comes : {true, false}) {
        CAPTURE(comes);
        Block block("", "water = { " + (comes ? suction : table) + " }",
                    "water = [{ body = \"block\", over = \"1 s\", " + (comes ? table : suction) + " }]");
        Model& model = block.built.model;
        Water water = block.begun();
        water.follow(model, 0.4);
        CHECK(model.state.bodies[0].water_level == doctest::Approx(comes ? 0.2 : 0.3).epsilon(1e-12));
        water.follow(model, 1.0);
        CHECK(model.state.bodies[0].has_standing_water() == comes);
        for (std::size_t i = 0; i < model.size(); ++i)
            CHECK(model.state.points.pore_pressure[i] ==
                  doctest::Approx(comes ? at_rest(0.5 - model.state.points.position[i].z()) : -2e3).epsilon(1e-12));
    }
}

TEST_CASE("soil that sinks into standing water fills and loses its suction, evenly over one spacing, and stays full")
{
    Block block("", half_wet);
    Model& model = block.built.model;
    const Points& points = model.state.points;
    std::size_t top = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        top = points.position[i].z() > points.position[top].z() ? i : top;
    const double own = at_rest(0.45);
    Water water = block.begun();
    water.follow(model, 0.0);
    CHECK(points.suction(top) == doctest::Approx(own).epsilon(1e-12));
    lift(model, -0.425); // its middle lies 25 mm above the table, a quarter of its cell is under water
    const ArrivedEnergy arrived = water.follow(model, 0.1);
    CHECK(points.suction(top) == doctest::Approx(0.75 * own + 0.25 * at_rest(0.025)).epsilon(1e-10));
    CHECK(points.saturation[top] == doctest::Approx(0.25 + 0.25 * 0.75).epsilon(1e-10));
    CHECK(arrived.gravity > 0.0);
    lift(model, -0.2);
    water.follow(model, 0.2);
    CHECK(points.pore_pressure[top] == doctest::Approx(at_rest(0.175)).epsilon(1e-10));
    CHECK(points.saturation[top] == 1.0);
    lift(model, 0.3); // 125 mm above the table
    water.follow(model, 0.3);
    CHECK(points.pore_pressure[top] == doctest::Approx(-at_rest(0.125)).epsilon(1e-10));
    CHECK(points.saturation[top] == 1.0);
    lift(model, 10.0); // its suction never exceeds its own
    water.follow(model, 0.4);
    CHECK(points.suction(top) == doctest::Approx(own).epsilon(1e-12));
    // a change of its water starts from what it holds
    StageDescription drying = block.description.stages[0];
    WaterDescription uniform;
    uniform.kind = WaterKind::uniform;
    uniform.suction = 2e3;
    uniform.saturation = 0.2;
    drying.water_changes = {{"block", uniform, 1.0}};
    water.begin_stage(model, drying);
    for (const double time : {0.0, 0.5, 1.0}) {
        CAPTURE(time);
        water.follow(model, time);
        CHECK(points.suction(top) == doctest::Approx(std::lerp(own, 2e3, time)).epsilon(1e-12));
        CHECK(points.saturation[top] == doctest::Approx(std::lerp(1.0, 0.2, time)).epsilon(1e-12));
    }
}

TEST_CASE("under water the pores of soil that opens stay full: less its buoyancy it weighs what its grains do there")
{
    Block block("", half_wet);
    Model& model = block.built.model;
    for (double& volume : model.state.points.volume)
        volume *= 1.1;
    Water water = block.begun();
    water.follow(model, 0.0);
    const double in_water = (2500.0 - 1000.0) * 0.6 * 1e-3; // [kg]
    const StandingWater standing(model);
    for (std::size_t i = 0; i < model.size(); ++i)
        if (model.state.points.position[i].z() < 0.5)
            CHECK(model.state.points.mass[i] - standing.buoyancy_of(i) / g == doctest::Approx(in_water).epsilon(1e-12));
        else
            CHECK(model.state.points.mass[i] == doctest::Approx(grains + 0.1).epsilon(1e-12)); // takes up none
}

TEST_CASE("a stage that follows a change, and one that was resumed, goes on from the same water")
{
    Block block("", half_wet, drawdown);
    Model& model = block.built.model;
    Water water = block.begun();
    water.follow(model, 0.6);
    const Points before = model.state.points;
    StageDescription still = block.description.stages[0];
    still.water_changes.clear();
    water.begin_stage(model, still);
    Water resumed = block.built.water; // with lists of the right lengths
    Model other = model;
    other.state.bodies[0].water_level = 7.0;
    save_and_restore(water, resumed);
    resumed.resume(other, still);
    CHECK(other.state.bodies[0].water_level == model.state.bodies[0].water_level);
    for (const auto& [one, its] : {std::pair{&water, &model}, {&resumed, &other}}) {
        const ArrivedEnergy arrived = one->follow(*its, 0.1);
        // own pressure and that of the standing water are interpolated apart: round-off
        CHECK(std::abs(arrived.gravity) < 1e-12);
        for (std::size_t i = 0; i < before.size(); ++i) {
            CHECK(its->state.points.pore_pressure[i] == doctest::Approx(before.pore_pressure[i]).epsilon(1e-12));
            CHECK(its->state.points.mass[i] == doctest::Approx(before.mass[i]).epsilon(1e-14));
        }
    }
    CHECK(other.state.points.pore_pressure == model.state.points.pore_pressure);
}

TEST_CASE("a body out of the water that reaches below the table of another is remarked on")
{
    const std::string beside = R"(
[body.stone]
geometry = { generator = "box", size = ["200 mm", "200 mm", "200 mm"], origin = ["1 m", "0 m", "LEVEL"] }
material = "soil"
)";
    const auto remarks = [&](const char* level) {
        std::string stone = beside;
        stone.replace(stone.find("LEVEL"), 5, level);
        return Block("", half_wet + stone).built.remarks;
    };
    CHECK(remarks("500 mm").empty());
    REQUIRE(remarks("350 mm").size() == 1);
    check_mentions(remarks("350 mm")[0], {"'stone'", "'block'", "water_table"});
}

TEST_CASE("soil that falls into the water and fills keeps its energy, and that of the water that it took up")
{
    Block block("", "water = { type = \"hydrostatic\", water_table = \"z = -50 mm\", largest_suction = \"100 Pa\", "
                    "saturation = 0.25 }");
    Model& model = block.built.model;
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    Water water = block.begun();
    ContactForces contact(std::vector<ContactAssignment>{});
    Dynamics dynamics(model, *force, contact, {0.1 * model.state.spacing, false});
    water.follow(model, 0.0);
    dynamics.start();
    dynamics.open_ledger();
    const double time_step = 2e-4; // a tenth of the stable one
    for (int step = 1; step <= 3000; ++step) {
        dynamics.book(water.follow(model, step * time_step, time_step));
        dynamics.step({time_step, MaterialResponse::full, 0.0});
    }
    CHECK(*std::ranges::min_element(model.state.points.saturation) == 1.0);
    const EnergyLedger& ledger = dynamics.ledger();
    MESSAGE("energy error over the work of the lift: " << ledger.error() / std::abs(ledger.boundary));
    CHECK(std::abs(ledger.error()) < 1e-5 * std::abs(ledger.boundary)); // stress is not linear in the motion of a step
}
