// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo drive`: exit status, what it says, what it leaves behind.
#include "cli/program.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace periporo::test;

namespace {

const std::string silt_path = R"(title = "drained triaxial compression"
[material.silt]
model = "viscoplastic_critical_state"
porosity = 0.45
bulk_modulus = "25 MPa"
shear_modulus = "15 MPa"
critical_state_slope = 1.1
compression_index = 0.12
swelling_index = 0.04
viscosity = "1000 Pa3 s"
[initial]
pressure = "100 kPa"
overconsolidation_ratio = 1.25
[[stage]]
name = "shear"
type = "triaxial_drained"
deviator_stress = "150 kPa"
duration = "100 s"
steps = 15
)";

/// Asks for more than 3 M p0/(3 - M) = 173.7 kPa, which is all that the soil bears.
const std::string too_much = with(with(silt_path, "\"150 kPa\"", "\"200 kPa\""), "steps = 15", "steps = 20");

class PathFolder : public ProgramFolder {
public:
    explicit PathFolder(const std::string& text = silt_path) { write("path.toml", text); }
};

std::string without_first_lines(const std::string& text, int lines)
{
    std::size_t begin = 0;
    for (int n = 0; n < lines; ++n)
        begin = text.find('\n', begin) + 1;
    return text.substr(begin);
}

} // namespace

TEST_CASE("drive writes table, resolved path and yield surface and says in one line where the path ended")
{
    const PathFolder folder;
    const ProgramResult result = folder.run("drive path.toml");
    CAPTURE(result.error);
    CHECK(result.status == 0);
    CHECK(result.error.empty());
    // p = p0 + q/3
    CHECK(contains(result.out, "15 steps, 100 s: p = 150 kPa, q = 150 kPa"));
    for (const char* name : {"path.csv", "path.toml", "yield_surface.csv"})
        CHECK(std::filesystem::exists(folder.path() / "results/path" / name));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "results/path"))
        CHECK(entry.path().extension() != ".part");
}

TEST_CASE("the resolved path is a sound path that leads to the same table")
{
    const PathFolder folder;
    REQUIRE(folder.run("drive path.toml --out first --set material.silt.critical_state_slope=1.3").status == 0);
    REQUIRE(folder.run("drive first/path.toml --out again").status == 0);
    CHECK(ProgramFolder::read(folder.path() / "again/path.csv") ==
          ProgramFolder::read(folder.path() / "first/path.csv"));
}

TEST_CASE("drive has a help with an example")
{
    const ProgramResult result = ProgramFolder().run("drive --help");
    CHECK(result.status == 0);
    CHECK(contains(result.out, "Example:\n  periporo drive "));
}

TEST_CASE("a wrong path is wrong input, with every error at its place, and writes nothing")
{
    const std::string text = with(with(silt_path, "viscosity", "viscosty"), "\"100 s\"", "\"100 m\"");
    const PathFolder folder(text);
    const ProgramResult result = folder.run("drive path.toml");
    CHECK(result.status == 2);
    for (const char* part : {"viscosty", "\"100 m\""}) {
        const LineColumn place = place_in(text, part);
        CHECK(contains(result.error,
                       "path.toml:" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": error: "));
    }
    CHECK(contains(result.error, "did you mean 'viscosity'?"));
    CHECK(contains(result.error, "2 errors; nothing was run"));
    CHECK(folder.entries() == std::set<std::string>{"path.toml"});
}

TEST_CASE("a path that is not there is wrong input")
{
    CHECK(ProgramFolder().run("drive nowhere.toml").status == 2);
}

TEST_CASE("results cannot go into a file or over the path itself")
{
    const PathFolder folder;
    CHECK(folder.run("drive path.toml --out path.toml").status == 2);
    CHECK(folder.run("drive path.toml --out .").status == 2);
    CHECK(ProgramFolder::read(folder.path() / "path.toml") == silt_path);
}

TEST_CASE("a step that fails is a failure that names place, stress, strain, state and reason")
{
    const PathFolder folder(too_much);
    const ProgramResult result = folder.run("drive path.toml --out here");
    CHECK(result.status == 1);
    for (const char* part : {"stage 1 'shear' (triaxial_drained), step 18",
                             "the path may ask for more than the material", "effective stress [Pa]: xx = ",
                             "strain [-]: xx = ", "log_preconsolidation_pressure = ", "here/failing_step.toml"}) {
        CAPTURE(part);
        CHECK(contains(result.error, part));
    }
    // what came before is kept: the header, the start and 17 steps
    const std::string table = ProgramFolder::read(folder.path() / "here/path.csv");
    CHECK(std::count(table.begin(), table.end(), '\n') == 19);
}

TEST_CASE("the failing step's file makes this step alone and fails in the same way")
{
    const PathFolder folder(too_much);
    const ProgramResult first = folder.run("drive path.toml --out here");
    REQUIRE(first.status == 1);
    const ProgramResult again = folder.run("drive here/failing_step.toml --out there");
    CHECK(again.status == 1);
    CHECK(contains(again.error, "stage 1 (mixed), step 1"));
    CHECK(contains(again.error, "the path may ask for more than the material"));
    // the same start, to the last bit: but for the comment and the title, the file that it leaves is the same
    const std::string step = ProgramFolder::read(folder.path() / "here/failing_step.toml");
    CHECK(without_first_lines(ProgramFolder::read(folder.path() / "there/failing_step.toml"), 3) ==
          without_first_lines(step, 3));
}

TEST_CASE("a failing step goes on where the stress asked for can be borne")
{
    const PathFolder folder(too_much);
    REQUIRE(folder.run("drive path.toml --out here").status == 1);
    CHECK(folder.run("drive here/failing_step.toml --out there --set stage.0.stress.zz=\"-272 kPa\"").status == 0);
}

TEST_CASE("a path that succeeds leaves no failing step of an earlier one")
{
    const PathFolder folder(too_much);
    REQUIRE(folder.run("drive path.toml --out here").status == 1);
    REQUIRE(folder.run("drive path.toml --out here --set stage.shear.deviator_stress=\"150 kPa\"").status == 0);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "here/failing_step.toml"));
}

TEST_CASE("a material without a yield surface leaves no file of one")
{
    const PathFolder folder(R"(title = "rubber"
[material.rubber]
model = "linear_elastic"
bulk_modulus = "1 MPa"
shear_modulus = "0.5 MPa"
[initial]
pressure = 0
[[stage]]
type = "isotropic"
pressure = "1 kPa"
duration = 1
)");
    CHECK(folder.run("drive path.toml --out here").status == 0);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "here/yield_surface.csv"));
}

TEST_CASE("every shipped path runs to its end without a warning")
{
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PERIPORO_SOURCE_DIR "/cases/material")) {
        // What ends in _base.toml is included by others and is no path by itself.
        if (entry.path().extension() != ".toml" || entry.path().filename().string().ends_with("_base.toml"))
            continue;
        ++count;
        const ProgramResult result = ProgramFolder().run("drive '" + entry.path().string() + "' --out here");
        CAPTURE(entry.path().string());
        CAPTURE(result.error);
        CHECK(result.status == 0);
        CHECK(result.error.empty());
    }
    CHECK(count > 0);
}
