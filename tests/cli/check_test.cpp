// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `check` finds what a run would find: both end with status 2, the same place and nothing on the disk.
#include "check_support.hpp"

using namespace periporo::test;

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

TEST_CASE("bodies that touch and have no contact pass through each other")
{
    const auto two = [](const std::string& origin, const std::string& contact) {
        return with(standing, "[[contact]]",
                    "[body.other]\nmaterial = \"rubber\"\ngeometry = { generator = 'box', size = ['100 mm', '100 mm', "
                    "'100 mm'], origin = [0, 0, '" +
                        origin + "'] }\n" + contact + "[[contact]]");
    };
    const std::string pair =
        "[[contact]]\nlaw = \"short_range\"\nbetween = [\"block\", \"other\"]\nmodulus = \"1 MPa\"\n"
        "friction = 0.5\nrestitution = 0.5\n";
    CHECK(contains(warning(two("100 mm", "")),
                   "bodies 'block' and 'other' touch, their nearest points 1 spacings apart"));
    CHECK_FALSE(contains(warning(two("100 mm", pair)), "touch"));
    CHECK_FALSE(contains(warning(two("150 mm", "")), "touch"));
}

TEST_CASE("a body whose bonds carry no stress is a warning")
{
    CHECK(contains(of_standing("--set discretization.horizon=1.2"), "bonds of body 'block' carry no stress"));
    CHECK(contains(of_standing("--set discretization.horizon=1.42"), "bonds of body 'block' carry no stress"));
    CHECK_FALSE(contains(of_standing("--set discretization.horizon=1.6"), "carry no stress"));
    const std::string sheet =
        with(standing, "size = [\"100 mm\", \"100 mm\", \"100 mm\"]", "size = [\"100 mm\", \"100 mm\", \"25 mm\"]");
    CHECK(contains(warning(sheet), "bonds of body 'block' carry no stress"));
}

TEST_CASE("boundaries that hold a point at two speeds are told with both")
{
    const auto both = [](const std::string& one, const std::string& other) {
        return standing + "[[boundary]]\nplane = \"z = 30 mm\"\n" + one + "\n[[boundary]]\nplane = \"z = 30 mm\"\n" +
               other + "\n";
    };
    const std::string fixed = "type = \"fixed\"", moving = "type = \"moving\"\nvelocity = [0, 0, \"1 m/s\"]";
    const std::string message = refusal(both(fixed, moving), "[[stage]]");
    CHECK(contains(message,
                   "is held twice along (0, 0, 1): at 1 m/s by boundary.1 (moving), and at 0 m/s by boundary.0"));
    const std::string roller = "type = \"roller\"\ndirection = [0, 0, 1]";
    CHECK_FALSE(contains(warning(both(roller, "type = \"fixed\"\nbody = \"block\"")), "held"));
}

TEST_CASE("what moves or presses faster and harder than a body can take is a warning")
{
    CHECK(contains(of_standing("--set body.block.water.type=uniform --set body.block.water.suction=\"100 MPa\" "
                               "--set body.block.water.saturation=1"),
                   "more than its bulk modulus"));
    CHECK(contains(
        warning(with(standing, "[[contact]]",
                     "[obstacle.plate]\nvelocity = [0, 0, \"-100 m/s\"]\ngeometry = { generator = 'box', size = "
                     "['1 m', '1 m', '10 mm'], origin = [0, 0, '1 m'] }\n[[contact]]\nlaw = \"penalty\"\nbetween "
                     "= [\"block\", \"plate\"]\nmodulus = \"1 MPa\"\nfriction = 0.5\nrestitution = 0.5\n[[contact]]")),
        "obstacle 'plate' moves at 100 m/s, faster than a wave"));
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
    CHECK(warning(standing).empty());
}

TEST_CASE("without an output the warning says what is lost and what to add")
{
    const std::string told = warning(small_case.substr(0, small_case.find("[[output]]")));
    CHECK(contains(told, "neither snapshots nor a history"));
    CHECK(contains(told, "  [[output]]\n  writer = \"hdf5\"\n  every = \"20 ms\""));
}

TEST_CASE("all parts that cannot be built are told at once, in the order of the case")
{
    const auto thin = [](const std::string& name, const std::string& width) {
        return "[body." + name + "]\nmaterial = \"rubber\"\ngeometry = { generator = 'box', size = ['" + width +
               "', '100 mm', '100 mm'], origin = [1, 0, 0] }\n";
    };
    const ProgramFolder folder;
    folder.write("case.toml",
                 with(with(with(standing, "material = \"rubber\"\n[[contact]]",
                                "material = \"rubber\"\nwater = { type = 'field', file = 'a.csv', saturation = "
                                "0.1 }\n[[contact]]"),
                           "[[contact]]", thin("one", "0.3 mm") + thin("two", "0.2 mm") + "[[contact]]"),
                      "[[output]]\nwriter = \"hdf5\"",
                      "[[stage.water]]\nbody = 'block'\ntype = 'field'\nfile = 'b.csv'\n"
                      "saturation = 0.2\n[[output]]\nwriter = \"hdf5\""));
    folder.write("a.csv", "x [m],y [m],z [m],suction [Pa]\n0,0,0,abc\n");
    folder.write("b.csv", "x [m],y [m],z [m],suction [Pa]\n0,0,0,-5\n");
    for (const std::string command : {"check case.toml", "run case.toml --quiet --out results"}) {
        const ProgramResult result = folder.run(command);
        CAPTURE(result.error);
        CHECK(result.status == 2);
        CHECK(contains(result.error, "4 errors; nothing was run"));
        std::size_t last = 0;
        for (const char* part :
             {"a.csv: line 2", "b.csv: line 2", "body 'one': box cannot", "body 'two': box cannot"}) {
            CAPTURE(part);
            const std::size_t at = result.error.find(part);
            REQUIRE(at != std::string::npos);
            CHECK(at >= last);
            last = at;
        }
    }
}

TEST_CASE("all that is wrong with a model is told at once")
{
    const std::string error =
        refusal(with(with(with_symmetry("x = 30 mm", "10 mm"), "friction = 0.5", "friction = 1e300"),
                     "[discretization]", "gravity = [0, 0, 9.81]\n[discretization]"),
                "\"x = 30 mm\"");
    CHECK(contains(error, "no surface has that"));
    CHECK(contains(error, "nothing holds body 'block'"));
    CHECK(contains(error, "3 errors"));
}

TEST_CASE("a plugin that refuses a table, one that refuses a mesh and a contact out of place are told at once")
{
    const ProgramFolder folder;
    folder.write("case.toml",
                 with(with(with(standing, box, "geometry = { generator = 'surface_mesh', file = 'm.stl' }"),
                           "shear_modulus = \"0.5 MPa\"\n",
                           "shear_modulus = \"0.5 MPa\"\nretention = { curve = 'table', file = 'c.csv' }\n"),
                      "[\"block\"]", "[\"block\", \"block\"]"));
    folder.write("m.stl", "solid x\nfacet nonsense\n");
    folder.write("c.csv", "suction [Pa],saturation\n0,1\n2000,1.5\n");
    const std::string error = folder.run("check case.toml").error;
    CHECK(contains(error, "m.stl: "));
    CHECK(contains(error, "c.csv: line 3"));
    CHECK(contains(error, "3 errors"));
}

TEST_CASE("fields of all writers that there are not")
{
    const std::string error =
        refusal_of_change("writer = \"hdf5\"\n", "writer = \"hdf5\"\nfields = ['veloc', 'nix']\n", "['veloc'");
    CHECK(contains(error, "there is no field 'veloc'"));
    CHECK(contains(error, "there is no field 'nix'"));
}

TEST_CASE("a path that is refused is told with its key")
{
    const auto told = [](const std::string& text, const std::string& words) {
        const ProgramFolder folder;
        folder.write("case.toml", text);
        const ProgramResult result = folder.run("check case.toml");
        CAPTURE(text);
        CAPTURE(result.error);
        CHECK(contains(result.error, "case.toml:"));
        CHECK(contains(result.error, words));
        return result.status;
    };
    CHECK(told("include = 5\n" + standing, "'include' must be a list of texts, not a whole number, 5") == 2);
    CHECK(told("include = [\"\"]\n" + standing, "'include' names no file: the text is empty") == 2);
    CHECK(told("include = [\"none.toml\"]\n" + standing, "'include' names \"none.toml\", which cannot be read") == 2);
    CHECK(told("include = [\"" + std::string(300, 'x') + "\"]\n" + standing, "File name too long") == 2);
    CHECK(told(standing + "[plugins]\npaths = [\"\"]\n", "'paths' of [plugins] names no folder") == 2);
    CHECK(told(standing + "[plugins]\npaths = 7\n", "'paths' must be a list of texts, not a whole number, 7") == 2);
    CHECK(told(standing + "[plugins]\npaths = [\"none\"]\n", "/none") == 0);
    CHECK(told(with(standing, box, "geometry = { generator = 'surface_mesh', file = '' }"), "'file' names no file") ==
          2);
}

TEST_CASE("on a terminal the check shows what it is at")
{
    const ProgramFolder folder;
    folder.write("case.toml", standing);
    // script(1) gives the program a terminal.
    folder.write("look.sh", "script -qec \"'" PERIPORO_PROGRAM "' check case.toml\" /dev/null > shown\n");
    folder.run("--version > /dev/null; sh look.sh");
    const std::string shown = ProgramFolder::read(folder.path() / "shown");
    CHECK(contains(shown, "looking at 64 points"));
    CHECK(contains(shown, "estimating the stable step"));
    CHECK(contains(shown, "no errors"));
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
