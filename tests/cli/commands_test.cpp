// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The commands: exit status, what they say, where they write.
#include "cli/program.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <chrono>

using namespace periporo::test;

namespace {

/// A folder with the small case in `case.toml`.
class CaseFolder : public ProgramFolder {
public:
    CaseFolder() { write("case.toml", small_case); }
};

} // namespace

TEST_CASE("the version is printed on request")
{
    const ProgramResult result = ProgramFolder().run("--version");
    CHECK(result.status == 0);
    CHECK(result.out.starts_with("periporo "));
}

TEST_CASE("every command has a help with an example")
{
    for (const std::string command : {"", "run", "check", "explain", "inspect", "schema", "drive", "new"}) {
        CAPTURE(command);
        const ProgramResult result = ProgramFolder().run(command + " --help");
        CHECK(result.status == 0);
        CHECK(contains(result.out, "Example:\n  periporo "));
    }
}

TEST_CASE("what the command line does not know is wrong input")
{
    for (const std::string arguments :
         {"", "walk", "run", "run case.toml --thread 2", "run case.toml --threads 0", "run case.toml --threads two",
          "run case.toml --resume --overwrite", "check case.toml other.toml"}) {
        CAPTURE(arguments);
        const CaseFolder folder;
        const ProgramResult result = folder.run(arguments);
        CHECK(result.status == 2);
        CHECK_FALSE(result.error.empty());
        CHECK(folder.entries() == std::set<std::string>{"case.toml"});
    }
}

TEST_CASE("a place that cannot be written is told before anything is computed, with the way out, and nothing is left")
{
    struct Place {
        const char* arguments;
        const char* words;
    };
    for (const Place& place : std::vector<Place>{
             {"run case.toml --out /proc/none", "cannot make the folder /proc/none: No such file or directory; choose"},
             {"run case.toml --out /proc/none/deep", "cannot make the folder"},
             {"run case.toml --out case.toml/out", "cannot make the folder case.toml/out: Not a directory; choose"},
             {"run case.toml --out ''", "the name is empty"},
             {"run case.toml --out=", "--out"},
             {"drive path.toml --out ''", "the name is empty"},
             {"new material mine --out ''", "the name is empty"},
             {"explain case.toml --picture /nonexistent/a.svg", "there is no folder /nonexistent; make it or choose"},
             {"explain case.toml --picture /proc/a.svg", "cannot write /proc/a.svg"},
             {"explain case.toml --picture folder.svg", "it is a folder"},
             {"run case.toml --plugin-path /nope", "there is no folder \"/nope\""},
             {"inspect --plugin-path /nope", "there is no folder \"/nope\""},
             {"check case.toml --plugin-path case.toml", "there is no folder \"case.toml\""},
             {"schema --plugin-path ''", "there is no folder"}}) {
        CAPTURE(place.arguments);
        const CaseFolder folder;
        std::filesystem::create_directory(folder.path() / "folder.svg");
        const ProgramResult result = folder.run(place.arguments);
        CAPTURE(result.error);
        CHECK(result.status == 2);
        CHECK(contains(result.error, place.words));
        CHECK_FALSE(contains(result.error, "points"));
        CHECK_FALSE(contains(result.error, "taken the folder away"));
        CHECK(result.out.empty());
        CHECK(folder.entries() == std::set<std::string>{"case.toml", "folder.svg"});
    }
}

TEST_CASE("folders that are missing are made for a run, and a try leaves none of them when the case is refused")
{
    const CaseFolder folder;
    CHECK(folder.run("run case.toml --quiet --out a/b/c").status == 0);
    CHECK(std::filesystem::exists(folder.path() / "a/b/c/results.h5"));
    CHECK(folder.run("run case.toml --quiet --out d/e/ --set 'time.step=1 s'").status == 2);
    CHECK(folder.entries() == std::set<std::string>{"a", "case.toml"});
}

TEST_CASE("what cannot be written to the standard output is told, and no command is done without it")
{
    const CaseFolder folder;
    for (const char* command : {"check case.toml", "explain case.toml", "inspect", "schema", "--help", "--version"}) {
        CAPTURE(command);
        folder.write("full.sh",
                     fmt::format("'" PERIPORO_PROGRAM "' {} > /dev/full 2> error; echo $? > status", command));
        std::system(("cd '" + folder.path().string() + "' && sh full.sh").c_str());
        const std::string error = ProgramFolder::read(folder.path() / "error");
        CAPTURE(error);
        CHECK(ProgramFolder::read(folder.path() / "status") == "1\n");
        CHECK(contains(error, "cannot write to the standard output"));
    }
}

TEST_CASE("a case file that is no UTF-8 is told to be saved as UTF-8")
{
    std::string wide = "\xff\xfe", wide_without_mark;
    for (const char letter : small_case) {
        wide += {letter, '\0'};
        wide_without_mark += {letter, '\0'};
    }
    for (const std::string& text : {wide, wide_without_mark, "title = \"caf\xe9\"\n" + small_case, small_case + '\0'}) {
        const ProgramFolder folder;
        folder.write("case.toml", text);
        folder.write("includes.toml", "include = [\"case.toml\"]\n");
        for (const char* name : {"case.toml", "includes.toml"}) {
            const ProgramResult result = folder.run(std::string("check ") + name);
            CAPTURE(result.error);
            CHECK(result.status == 2);
            CHECK((contains(result.error, "save it as UTF-8") || contains(result.error, "save the file as UTF-8")));
        }
    }
}

TEST_CASE("a number of steps that none is wrong input, in plain words")
{
    const CaseFolder folder;
    for (const std::string steps : {"0", "-1", "abc", "1e3", "1.5", "99999999999999999999999", "''"}) {
        CAPTURE(steps);
        const ProgramResult result = folder.run("run case.toml --stop-after " + steps);
        CAPTURE(result.error);
        CHECK(result.status == 2);
        CHECK(contains(result.error, "a whole number from 1"));
        CHECK(result.error.size() < 200); // no number of 309 digits
        CHECK(folder.entries() == std::set<std::string>{"case.toml"});
    }
}

TEST_CASE("a number of threads that no machine has is wrong input, in the option and in the environment")
{
    const CaseFolder folder;
    for (const std::string command : {"run", "explain"})
        for (const std::string threads : {"0", "-1", "100000", "1e3", "9999999999999"}) {
            CAPTURE(threads);
            const ProgramResult result = folder.run(command + " case.toml --threads " + threads);
            CHECK(result.status == 2);
            CHECK(contains(result.error, "no number of threads; give 1 to "));
            CHECK(result.error.size() < 200);
        }
    folder.write("many.sh", "OMP_NUM_THREADS=100000 '" PERIPORO_PROGRAM "' run case.toml\n");
    const ProgramResult result = folder.run("--version > /dev/null; sh many.sh");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "OMP_NUM_THREADS asks for 100000 threads"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml", "many.sh"});
}

TEST_CASE("neither the program nor its plugins take libraries from the working folder")
{
    const CaseFolder folder;
    // each would end the program or its plugin, if it were tried
    for (const char* library : {"libfmt.so.9", "libgomp.so.1", "libstdc++.so.6", "libgmp.so.10", "libmpfr.so.6",
                                "libhdf5_serial.so.103", "libperiporo_sdk.so"})
        folder.write(library, "no library");
    CHECK(folder.run("--version").status == 0);
    const ProgramResult result = folder.run("inspect surface_mesh"); // CGAL's plugin needs gmp and mpfr
    CHECK_MESSAGE(result.status == 0, result.error);
}

TEST_CASE("a pipe in place of a case is wrong input")
{
    const ProgramFolder folder;
    REQUIRE(mkfifo((folder.path() / "pipe.toml").c_str(), 0600) == 0);
    const ProgramResult result = folder.run("check pipe.toml");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "it is no regular file"));
}

TEST_CASE("a case that is not there is wrong input")
{
    const ProgramResult result = ProgramFolder().run("run nowhere.toml");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "nowhere.toml: error: cannot read the case: no such file"));
}

TEST_CASE("check accepts a sound case and writes nothing")
{
    const CaseFolder folder;
    folder.write("case.toml", with(small_case, "\"-1 m\"", "0")); // it stands on its floor
    const ProgramResult result = folder.run("check case.toml");
    CHECK(result.status == 0);
    CHECK(result.out == "case.toml: no errors\n");
    CHECK(result.error.empty());
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
}

TEST_CASE("check shows warnings and still accepts")
{
    const CaseFolder folder;
    const ProgramResult result = folder.run("check case.toml --set discretization.horizon=3");
    CHECK(result.status == 0);
    CHECK(contains(result.error, "--set discretization.horizon=3: warning: "));
}

TEST_CASE("a repeated option does not swallow the case, wherever it stands")
{
    const CaseFolder folder;
    CHECK(folder.run("check --set time.safety=0.5 --set \"title=two words\" case.toml").status == 0);
    CHECK(folder.run("check --plugin-path . case.toml").status == 0);
}

TEST_CASE("the path of a case may hold a space")
{
    const ProgramFolder folder;
    folder.write("my case.toml", small_case);
    CHECK(folder.run("check 'my case.toml'").status == 0);
}

TEST_CASE("explain names bodies and stages and writes nothing")
{
    const CaseFolder folder;
    const ProgramResult result = folder.run("explain case.toml");
    CHECK(result.status == 0);
    CHECK(contains(result.out, "block"));
    CHECK(contains(result.out, "64 points")); // 100 mm/25 mm along each edge
    CHECK(contains(result.out, "memory: "));
    CHECK(contains(result.out, "fall"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
}

TEST_CASE("explain tells size, memory and a range of time of any case in seconds, also of one that does not fit")
{
    const CaseFolder folder;
    for (const std::string spacing : {"0.5 mm", "1 um"}) {
        CAPTURE(spacing);
        const auto began = std::chrono::steady_clock::now();
        const ProgramResult result =
            folder.run("explain case.toml --threads 2 --set 'discretization.spacing=" + spacing + "'");
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        CHECK(result.status == 0);
        CHECK(contains(result.out, spacing == "1 um" ? "about 1e+15 points" : "about 8e+06 points"));
        CHECK(contains(result.out, "kept, up to"));
        CHECK((contains(result.out, "does not fit") || spacing != "1 um"));
        CHECK(contains(result.out, " for the dynamic stages on 2 threads, as measured at a spacing of "));
        CHECK(took.count() < 20.0); // 5 s where the machine has nothing else to do
    }
}

TEST_CASE("run writes into results/<name of the case> when nothing else is said")
{
    const CaseFolder folder;
    const ProgramResult result = folder.run("run case.toml --quiet --threads 1");
    CAPTURE(result.error);
    CHECK(result.status == 0);
    CHECK(std::filesystem::is_directory(folder.path() / "results/case"));
}

TEST_CASE("run keeps a resolved copy of the case that is a sound case itself")
{
    const CaseFolder folder;
    REQUIRE(folder.run("run case.toml --out here --quiet --set time.safety=0.5").status == 0);
    const ProgramResult again = folder.run("check here/case.toml");
    CHECK(again.status == 0);
    CHECK(contains(ProgramFolder::read(folder.path() / "here/case.toml"), "safety = 0.5"));
}

TEST_CASE("run does not write over earlier results unless it is told to")
{
    const CaseFolder folder;
    REQUIRE(folder.run("run case.toml --out here --quiet").status == 0);
    const std::string log = ProgramFolder::read(folder.path() / "here/run.log");

    const ProgramResult refused = folder.run("run case.toml --out here --quiet");
    CHECK(refused.status == 2);
    CHECK(contains(refused.error, "--resume"));
    CHECK(contains(refused.error, "--overwrite"));
    CHECK(ProgramFolder::read(folder.path() / "here/run.log") == log);

    folder.write("here/history.csv.damaged", "of an earlier run");
    CHECK(folder.run("run case.toml --out here --quiet --overwrite").status == 0);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "here/history.csv.damaged"));
}

TEST_CASE("overwrite with a wrong case deletes nothing")
{
    const CaseFolder folder;
    REQUIRE(folder.run("run case.toml --out here --quiet").status == 0);
    const std::string log = ProgramFolder::read(folder.path() / "here/run.log");
    CHECK(folder.run("run case.toml --out here --quiet --overwrite --set time.safty=1").status == 2);
    CHECK(ProgramFolder::read(folder.path() / "here/run.log") == log);
}

TEST_CASE("overwrite spares a folder that holds something else")
{
    const CaseFolder folder;
    folder.write("thesis/chapter.txt", "years of work");
    const ProgramResult result = folder.run("run case.toml --out thesis --overwrite");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "does not look like results"));
    CHECK(std::filesystem::exists(folder.path() / "thesis/chapter.txt"));
}

TEST_CASE("there is nothing to resume in a folder that is not there")
{
    const CaseFolder folder;
    const ProgramResult result = folder.run("run case.toml --out here --resume");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "holds no run to resume"));
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
}

TEST_CASE("results cannot go into a file")
{
    const CaseFolder folder;
    CHECK(folder.run("run case.toml --out case.toml").status == 2);
    CHECK(ProgramFolder::read(folder.path() / "case.toml") == small_case);
}

TEST_CASE("inspect lists the shipped plugins by kind")
{
    const ProgramResult result = ProgramFolder().run("inspect");
    CHECK(result.status == 0);
    for (const char* part : {"geometry\n", "material\n", "contact\n", "output\n", "box", "cylinder", "linear_elastic",
                             "viscoplastic_critical_state", "rigid_plane", "short_range", "hdf5", "csv"}) {
        CAPTURE(part);
        CHECK(contains(result.out, part));
    }
}

TEST_CASE("inspect shows every parameter of a plugin with unit, range, default and meaning")
{
    const ProgramResult result = ProgramFolder().run("inspect linear_elastic");
    CHECK(result.status == 0);
    CHECK(contains(result.out, "material linear_elastic: "));
    CHECK(contains(result.out, "provided by /"));
    const std::size_t begin = result.out.find("bulk_modulus");
    REQUIRE(begin != std::string::npos);
    const std::string line = result.out.substr(begin, result.out.find('\n', begin) - begin);
    CHECK(contains(line, "Pa"));
    CHECK(contains(line, "> 0"));
    CHECK(contains(line, "required"));
}

TEST_CASE("inspect of an unknown plugin is wrong input and suggests the nearest")
{
    const ProgramResult result = ProgramFolder().run("inspect linear_elastik");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "did you mean 'linear_elastic'?"));
}

TEST_CASE("inspect tells of a library that was refused, and why")
{
    const ProgramFolder folder;
    folder.write("lib/periporo_material_broken.so", "no library at all");
    const ProgramResult result = folder.run("inspect --plugin-path lib");
    CHECK(result.status == 0);
    CHECK(contains(result.out, "refused\n"));
    CHECK(contains(result.out, "periporo_material_broken.so: "));
}

TEST_CASE("the page of reference has a row for every parameter that the list for machines has")
{
    const ProgramFolder folder;
    const ProgramResult page = folder.run("inspect --markdown");
    const ProgramResult list = folder.run("inspect --json");
    CHECK(page.status == 0);
    CHECK(list.status == 0);
    std::size_t parameters = 0;
    for (const nlohmann::json& plugin : nlohmann::json::parse(list.out)) {
        const std::string heading = "\n### " + plugin["name"].get<std::string>() + "\n";
        CAPTURE(heading);
        const std::size_t begin = page.out.find(heading);
        REQUIRE(begin != std::string::npos);
        const std::size_t end = page.out.find("\n### ", begin + heading.size());
        const std::string section = page.out.substr(begin, end - begin);
        for (const nlohmann::json& parameter : plugin["parameters"]) {
            CHECK(contains(section, "\n| `" + parameter["name"].get<std::string>() + "` | "));
            ++parameters;
        }
    }
    CHECK(parameters > 20); // the shipped plugins have more
}

TEST_CASE("inspect for machines gives the type of a default")
{
    const ProgramResult result = ProgramFolder().run("inspect viscoplastic_critical_state --json");
    CHECK(result.status == 0);
    const nlohmann::json plugins = nlohmann::json::parse(result.out);
    REQUIRE(plugins.size() == 1);
    CHECK(plugins[0]["kind"] == "material");
    for (const nlohmann::json& parameter : plugins[0]["parameters"])
        if (parameter["name"] == "tensile_strength") {
            CHECK(parameter["unit"] == "Pa");
            CHECK(parameter["default"] == 0.0);
            CHECK(parameter["required"] == false);
            return;
        }
    FAIL("the parameter tensile_strength is not listed");
}
