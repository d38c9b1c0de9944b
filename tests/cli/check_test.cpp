// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `check` finds what a run would find: both end with status 2, the same place and nothing on the disk.
#include "cli/program.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace periporo::test;

namespace {

const std::string box = "geometry = { generator = \"box\", size = [\"100 mm\", \"100 mm\", \"100 mm\"] }";

/// The error that both commands report on a case, whose place is where `at` begins.
std::string refusal(const std::string& text, const std::string& at)
{
    const ProgramFolder folder;
    folder.write("case.toml", text);
    const LineColumn place = place_in(text, at);
    std::string first;
    for (const std::string command : {"check case.toml", "run case.toml --quiet --out results"}) {
        const ProgramResult result = folder.run(command);
        CAPTURE(command);
        CAPTURE(result.error);
        CHECK(result.status == 2);
        CHECK(contains(result.error, fmt::format("case.toml:{}:{}: error: ", place.line, place.column)));
        CHECK(folder.entries() == std::set<std::string>{"case.toml"});
        if (first.empty())
            first = result.error;
        // The beginning says it; available memory, further on, changes from second to second.
        CHECK(contains(result.error, first.substr(first.find("error: "), 60)));
    }
    return first;
}

std::string refusal_of_change(const std::string& from, const std::string& to, const std::string& at)
{
    return refusal(with(small_case, from, to), at);
}

/// What `check` says of a case that it accepts.
std::string warning(const std::string& text)
{
    const ProgramFolder folder;
    folder.write("case.toml", text);
    const ProgramResult result = folder.run("check case.toml");
    CHECK(result.status == 0);
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
    return result.error;
}

const std::string settle = "[[stage]]\nname = \"settle\"\ntype = \"quasi_static\"\n[[stage]]\nname = \"fall\"\n";

} // namespace

TEST_CASE("a geometry that the spacing does not fill")
{
    CHECK(contains(refusal_of_change("\"25 mm\"", "\"250 mm\"", "{ generator"), "body 'block'"));
}

TEST_CASE("two writers of the same files")
{
    const std::string text = with(small_case, "writer = \"csv\"", "writer = 'hdf5'");
    CHECK(contains(refusal(text, "'hdf5'"), "both write the same files"));
}

TEST_CASE("a field that there is not, and one that is named twice")
{
    const std::string writer = "writer = \"hdf5\"\n";
    CHECK(contains(refusal_of_change(writer, writer + "fields = [\"velocty\"]\n", "[\"velocty\"]"),
                   "did you mean 'velocity'?"));
    CHECK(contains(refusal_of_change(writer, writer + "fields = [\"velocity\", \"velocity\"]\n", "[\"velocity\""),
                   "named twice"));
}

TEST_CASE("more snapshots than any disk holds")
{
    const std::string text =
        with(small_case, "writer = \"csv\"\nevery = \"1 ms\"", "writer = \"csv\"\nevery = '1e-12 s'");
    CHECK(contains(refusal(text, "'1e-12 s'"), "1e+09 snapshots"));
}

TEST_CASE("a body below its floor, as a whole or in part, and a normal that points into the body")
{
    CHECK(contains(refusal_of_change("[0, 0, \"-1 m\"]", "[0, 0, \"1 m\"]", "[[contact]]"),
                   "64 of the 64 points of body 'block' begin below the surface"));
    CHECK(contains(refusal_of_change("[0, 0, \"-1 m\"]", "[0, 0, \"40 mm\"]", "[[contact]]"), "32 of the 64 points"));
    CHECK(contains(refusal_of_change("normal = [0, 0, 1]", "normal = [0, 0, -1]", "[[contact]]"), "turn its normal"));
}

TEST_CASE("a body in an obstacle, but not one that touches it")
{
    const std::string plane =
        "law = \"rigid_plane\"\nbetween = [\"block\"]\npoint = [0, 0, \"-1 m\"]\nnormal = [0, 0, 1]\n";
    const auto on_stone = [&](const std::string& height) {
        return with(with(small_case, plane, "law = \"penalty\"\nbetween = [\"block\", \"stone\"]\n"), "[[stage]]",
                    "[obstacle.stone]\ngeometry = { generator = 'box', size = ['100 mm', '100 mm', '" + height +
                        "'], origin = [0, 0, '-100 mm'] }\n[[stage]]");
    };
    CHECK(contains(refusal(on_stone("160 mm"), "[[contact]]"), "inside obstacle 'stone'"));
    CHECK_FALSE(contains(warning(on_stone("100 mm")), "inside"));
}

TEST_CASE("gravity that leads away from the only surface, and a quasi-static stage that nothing ends")
{
    const std::string upwards = "gravity = [0, 0, 9.81]\n[discretization]";
    CHECK(contains(refusal_of_change("[discretization]", upwards, "[0, 0, 9.81]"), "nothing holds body 'block'"));
    const std::string contact = small_case.substr(small_case.find("[[contact]]"),
                                                  small_case.find("[[stage]]") - small_case.find("[[contact]]"));
    const std::string free = with(small_case, contact, "");
    CHECK(contains(warning(free), "it falls freely"));
    CHECK(contains(refusal(with(free, "[[stage]]\nname = \"fall\"\n", settle), "[[stage]]\nname = \"settle\""),
                   "it never comes to rest"));
}

TEST_CASE("an angle for a coefficient, and a coefficient that no surface has")
{
    CHECK(contains(refusal_of_change("friction = 0.5", "friction = \"27 deg\"", "\"27 deg\""),
                   "is in units of rad, a pure number is expected"));
    CHECK(contains(refusal_of_change("friction = 0.5", "friction = 1e300", "1e300"), "no surface has that"));
    CHECK(contains(warning(with(small_case, "friction = 0.5", "friction = 27")), "87.9 degrees"));
}

TEST_CASE("bodies in one another are refused, those that hardly overlap are a warning, those that touch are sound")
{
    const auto two = [](const std::string& origin) {
        return with(small_case, "[[contact]]",
                    "[body.other]\nmaterial = \"rubber\"\ngeometry = { generator = 'box', size = ['100 mm', '100 mm', "
                    "'100 mm'], origin = [0, 0, '" +
                        origin + "'] }\n[[contact]]");
    };
    CHECK(contains(refusal(two("30 mm"), "{ generator = \"box\""), "points of body 'block' lie in body 'other'"));
    CHECK(contains(warning(two("85 mm")), "points of body 'block' lie in body 'other'"));
    CHECK_FALSE(contains(warning(two("100 mm")), "lie in body"));
}

TEST_CASE("coordinates at which points coincide")
{
    CHECK(contains(refusal_of_change(box, box.substr(0, box.size() - 2) + ", origin = [0, 0, 1e13] }", "{ generator"),
                   "coincide"));
}

TEST_CASE("one body alone with a law that has no surface")
{
    const std::string text =
        with(small_case, "law = \"rigid_plane\"\nbetween = [\"block\"]\npoint = [0, 0, \"-1 m\"]\nnormal = [0, 0, 1]\n",
             "law = \"short_range\"\nbetween = ['block']\n");
    CHECK(contains(refusal(text, "['block']"), "has no surface of its own"));
}

TEST_CASE("a law of comparison that is not known")
{
    CHECK(contains(
        refusal_of_change("[[stage]]", "[comparison]\nlaw = 'column'\nradius = 1\nheight = 1\n[[stage]]", "'column'"),
        "axisymmetric_column"));
}

TEST_CASE("a step that is not stable, which a run finds before its first step")
{
    CHECK(contains(refusal_of_change("[discretization]", "time = { step = \"1 s\" }\n[discretization]", "[[stage]]"),
                   "largest stable one"));
}

TEST_CASE("more points than there is memory, with the numbers and what to change")
{
    const std::string error = refusal_of_change("\"25 mm\"", "'1 um'", "'1 um'");
    CHECK(contains(error, "about 1e+15 points with 122 bonds each"));
    CHECK(contains(error, "--set discretization.spacing="));
}

TEST_CASE("a horizon that makes families too large is not blamed on the points")
{
    CHECK(contains(refusal_of_change("\"25 mm\"", "\"25 mm\"\nhorizon = 900.5", "900.5"),
                   "a horizon of 900.5 spacings gives a point 3.059e+09 bonds"));
}

TEST_CASE("what is suspicious is a warning")
{
    CHECK(contains(warning(with(small_case, "bulk_modulus = \"1 MPa\"", "bulk_modulus = \"1e9 mPa\"")),
                   "thousandths of a pascal"));
    CHECK(contains(warning(with(small_case, "bulk_modulus = \"1 MPa\"\nshear_modulus = \"0.5 MPa\"",
                                "bulk_modulus = 100\nshear_modulus = 50")),
                   "softer than a gel"));
    CHECK(contains(warning(with(small_case, "[discretization]", "gravity = [0, 0, 0]\n[discretization]")),
                   "nothing happens in stage 'fall'"));
    CHECK(contains(warning(small_case.substr(0, small_case.find("[[output]]"))), "there is no [[output]]"));
}

TEST_CASE("a refused run leaves the results that it was to replace")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    REQUIRE(folder.run("run case.toml --quiet --out it").status == 0);
    const std::string results = ProgramFolder::read(folder.path() / "it/history.csv");
    CHECK(folder.run("run case.toml --quiet --out it --overwrite --set contact.0.friction=1e300").status == 2);
    CHECK(ProgramFolder::read(folder.path() / "it/history.csv") == results);
}

TEST_CASE("a run that lacks memory is refused before it takes any, and one that runs out of it says so")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    folder.write("little.sh", "ulimit -v 3000000\n'" PERIPORO_PROGRAM "' \"$@\"\n");
    const ProgramResult result = folder.run("--version; sh little.sh run case.toml --quiet --threads 1 "
                                            "--set 'discretization.spacing=1 mm'");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "are available"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml", "little.sh"});
}
