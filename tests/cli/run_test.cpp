// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whole runs of the quickstart on a coarse lattice: threads, interruption, failure.
#include "cli/program.hpp"
#include "unit/output/result_content.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace periporo::test;

namespace {

/// 150 points; half a collapse.
const std::string coarse = "run " PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart.toml "
                           "--set 'discretization.spacing=20 mm' --set 'stage.1.duration=0.2 s' ";

std::map<std::string, std::string> results(const std::filesystem::path& file)
{
    std::map<std::string, std::string> content = content_of(file);
    CHECK(content.size() > 100);
    content.erase("/provenance/threads");
    return content;
}

/// Paths whose content differs.
std::set<std::string> differences(const std::map<std::string, std::string>& a,
                                  const std::map<std::string, std::string>& b)
{
    std::set<std::string> paths;
    for (const auto* side : {&a, &b})
        for (const auto& [path, value] : *side) {
            const auto in_a = a.find(path);
            const auto in_b = b.find(path);
            if (in_a == a.end() || in_b == b.end() || in_a->second != in_b->second)
                paths.insert(path);
        }
    return paths;
}

} // namespace

TEST_CASE("one and two threads end at the same bits, for every force state")
{
    const ProgramFolder folder;
    for (const std::string state : {"energy_conjugate", "volume_weighted", "bond_projection"}) {
        CAPTURE(state);
        const std::string run = coarse + "--set 'operator.force_state=" + state + "' --quiet --overwrite " +
                                R"(--set 'body.column.water={ type = "hydrostatic", water_table = "z = 55 mm", )" +
                                R"(saturation = 0.3 }' )";
        REQUIRE(folder.run(run + "--threads 1 --out one").status == 0);
        REQUIRE(folder.run(run + "--threads 2 --out two").status == 0);
        CHECK(differences(results(folder.path() / "one/results.h5"), results(folder.path() / "two/results.h5")) ==
              std::set<std::string>{});
    }
}

TEST_CASE("a run stopped three times, at first while it settles, and resumed ends at the same bits as one that was "
          "never stopped")
{
    // the column is half under water, settles for long, and the water falls while it collapses
    const std::string drying =
        coarse + R"(--set 'stage.0.until.residual=1e-9' )" +
        R"(--set 'body.column.water={ type = "hydrostatic", water_table = "z = 55 mm", saturation = 0.3 }' )" +
        R"(--set 'stage.1.water=[{ body = "column", type = "uniform", suction = "2 kPa", saturation = 0.1, )" +
        R"(over = "150 ms" }]' )";
    const ProgramFolder folder;
    REQUIRE(folder.run(drying + "--quiet --threads 1 --out whole").status == 0);
    const auto stopped = [&](const std::string& signal, const std::string& when, const std::string& more) {
        folder.write("stopped.sh", "'" PERIPORO_PROGRAM "' " + drying + "--quiet --threads 1 --out parts " + more +
                                       " &\n"
                                       "pid=$!\n"
                                       "while kill -0 $pid 2> /dev/null && ! " +
                                       when +
                                       "; do :; done 2> /dev/null\n"
                                       "kill -s " +
                                       signal +
                                       " $pid\n"
                                       "wait $pid\n");
        const int status = std::system(("cd '" + folder.path().string() + "' && sh stopped.sh").c_str());
        return WEXITSTATUS(status);
    };
    const auto rows = [](int count) { return fmt::format("[ $(cat parts/history.csv | wc -l) -ge {} ]", count); };
    REQUIRE(stopped("TERM", "{ grep -q 'stable step' parts/run.log && sleep 0.2; }", "") == 130);
    CHECK(
        ProgramFolder::read(folder.path() / "parts/run.log").find("SIGTERM interrupted the run in stage 'geostatic'") !=
        std::string::npos);
    REQUIRE(stopped("TERM", rows(2), "--resume") == 130);
    CHECK(std::filesystem::exists(folder.path() / "parts/checkpoint.bin"));
    CHECK(content_of(folder.path() / "parts/results.h5").count("/snapshots/000000/position") == 1); // complete file
    REQUIRE(stopped("INT", rows(70), "--resume") == 130);
    REQUIRE(folder.run(drying + "--quiet --threads 1 --out parts --resume").status == 0);
    CHECK(differences(results(folder.path() / "whole/results.h5"), results(folder.path() / "parts/results.h5")) ==
          std::set<std::string>{});
    CHECK(ProgramFolder::read(folder.path() / "whole/history.csv") ==
          ProgramFolder::read(folder.path() / "parts/history.csv"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "parts/checkpoint.bin"));
}

TEST_CASE("a run that goes wrong says where and leaves a readable result")
{
    const ProgramFolder folder;
    // no run is as exact as that
    const ProgramResult result =
        folder.run(coarse + "--set 'run.energy_error_limit=1e-9' --quiet --threads 1 --out bad");
    CHECK(result.status == 1);
    for (const char* part : {"stage 'collapse'", "step ", "point ", "position (", "energy_error_limit"}) {
        CAPTURE(result.error);
        CHECK(result.error.find(part) != std::string::npos);
    }
    CHECK(content_of(folder.path() / "bad/results.h5").count("/snapshots/000000/position") == 1);
    CHECK(ProgramFolder::read(folder.path() / "bad/summary.json").find("\"failed\"") != std::string::npos);
}

TEST_CASE("a heap that twitches when its hold is taken away is not at rest before it slides")
{
    const ProgramFolder folder;
    const std::string terrain = "run " PERIPORO_SOURCE_DIR "/cases/ground/terrain_slope.toml ";
    REQUIRE(folder.run(terrain + "--set 'stage.1.duration=10 ms' --quiet --out heap").status == 0);
    const auto summary = nlohmann::json::parse(ProgramFolder::read(folder.path() / "heap/summary.json"));
    CHECK(summary["stages"][1]["end_time"].get<double>() >= 0.01);
}

TEST_CASE("a column that stands ends its stage when it could have fallen over its height, one that falls when it rests")
{
    const ProgramFolder folder;
    const std::string longer = coarse + "--set 'stage.1.duration=2 s' --quiet ";
    // 0.12 m of a soil whose elasticity has no end
    const std::string elastic = R"(--set 'material.soil={ model = "linear_elastic", grain_density = "2200 kg/m3", )"
                                R"(porosity = 0.2, bulk_modulus = "25 MPa", shear_modulus = "15 MPa" }' )";
    REQUIRE(folder.run(longer + elastic + "--out stands").status == 0);
    REQUIRE(folder.run(longer + "--out falls").status == 0);
    const auto end = [&](const std::string& run) {
        const auto summary = nlohmann::json::parse(ProgramFolder::read(folder.path() / run / "summary.json"));
        return summary["stages"][1]["end_time"].get<double>();
    };
    const double fall = std::sqrt(2.0 * 0.1 / 9.81); // between points
    CHECK(end("stands") > fall);
    CHECK(end("stands") < 1.5 * fall); // four windows of an eighth of it, for what of the vibration is left in them
    CHECK(end("falls") > 0.25);
    CHECK(end("falls") < 1.9);
}

TEST_CASE("a cut that fails slowly is not at rest while it creeps, and its stage says that it was still moving")
{
    // 120 mm of soil in plane strain, which its suction hardly holds: it creeps below 20 mm/s for longer than a fall
    const ProgramFolder folder;
    folder.write("cut.toml", R"(include = [")" PERIPORO_SOURCE_DIR R"(/cases/column_collapse/quickstart.toml"]
[body.column]
geometry.size = ["100 mm", "10 mm", "120 mm"]
water = { type = "uniform", suction = "12 kPa", saturation = 0.02 }
[[boundary]]
type = "symmetry"
plane = "x = 0 mm"
[[boundary]]
type = "periodic"
plane = "y = 0 mm"
period = "10 mm"
[[stage]]
name = "geostatic"
type = "quasi_static"
rollers = ["x = 100 mm"]
[[stage]]
name = "creep"
type = "dynamic"
duration = "0.25 s"
until = { rest_speed = "20 mm/s" }
)");
    REQUIRE(folder.run("run cut.toml --quiet --threads 1 --out cut").status == 0);
    const auto stage = nlohmann::json::parse(ProgramFolder::read(folder.path() / "cut/summary.json"))["stages"][1];
    CHECK(stage["end_time"].get<double>() == 0.25);
    CHECK(stage["ended"].get<std::string>().starts_with("duration over, still moving at "));
    CHECK(stage["mean_speed"].get<double>() < 0.02); // by its speed alone it would rest
    CHECK(stage["mean_speed"].get<double>() > 0.002);
}

TEST_CASE("a stage ends exactly at its duration, by a fixed step that does not divide it too, and history says so")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    for (const char* step : {"", "--set 'time.step=0.3 ms' ", "--set 'time.step=0.1 ms' "}) {
        CAPTURE(step);
        const std::string often = "--set 'run.history_every=0.35 ms' ";
        REQUIRE(folder.run("run case.toml --quiet --overwrite --out it " + (step + often)).status == 0);
        const auto summary = nlohmann::json::parse(ProgramFolder::read(folder.path() / "it/summary.json"));
        CHECK(summary["stages"][0]["end_time"].get<double>() == 1e-3);
        CHECK(summary["stages"][0]["ended"] == "duration over");
        const std::string history = ProgramFolder::read(folder.path() / "it/history.csv");
        const auto time_of = [](const std::string& row) {
            const std::size_t comma = row.find(',');
            return std::stod(row.substr(comma + 1));
        };
        const std::size_t last = history.rfind('\n', history.size() - 2) + 1;
        CHECK(time_of(history.substr(last)) == 1e-3);
        CHECK(time_of(history.substr(history.find('\n') + 1)) == 0.0);
        const auto lines = std::count(history.begin(), history.end(), '\n'); // names; 0, 0.35 and 0.7 ms; the end
        CHECK(lines <= 5);
        CHECK(lines >= (*step == '\0' ? 3 : 5)); // the stable step is longer than half of the stage
        CHECK(content_of(folder.path() / "it/results.h5").count("/snapshots/000002/position") == 0); // once at the end
    }
}
