// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From a case to a model.
#include "assembly/build_model.hpp"
#include "assembly/held_points.hpp"
#include "case/reader.hpp"
#include "diagnostics/snapshot_fields.hpp"
#include "operator/refresh.hpp"
#include "support/case_text.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/specimens.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace periporo;

namespace {

CaseDescription quickstart(const std::vector<std::string>& overrides = {})
{
    PluginRegistry registry;
    return read_case(PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart.toml",
                     {overrides, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry);
}

/// Overrides: a suction of 10 kPa at a saturation.
std::vector<std::string> wet(const std::string& saturation)
{
    return {"body.column.water.type=uniform", "body.column.water.suction=10 kPa",
            "body.column.water.saturation=" + saturation};
}

/// The quickstart with a text of its own, which overrides it.
CaseDescription quickstart_with(const std::string& text)
{
    const periporo::test::TemporaryFolder folder;
    periporo::test::write_file(
        folder / "case.toml", "include = [\"" PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart.toml\"]\n" + text);
    PluginRegistry registry;
    return read_case(folder / "case.toml", {{}, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry);
}

BuiltModel built(const CaseDescription& description)
{
    return build_model(description, periporo::test::built_plugins());
}

} // namespace

TEST_CASE("the quickstart is 10 x 10 x 12 points that weigh rho_s (1 - phi) times the volume")
{
    const BuiltModel model = built(quickstart());
    CHECK(model.model.size() == 1200);
    double mass = 0.0;
    for (const double m : model.model.state.points.mass)
        mass += m;
    CHECK(mass == doctest::Approx(2200.0 * 0.8 * 0.1 * 0.1 * 0.12).epsilon(1e-12));
}

TEST_CASE("water in the pores counts in the mass: rho = rho_s (1 - phi) + S_r phi rho_w")
{
    const BuiltModel model = built(quickstart(wet("0.5")));
    const Points& points = model.model.state.points;
    CHECK(points.mass[0] / points.volume[0] == doctest::Approx(2200.0 * 0.8 + 0.5 * 0.2 * 1000.0).epsilon(1e-12));
}

TEST_CASE("a spinning body has v = v0 + omega x (x - centre of mass)")
{
    const BuiltModel model = built(
        quickstart({"body.column.velocity=[\"1 m/s\", 0, 0]", "body.column.angular_velocity=[0, 0, \"3 rad/s\"]"}));
    const Points& points = model.model.state.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3 expected =
            Vector3(1, 0, 0) + Vector3(0, 0, 3).cross(points.position[i] - Vector3(0.05, 0.05, 0.06));
        REQUIRE((points.velocity[i] - expected).norm() < 1e-14); // round-off of 0.3 m/s
    }
}

TEST_CASE("a deforming body has v = D (x - centre of mass)")
{
    const BuiltModel model =
        built(quickstart({"body.column.strain_rate=[\"1 s^-1\", 0, \"-2 s^-1\", \"0.5 s^-1\", 0, \"3 s^-1\"]"}));
    Eigen::Matrix3d rate;
    rate << 1.0, 0.5, 3.0, 0.5, 0.0, 0.0, 3.0, 0.0, -2.0;
    const Points& points = model.model.state.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3 expected = rate * (points.position[i] - Vector3(0.05, 0.05, 0.06));
        REQUIRE((points.velocity[i] - expected).norm() < 1e-14); // round-off of 0.3 m/s
    }
}

TEST_CASE("a body behind a symmetry plane is cut, and the remark says so")
{
    const BuiltModel model = built(quickstart({"body.column.geometry.size=[\"200 mm\", \"100 mm\", \"120 mm\"]",
                                               "body.column.geometry.origin=[\"-100 mm\", \"0 mm\", \"0 mm\"]"}));
    CHECK(model.model.size() == 1200);
    REQUIRE(model.remarks.size() == 1);
    CHECK(model.remarks[0].find("1200 of 2400") != std::string::npos);
}

TEST_CASE("every point is in the model once, whatever the order along the curve")
{
    const BuiltModel model = built(quickstart());
    CHECK(std::set<std::int64_t>(model.model.state.points.id.begin(), model.model.state.points.id.end()).size() ==
          1200);
}

TEST_CASE("geostatic stress of a bond is that at the depth of its middle, with K0 across, minus the pore part")
{
    const double suction = 10e3, saturation = 0.02, k0 = 0.53;
    const CaseDescription description = quickstart(wet("0.02"));
    BuiltModel made = built(description);
    Model& model = made.model;
    model.neighbourhood.isometries.set_generators(image_generators(description, description.stages[0]));
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    set_initial_stress(model, *force, description);
    const double density = model.state.points.mass[0] / model.state.points.volume[0];
    for (const std::size_t i : {std::size_t{0}, std::size_t{600}, std::size_t{1199}})
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b) {
            const std::uint32_t j = model.neighbourhood.families[i].neighbours[b];
            const double z = 0.5 * (model.state.points.position[i].z() + model.ends[j].position[2]);
            const double vertical = -density * 9.81 * (0.12 - z) - saturation * suction;
            CHECK(specimens::bond_value(model, i, b, 2) == doctest::Approx(vertical).epsilon(1e-12));
            CHECK(specimens::bond_value(model, i, b, 0) == doctest::Approx(k0 * vertical).epsilon(1e-12));
            CHECK(specimens::bond_value(model, i, b, 3) == 0.0);
        }
}

TEST_CASE("geostatic stress across a water table is the weight less the buoyancy above, minus the pore part")
{
    const double level = 0.06, top = 0.12, g = 9.81;
    const CaseDescription description =
        quickstart({"body.column.water.type=hydrostatic", "body.column.water.water_table=z = 60 mm",
                    "body.column.water.saturation=0.3"});
    BuiltModel made = built(description);
    Model& model = made.model;
    model.neighbourhood.isometries.set_generators(image_generators(description, description.stages[0]));
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force);
    set_initial_stress(model, *force, description);
    const double moist = 2200.0 * 0.8 + 0.3 * 0.2 * 1000.0, in_water = (2200.0 - 1000.0) * 0.8;
    const Points& points = model.state.points;
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b) {
            const std::uint32_t j = model.neighbourhood.families[i].neighbours[b];
            const std::uint32_t p = model.neighbourhood.families.parent(j);
            const double z = 0.5 * (points.position[i].z() + model.ends[j].position[2]);
            const double above = top - std::max(z, level), below = std::max(0.0, level - z);
            const double pull =
                0.25 * (points.suction(i) + points.suction(p)) * (points.saturation[i] + points.saturation[p]);
            REQUIRE(specimens::bond_value(model, i, b, 2) ==
                    doctest::Approx(-g * (moist * above + in_water * below) - pull).epsilon(1e-10));
        }
}

TEST_CASE("cylindrical rollers hold the radial direction of the outer ring only")
{
    const CaseDescription description = quickstart({"stage.0.rollers=[\"r = 100 mm\"]"});
    BuiltModel made = built(description);
    const std::vector<HeldDirection> held =
        held_directions(made.model, description, made.held_regions, description.stages[0]);
    CHECK(!held.empty());
    for (const HeldDirection& h : held) {
        const Vector3& x = made.model.state.points.position[h.point];
        CHECK(std::hypot(x.x(), x.y()) > 0.09);
        CHECK(h.direction.dot(Vector3(x.x(), x.y(), 0.0).normalized()) == doctest::Approx(1.0));
    }
}

TEST_CASE("a fixed region holds all directions of the points that begin below its plane, and cuts nothing")
{
    const CaseDescription description =
        quickstart({"boundary=[{type=\"fixed\",plane=\"z = 20 mm\"}]", "stage.0.rollers=[]"});
    BuiltModel made = built(description);
    CHECK(made.model.size() == 1200);
    CHECK(image_generators(description, description.stages[0]).empty());
    const std::vector<HeldDirection> held =
        held_directions(made.model, description, made.held_regions, description.stages[0]);
    std::map<std::uint32_t, Vector3> sums;
    for (const HeldDirection& h : held) {
        CHECK(made.model.state.points.position[h.point].z() < 0.02);
        sums.emplace(h.point, Vector3::Zero()).first->second += h.direction;
    }
    CHECK(sums.size() == 200);
    for (const auto& [point, sum] : sums)
        CHECK(sum == Vector3::Ones());
}

TEST_CASE("two oblique rollers hold a point along both directions, by directions that are orthogonal")
{
    const CaseDescription description = quickstart_with(R"(
[[boundary]]
type = "roller"
plane = "z = 10 mm"
direction = [0, 0, 1]
[[boundary]]
type = "roller"
plane = "z = 10 mm"
direction = [1, 0, 1]
)");
    const BuiltModel made = built(description);
    const std::vector<HeldDirection> held =
        held_directions(made.model, description, made.held_regions, description.stages[1]);
    REQUIRE(held.size() == 200); // two directions of each of the 100 points of the lowest layer
    for (std::size_t h = 0; h < held.size(); h += 2) {
        REQUIRE(held[h].point == held[h + 1].point);
        CHECK(std::abs(held[h].direction.dot(held[h + 1].direction)) < 1e-15);
        // what is left free is the y axis alone
        CHECK(std::abs(held[h].direction.cross(held[h + 1].direction).y()) == doctest::Approx(1.0).epsilon(1e-15));
    }
}

TEST_CASE("rollers and moving regions hold points of a layer, of a geometry and of a body, in their stages")
{
    const CaseDescription description = quickstart_with(R"(
[geometry.corner]
generator = "box"
size = ["50 mm", "50 mm", "200 mm"]
[[boundary]]
type = "roller"
layer = ["z = 10 mm", "z = 30 mm"]
direction = [0, 0, 2]
stages = ["geostatic"]
[[boundary]]
type = "moving"
within = "corner"
plane = "z = 20 mm"
body = "column"
velocity = [0, "3 mm/s", 0]
stages = ["collapse"]
)");
    const BuiltModel made = built(description);
    const std::vector<HeldDirection> first =
        held_directions(made.model, description, made.held_regions, description.stages[0]);
    CHECK(first.size() == 200);
    for (const HeldDirection& held : first) {
        const double z = made.model.state.points.position[held.point].z();
        CHECK((z > 0.01 && z < 0.03));
        CHECK(held.direction == Vector3::UnitZ());
        CHECK(held.speed == 0.0);
    }
    const std::vector<HeldDirection> second =
        held_directions(made.model, description, made.held_regions, description.stages[1]);
    CHECK(second.size() == 3 * 5 * 5 * 2);
    for (const HeldDirection& held : second) {
        const Vector3& x = made.model.state.points.position[held.point];
        CHECK((x.x() < 0.05 && x.y() < 0.05 && x.z() < 0.02));
        CHECK(held.speed == (held.direction == Vector3::UnitY() ? 3e-3 : 0.0));
    }
}

TEST_CASE("a roller with points on both sides is refused, with the way to hold one body")
{
    const CaseDescription description = quickstart();
    const BuiltModel made = built(description);
    StageDescription stage = description.stages[0];
    check_rollers(made.model, stage); // x = 100 mm, where the column ends
    stage.rollers[0].offset = 0.05;
    CHECK_THROWS_WITH_AS(check_rollers(made.model, stage),
                         doctest::Contains("600 of the 1200 points lie beyond the roller x = 0.05 m"),
                         std::runtime_error);
}

TEST_CASE("an obstacle stands in its stages and moves in its own, and a contact meets it or the surface of a body")
{
    const CaseDescription description = quickstart_with(R"(
[geometry.plate]
generator = "box"
size = ["1 m", "1 m", "10 mm"]
origin = [0, 0, "-10 mm"]
[obstacle.floor]
geometry = { generator = "boolean", operation = "union", of = ["plate", "plate"] }
velocity = [0, 0, "1 m/s"]
moves_in = ["collapse"]
stages = ["collapse"]
[[contact]]
law = "short_range"
between = ["column", "floor"]
modulus = "1 MPa"
friction = 0
)");
    BuiltModel made = built(description);
    REQUIRE(made.model.state.obstacles.size() == 1);
    Vector3 normal;
    CHECK(made.model.state.obstacles[0].distance({0.5, 0.5, 3e-3}, normal) ==
          doctest::Approx(3e-3).epsilon(1e-12).scale(0.0));
    CHECK(*made.contacts[0].obstacle == 0);
    CHECK(made.contacts[0].law->cutoff() == doctest::Approx(5e-3).epsilon(1e-12).scale(0.0)); // half a spacing
    set_obstacles(made.model, description, description.stages[0]);
    CHECK_FALSE(made.model.state.obstacles[0].present);
    CHECK(made.model.state.obstacles[0].velocity == Vector3::Zero());
    set_obstacles(made.model, description, description.stages[1]);
    CHECK(made.model.state.obstacles[0].present);
    CHECK(made.model.state.obstacles[0].velocity == Vector3::UnitZ());
}

TEST_CASE("the substrate is the ground, and the column above it makes front and height of the history")
{
    PluginRegistry registry;
    const CaseDescription description =
        read_case(PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart_substrate.toml",
                  {{}, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry);
    BuiltModel made = built(description);
    Model& model = made.model;
    for (const Body& body : model.state.bodies)
        CHECK(body.ground == (body.name == "substrate"));
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    ContactForces contact({});
    const Dynamics dynamics(model, *force, contact, {});
    const std::vector<HistoryColumn> columns = history_columns(model);
    const auto value = [&](const std::string& name) {
        const auto at = std::ranges::find(columns, name, &HistoryColumn::name);
        REQUIRE(at != columns.end());
        return history_row(model, dynamics, 0.0, 0.0)[static_cast<std::size_t>(at - columns.begin())];
    };
    CHECK(value("front") == doctest::Approx(0.095 * std::sqrt(2.0))); // the corner of the column
    CHECK(value("height") == doctest::Approx(0.12));
    for (Body& body : model.state.bodies)
        body.ground = true;
    CHECK(value("front") > 0.2); // that of the substrate
}

TEST_CASE("a contact law that cannot act where it stands is an error of the case")
{
    periporo::test::check_mentions(periporo::test::message_of_error([] {
                                       quickstart_with(R"(
[obstacle.floor]
geometry = { generator = "box", size = ["1 m", "1 m", "10 mm"], origin = [0, 0, "-10 mm"] }
[[contact]]
law = "rigid_plane"
between = ["column", "floor"]
point = [0, 0, 0]
normal = [0, 0, 1]
modulus = "1 MPa"
friction = 0
)");
                                   }),
                                   {"the law brings a surface of its own", "contact 'rigid_plane' cannot act here"});
    periporo::test::check_mentions(periporo::test::message_of_error([] {
                                       quickstart_with(R"(
[[contact]]
law = "penalty"
between = ["column", "column"]
modulus = "1 MPa"
cutoff = "31 mm"
friction = 0
)");
                                   }),
                                   {"its cut-off 0.031 m is not shorter than the horizon 0.03015 m"});
}

TEST_CASE("a fixed region that holds no point, or all, is refused")
{
    for (const char* plane : {"z = -1 mm", "z = 1 m"})
        CHECK_THROWS_WITH_AS(
            built(quickstart({fmt::format("boundary=[{{type=\"fixed\",plane=\"{}\"}}]", plane), "stage.0.rollers=[]"})),
            doctest::Contains("boundary 'fixed'"), std::runtime_error);
}

namespace {

/// A law that leaves its two variables as they are.
struct Memory : specimens::Hooke {
    static constexpr std::size_t state_count = 2;
    static std::vector<StateVariable> state_variables()
    {
        return {{"accumulated", "-", "", 0.25, true}, {"kept", "-", "", 0.5, false}};
    }
    using Hooke::Hooke;
    template <class Real>
    LawResult<Real, 2> update(const LawInput<Real, 2>& old) const
    {
        return {old.stress, old.state};
    }
    template <class Real>
    std::array<Real, 2> initial_state(const LawInput<Real, 2>& settled, double) const
    {
        return settled.state;
    }
};

} // namespace

TEST_CASE("the geostatic stage leaves variables that are reset on release at their initial value, and no others")
{
    Model model = specimens::from_positions(specimens::lattice(3, 3, 3, 0.1), 0.1);
    model.state.bodies[0].material = std::make_shared<LawMaterial<Memory>>(Parameters{});
    model.allocate();
    const auto force_state = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force_state);
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b)
            specimens::bond_value(model, i, b, 6) = specimens::bond_value(model, i, b, 7) = 3.0;
    initialize_materials(model, *force_state);
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b) {
            CHECK(specimens::bond_value(model, i, b, 6) == 0.25);
            CHECK(specimens::bond_value(model, i, b, 7) == 3.0);
        }
}
