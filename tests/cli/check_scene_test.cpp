// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `check` compares planes, contacts, values and stages with the bodies of a case.
#include "check_support.hpp"

using namespace periporo::test;

TEST_CASE("a symmetry plane ends a body or cuts it in the middle, half a spacing from the first points")
{
    // Points at 10, 30, 50, 70 and 90 mm.
    const std::string on_plane = refusal(with_symmetry("x = 50 mm", "20 mm"), "\"x = 50 mm\"");
    CHECK(contains(on_plane, "25 points of body 'block' lie on the symmetry plane x = 0.05 m"));
    CHECK(contains(on_plane, "50 lie beyond it, up to 0.04 m"));
    const std::string beyond = refusal(with_symmetry("x = 30 mm", "10 mm"), "\"x = 30 mm\"");
    CHECK(contains(beyond, "300 of the 1000 points of body 'block' lie beyond the symmetry plane x = 0.03 m, up to "
                           "0.025 m"));
    CHECK(contains(beyond, "400 of its points have no counterpart")); // 300 lie from 30 to 60 mm and have one below 30
    CHECK(contains(refusal(with_symmetry("x = 9 mm", "25 mm"), "\"x = 9 mm\""), "the nearest at 0.0035 m"));
    CHECK(contains(warning(with_symmetry("x = 3 mm", "25 mm")), "the nearest at 0.0095 m"));
    // Its middle and its end are sound.
    CHECK(warning(with_symmetry("x = 50 mm", "25 mm")).empty());
    CHECK(warning(with_symmetry("x = 0 mm", "25 mm")).empty());
}

TEST_CASE("a roller lies half a spacing from the first points")
{
    const std::string text = with(standing, "[[stage]]",
                                  "[[stage]]\nname = \"settle\"\ntype = \"quasi_static\"\nrollers = [\"x = 90 mm\"]\n"
                                  "[[stage]]");
    CHECK(contains(refusal(text, "[\"x = 90 mm\"]"), "lie on the roller x = 0.09 m or near to it"));
    CHECK(warning(with(text, "x = 90 mm", "x = 100 mm")).empty());
}

TEST_CASE("a periodic cell holds a body, or is filled by it")
{
    const auto pair = [](const std::string& plane, const std::string& period) {
        return with_boundary("type = \"periodic\"\nplane = \"" + plane + "\"\nperiod = \"" + period + "\"", "10 mm");
    };
    CHECK(contains(refusal(pair("x = 30 mm", "80 mm"), "\"x = 30 mm\""),
                   "300 of the 1000 points of body 'block' lie outside"));
    CHECK(contains(refusal(pair("x = 4 mm", "93 mm"), "\"93 mm\""), "only 0.003 m from each other's images"));
    CHECK(warning(pair("x = 0 mm", "80 mm")).empty());
    CHECK(warning(pair("x = 0 mm", "100 mm")).empty());
}

TEST_CASE("partners that a contact law does not heed")
{
    CHECK(contains(refusal(with(standing, "[\"block\"]", "[\"block\", \"block\"]"), "[\"block\", "),
                   "does nothing between free grains of body 'block'"));
    const std::string two = with(
        standing, "[[contact]]",
        "[body.other]\nmaterial = \"rubber\"\ngeometry = { generator = 'box', size = ['100 mm', '100 mm', '100 mm'], "
        "origin = [0, 0, '100 mm'] }\n[[contact]]");
    CHECK(contains(refusal(with(two, "[\"block\"]", "[\"block\", \"other\"]"), "[\"block\", "),
                   "by it the bodies 'block' and 'other' do not touch each other"));
    CHECK(contains(refusal(with(standing, "friction = 0.5", "friction = 0.5\ncrossing = \"warn\""), "\"warn\""),
                   "this contact has none"));
}

TEST_CASE("a contact that is given twice would count twice, but a law may have several surfaces")
{
    const std::size_t begin = standing.find("[[contact]]");
    const std::string contact = standing.substr(begin, standing.find("[[stage]]") - begin);
    const auto and_another = [&](const std::string& other) { return with(standing, "[[stage]]", other + "[[stage]]"); };
    const std::string twice = with(contact, "[\"block\"]", "['block']");
    CHECK(contains(refusal(and_another(twice), "['block']"), "came before: its forces would count twice"));
    CHECK(warning(and_another(with(contact, "normal = [0, 0, 1]", "normal = [1, 0, 0]"))).empty());
}

TEST_CASE("an obstacle that no contact names is not there for any body")
{
    const std::string text =
        with(standing, "[[stage]]",
             "[obstacle.stone]\ngeometry = { generator = 'box', size = [1, 1, 1], origin = [5, 5, 5] }"
             "\n[[stage]]");
    CHECK(contains(warning(text), "no contact names obstacle 'stone'"));
}

TEST_CASE("a value that looks like a wrong unit is a warning with what it means and what is usual")
{
    const auto told = [](const std::string& key, const std::string& value) {
        const std::string text = of_standing("--set '" + key + "=" + value + "'");
        CHECK(contains(text, "--set " + key + "=" + value + ": warning: "));
        return text;
    };
    CHECK(contains(told("gravity", "[0,0,-9810]"), "1000 times that of the earth"));
    CHECK(contains(told("material.rubber.grain_density", "2.2"), "lighter than any mineral"));
    CHECK(contains(told("material.rubber.grain_density", "2200000"), "heavier than any metal"));
    // (3 K - 2 G)/(2 (3 K + G)) = (3 - 7.2)/(2 (3 + 3.6)), for K = 1 MPa
    CHECK(contains(told("material.rubber.shear_modulus", "3.6 MPa"), "Poisson's ratio is -0.318"));
    // 1 TPa over 1600 kg/m3, under the root
    CHECK(contains(told("material.rubber.bulk_modulus", "1e12 Pa"), "waves run at 2.5e+04 m/s"));
    // C dx = 1e11 N/m over (K + 4/3 G) dx
    CHECK(contains(of_standing("--set 'contact.0.modulus=4e12 Pa'"), "2.4e+06 times that of body 'block'"));
}

TEST_CASE("a body that hangs higher above its floor than it is high")
{
    // (2 g h)^(1/2) over one metre
    CHECK(contains(warning(small_case), "begins 1 m away from all that it may touch"));
    CHECK(contains(warning(small_case), "meets it at 4.43 m/s or more"));
    CHECK(warning(with(small_case, "\"-1 m\"", "\"-80 mm\"")).empty());
    CHECK(warning(with(small_case, "[[contact]]", "velocity = [0, 0, \"-1 m/s\"]\n[[contact]]")).empty());
}

TEST_CASE("durations and times that do not fit each other")
{
    const auto told = [](const std::string& overrides, const std::string& words) {
        CAPTURE(overrides);
        CHECK(contains(of_standing(overrides), words));
    };
    const std::string longer = "--set 'stage.0.duration=0.1 s' ";
    CHECK(of_standing(longer).empty());
    told(longer + "--set 'output.0.every=1 s'", "output.0.every=1 s: warning: snapshots every 1 s of a run of 0.1 s");
    told(longer + "--set 'run.history_every=1 s'", "run.history_every=1 s: warning: rows of history every 1 s");
    told("--set 'output.0.times=[\"1 ms\", \"3 s\", \"4 s\"]'", "no snapshot is stored at 3 s, 4 s");
    told("--set 'stage.0.duration=1e6 s' --set 'output.0.every=9 s' --set 'output.1.every=9 s'", "e+09 steps of");
    told("--set 'stage.0.duration=1e-12 s'", "far less than a step");
}

TEST_CASE("stages without an effect, and a residual that no rounding allows")
{
    const std::string two = "name = \"settle\"\ntype = \"quasi_static\"\n[[stage]]\nname = \"again\"\ntype = "
                            "\"quasi_static\"\n";
    const std::string repeated = with(standing, "[[stage]]", "[[stage]]\n" + two + "[[stage]]");
    CHECK(contains(warning(repeated), "stage 'again' does nothing: 'settle' before it has settled"));
    CHECK(warning(repeated + "[[boundary]]\ntype = \"fixed\"\nplane = \"z = 20 mm\"\nstages = [\"settle\"]\n").empty());
    const std::string sharp =
        with(standing, "[[stage]]",
             "[[stage]]\nname = \"settle\"\ntype = \"quasi_static\"\nuntil = { residual = 1e-30 }\n"
             "[[stage]]");
    CHECK(contains(warning(sharp), "double precision does not reach"));
    const std::string only_settles = with(standing, "name = \"fall\"\ntype = \"dynamic\"\nduration = \"1 ms\"",
                                          "name = \"settle\"\ntype = \"quasi_static\"");
    CHECK(
        contains(warning(only_settles), "there is no dynamic stage, and writer 'hdf5' stores snapshots in those only"));
}

TEST_CASE("a list of stages that names none is refused")
{
    const std::string floor = with(standing, "[[stage]]",
                                   "[obstacle.stone]\nstages = []\ngeometry = { generator = "
                                   "\"sphere\", radius = \"10 mm\", centre = [0, 0, \"-1 m\"] "
                                   "}\n[[stage]]");
    CHECK(contains(refusal(floor, "[]"), "'stages' names no stage"));
    CHECK(contains(refusal(with(floor, "stages = []", "moves_in = []"), "[]"), "'moves_in' names no stage"));
}

TEST_CASE("two planes of one body that are the same are refused, and a plane behind another is a warning")
{
    const auto second_floor = [](const std::string& height) {
        return standing + "[[contact]]\nlaw = 'rigid_plane'\nbetween = [\"block\"]\npoint = [1, 2, \"" + height +
               "\"]\nnormal = [0, 0, 3]\nmodulus = \"2 MPa\"\nfriction = 0.1\n";
    };
    CHECK(contains(refusal(second_floor("0 mm"), "[[contact]]\nlaw = 'rigid_plane'"),
                   "the surface of contact 1 is that of contact 0"));
    CHECK(contains(warning(second_floor("-30 mm")), "contact 1 lies 0.03 m behind that of contact 0"));
    // A wall beside the body hides nothing.
    CHECK(warning(with(second_floor("0 mm"), "point = [1, 2, \"0 mm\"]\nnormal = [0, 0, 3]",
                       "point = [0, 0, 0]\nnormal = [1, 0, 0]")) == "");
}

TEST_CASE("a plate thinner than the spacing between the points of a body is a warning")
{
    const auto with_plate = [](const std::string& height) {
        return with(standing, "[[stage]]",
                    "[obstacle.plate]\ngeometry = { generator = \"box\", size = [\"80 mm\", \"80 mm\", \"2 mm\"], "
                    "origin = [\"10 mm\", \"10 mm\", \"" +
                        height +
                        "\"] }\n[[contact]]\nlaw = \"penalty\"\nbetween = [\"block\", \"plate\"]\nmodulus = \"1 "
                        "MPa\"\nfriction = 0.2\n[[stage]]");
    };
    // Points lie at 12.5, 37.5, 62.5 and 87.5 mm along each axis; the plate has 16 of their columns.
    CHECK(contains(warning(with_plate("50 mm")), "lies between points of body 'block' that are neighbours (16 pairs"));
    CHECK(warning(with_plate("112.5 mm")) == "");
}

TEST_CASE("values of soil that no soil has are warnings")
{
    CHECK(contains(of_standing("--set 'gravity=[0, 0, \"-9.81 mm/s2\"]'"), "gravity is 0.00981 m/s2"));
    CHECK(contains(of_standing("--set material.rubber.porosity=0.99"), "the porosity of material 'rubber' is 0.99"));
    CHECK(contains(of_standing("--set 'body.block.initial_stress={ type = \"geostatic\", K0 = 50 }'"),
                   "K0 of body 'block' is 50"));
    // (2 g 0.1 m)^(1/2) = 1.4 m/s
    CHECK(contains(of_standing("--set 'stage.0.until={ rest_speed = \"2 m/s\" }'"), "a fall through the height"));
    CHECK(of_standing("--set 'stage.0.until={ rest_speed = \"1 m/s\" }'") == "");
}
