// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A run knows what it has read: hashes in the results, and a resume only with the same content.
#include "cli/program.hpp"
#include "unit/output/result_content.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace periporo::test;

namespace {

/// The small case with water from a file, under a curve from another one, long enough to be stopped.
std::string case_of_files()
{
    return with(with(with(small_case, "material = \"rubber\"\n",
                          "material = \"rubber\"\nwater = { type = \"field\", file = \"water.csv\" }\n"),
                     "shear_modulus = \"0.5 MPa\"\n",
                     "shear_modulus = \"0.5 MPa\"\nretention = { curve = \"table\", file = \"curve.csv\" }\n"),
                "duration = \"1 ms\"", "duration = \"20 ms\"");
}

void write_files(const ProgramFolder& folder)
{
    folder.write("case.toml", "include = [\"base.toml\"]\n");
    folder.write("base.toml", case_of_files());
    folder.write("water.csv", "x [m],y [m],z [m],suction [Pa]\n0,0,0,1000\n");
    folder.write("curve.csv", "suction [Pa],saturation\n0,1\n2000,0.5\n10000,0.1\n");
}

/// Stops a run in `it` once it has a few rows of history.
void stop_a_run(const ProgramFolder& folder)
{
    REQUIRE(
        folder.run("run case.toml --quiet --threads 1 --out it --set 'run.history_every=1 us' --stop-after 5").status ==
        130);
}

const std::string resume = "run case.toml --quiet --threads 1 --out it --set 'run.history_every=1 us' --resume";

} // namespace

TEST_CASE("results hold the SHA-256 of the case, its includes, tables, plugins and the program")
{
    const ProgramFolder folder;
    write_files(folder);
    REQUIRE(folder.run("run case.toml --quiet --threads 1 --out it").status == 0);
    const auto summary = nlohmann::json::parse(ProgramFolder::read(folder.path() / "it/summary.json"));
    const auto& provenance = summary["provenance"];
    for (const char* key : {"file_case", "file_include_1", "file_body.block.water.file",
                            "file_material.rubber.retention.file", "plugin_geometry_box",
                            "plugin_material_linear_elastic", "plugin_contact_rigid_plane", "plugin_retention_table",
                            "plugin_output_csv", "plugin_output_hdf5", "program", "library_libperiporo_sdk.so"}) {
        CAPTURE(key);
        REQUIRE(provenance.contains(key));
        CHECK(provenance[key].get<std::string>().find(" sha256 ") != std::string::npos);
    }
    CHECK_FALSE(provenance.contains("plugin_geometry_sphere")); // loaded, but not used
    // sha256sum of "include = [\"base.toml\"]\n"
    const std::string of_case = provenance["file_case"].get<std::string>();
    folder.write("sum.sh", "sha256sum case.toml | cut -d ' ' -f 1 > sum.txt\n");
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && sh sum.sh").c_str()) == 0);
    CHECK(of_case.ends_with(ProgramFolder::read(folder.path() / "sum.txt").substr(0, 64)));
    CHECK(content_of(folder.path() / "it/results.h5").count("/provenance/file_body.block.water.file") == 1);
}

TEST_CASE("a resume with another content of a table is refused naming the file, and goes on when it is brought back")
{
    const ProgramFolder folder;
    write_files(folder);
    stop_a_run(folder);
    for (const std::string file : {"water.csv", "curve.csv"}) {
        CAPTURE(file);
        const std::string before = ProgramFolder::read(folder.path() / file);
        const std::string log = ProgramFolder::read(folder.path() / "it/run.log");
        folder.write(file, before + "\n");
        const ProgramResult refused = folder.run(resume);
        CHECK(refused.status == 2);
        CHECK(contains(refused.error, file));
        CHECK(contains(refused.error, "has changed since the run was started"));
        CHECK(ProgramFolder::read(folder.path() / "it/run.log") == log);
        folder.write(file, before);
    }
    folder.write("base.toml", case_of_files() + "# a comment means nothing\n");
    CHECK(folder.run(resume).status == 0);
}

TEST_CASE("the resolved case of a result runs again to the same bits")
{
    const ProgramFolder folder;
    write_files(folder);
    const std::string run = " --quiet --threads 1 ";
    REQUIRE(folder.run("run case.toml --out first" + run + "--set time.safety=0.7").status == 0);
    REQUIRE(folder.run("run first/case.toml --out again" + run).status == 0);
    CHECK(ProgramFolder::read(folder.path() / "first/case.toml") ==
          ProgramFolder::read(folder.path() / "again/case.toml"));
    CHECK(ProgramFolder::read(folder.path() / "first/history.csv") ==
          ProgramFolder::read(folder.path() / "again/history.csv"));
    auto first = content_of(folder.path() / "first/results.h5");
    auto again = content_of(folder.path() / "again/results.h5");
    for (auto* content : {&first, &again}) // the case file is another one
        std::erase_if(*content, [](const auto& entry) { return entry.first.starts_with("/provenance/file_"); });
    CHECK(first == again);
}
