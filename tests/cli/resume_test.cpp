// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small variants of every shipped case, each with another force state, stopped at many steps and resumed, also with
// another number of threads: results, history and summary are those of the run that was never stopped, to the last bit.
//
// PERIPORO_LONG_TESTS=1 stops each variant some 40 times instead of 4, twenty of them in steps that follow each other.
#include "cli/resume_support.hpp"
#include "operator/force_state.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace periporo::test;

namespace {

struct Variant {
    std::string file; ///< under cases/, without .toml
    std::string force_state;
    std::vector<std::string> sets;
};

/// A few hundred steps each.
const std::vector<Variant> variants{
    {"column_collapse/quickstart", "energy_conjugate", {"discretization.spacing=20 mm", "stage.1.duration=20 ms"}},
    {"column_collapse/quickstart_substrate",
     "bond_projection",
     {"discretization.spacing=20 mm", "boundary.2.plane=z = -20 mm", "stage.0.until.residual=0.05",
      "stage.1.duration=10 ms"}},
    {"column_collapse/cylinder_a1", "volume_weighted", {"discretization.spacing=20 mm", "stage.1.duration=15 ms"}},
    {"column_collapse/paper_a0.6", "energy_conjugate_mean", {"discretization.spacing=20 mm", "stage.1.duration=15 ms"}},
    {"column_collapse/paper_a1.2", "unstabilized", {"discretization.spacing=20 mm", "stage.1.duration=15 ms"}},
    {"column_collapse/paper_a2.0", "energy_conjugate", {"discretization.spacing=25 mm", "stage.1.duration=15 ms"}},
    {"paper/column_a0.6",
     "energy_conjugate",
     {"discretization.spacing=20 mm", R"(body.substrate.geometry.size=["200 mm", "200 mm", "40 mm"])",
      R"(body.substrate.geometry.origin=["0 mm", "0 mm", "-40 mm"])", "boundary.2.plane=z = -20 mm",
      R"(boundary.3.layer=["x = 80 mm", "x = 100 mm"])", R"(boundary.4.layer=["y = 80 mm", "y = 100 mm"])",
      "stage.0.until.residual=0.05", "stage.1.duration=5 ms"}},
    {"paper/column_a1.2",
     "bond_projection",
     {"discretization.spacing=20 mm", R"(body.substrate.geometry.size=["200 mm", "200 mm", "40 mm"])",
      R"(body.substrate.geometry.origin=["0 mm", "0 mm", "-40 mm"])", "boundary.2.plane=z = -20 mm",
      R"(boundary.3.layer=["x = 80 mm", "x = 100 mm"])", R"(boundary.4.layer=["y = 80 mm", "y = 100 mm"])",
      "stage.0.until.residual=0.05", "stage.1.duration=5 ms"}},
    {"paper/column_a2.0",
     "volume_weighted",
     {"discretization.spacing=20 mm", R"(body.substrate.geometry.size=["200 mm", "200 mm", "40 mm"])",
      R"(body.substrate.geometry.origin=["0 mm", "0 mm", "-40 mm"])", "boundary.2.plane=z = -20 mm",
      R"(boundary.3.layer=["x = 80 mm", "x = 100 mm"])", R"(boundary.4.layer=["y = 80 mm", "y = 100 mm"])",
      "stage.0.until.residual=0.05", "stage.1.duration=5 ms"}},
    {"paper/wet_quickstart", "volume_weighted", {"discretization.spacing=20 mm", "stage.1.duration=15 ms"}},
    {"paper/whole_column",
     "energy_conjugate_mean",
     {"discretization.spacing=20 mm", "stage.0.until.residual=0.02", "stage.1.duration=5 ms"}},
    {"ground/falling_wedge", "unstabilized", {"discretization.spacing=15 mm", "stage.0.duration=80 ms"}},
    {"ground/footing",
     "energy_conjugate",
     {"discretization.spacing=20 mm", "boundary.2.plane=z = 20 mm", "stage.1.duration=5 ms"}},
    {"ground/rain_slope",
     "bond_projection",
     {"stage.0.until.residual=0.05", "stage.1.duration=20 ms", "stage.2.duration=20 ms", "stage.3.duration=20 ms",
      "stage.4.duration=20 ms", "stage.5.duration=20 ms"}},
    {"ground/terrain_slope",
     "volume_weighted",
     {"discretization.spacing=16 mm", "stage.0.until.residual=0.05", "stage.1.duration=5 ms"}},
    {"ground/tube_lift",
     "energy_conjugate_mean",
     {"discretization.spacing=15 mm", "stage.1.duration=5 ms", "stage.2.duration=5 ms"}},
    {"ground/wall_release",
     "unstabilized",
     {"discretization.spacing=10 mm", R"(body.soil.geometry.size=["100 mm", "10 mm", "120 mm"])",
      "boundary.0.period=10 mm", "stage.1.duration=5 ms", "stage.2.duration=5 ms"}},
    {"verification/bar_vibration", "energy_conjugate", {"stage.0.duration=30 ms"}},
    {"verification/bar_wave", "bond_projection", {}},
    {"verification/cantilever", "volume_weighted", {"discretization.spacing=15 mm", "stage.0.until.residual=0.05"}},
    {"verification/collision", "energy_conjugate_mean", {}},
    {"verification/floating_raft", "unstabilized", {"stage.0.duration=50 ms"}},
    {"verification/half_submerged_slope", "energy_conjugate", {"stage.0.until.residual=0.05", "stage.1.duration=5 ms"}},
    {"verification/hanging_bar", "bond_projection", {"stage.0.until.residual=0.05"}},
    {"verification/heap_at_rest", "volume_weighted", {"stage.1.duration=10 ms", "stage.2.duration=10 ms"}},
    {"verification/incline", "energy_conjugate_mean", {"discretization.spacing=20 mm", "stage.0.duration=50 ms"}},
    {"verification/incline_held", "unstabilized", {"discretization.spacing=20 mm", "stage.1.duration=20 ms"}},
    {"verification/p_wave", "energy_conjugate", {"stage.0.duration=50 ms"}},
    {"verification/self_weight_column", "bond_projection", {}},
    {"verification/sliding_sheet", "volume_weighted", {"discretization.spacing=20 mm", "stage.0.duration=20 ms"}},
    {"verification/spinning_block", "energy_conjugate_mean", {"stage.0.duration=80 ms"}},
    {"verification/submerged_column", "energy_conjugate_mean", {}},
    {"verification/suction_cube", "energy_conjugate", {"discretization.spacing=20 mm"}},
    {"verification/torsion", "bond_projection", {"discretization.spacing=20 mm", "stage.0.duration=50 ms"}},
    {"verification/vibrating_block", "energy_conjugate", {"stage.0.duration=0.1 s"}},
};

/// Cases that differ from another one in nothing but the spacing.
const std::set<std::string> finer{"column_collapse/paper_a0.6_fine", "column_collapse/paper_a1.2_fine",
                                  "column_collapse/paper_a2.0_fine"};

std::string command_of(const Variant& variant)
{
    std::string command = "run " PERIPORO_SOURCE_DIR "/cases/" + variant.file + ".toml --quiet ";
    for (const std::string& set : variant.sets)
        command += "--set '" + set + "' ";
    // Some force states create energy.
    return command + "--set 'operator.force_state=" + variant.force_state +
           "' --set 'run.energy_error_limit=1e9' --set 'run.history_every=1 ms' "
           R"(--set 'output=[{ writer = "hdf5", every = "5 ms" }, { writer = "csv", every = "5 ms" }]' )";
}

/// Steps to stop at: within the first stage, in its last step, between it and the next, in the first step of that, in
/// the last step of all, and at random.
std::set<std::uint64_t> stops_of(const nlohmann::json& summary, std::size_t number)
{
    const auto all = summary.at("steps").get<std::uint64_t>();
    std::mt19937 random(static_cast<std::mt19937::result_type>(number));
    std::uniform_int_distribution<std::uint64_t> any(1, all - 1);
    std::vector<std::uint64_t> awkward;
    std::uint64_t done = 0;
    for (const nlohmann::json& stage : summary.at("stages")) {
        const auto steps = stage.at("steps").get<std::uint64_t>();
        for (const std::uint64_t step : {done + steps / 2, done + steps - 1, done + steps, done + steps + 1})
            awkward.push_back(step);
        done += steps;
    }
    std::set<std::uint64_t> stops;
    if (long_tests()) {
        stops.insert(awkward.begin(), awkward.end());
        const std::uint64_t stretch = any(random);
        for (std::uint64_t step = stretch; step < stretch + 20; ++step)
            stops.insert(step);
        while (stops.size() < std::min<std::uint64_t>(40, all / 2))
            stops.insert(any(random));
    } else {
        stops = {awkward[number % awkward.size()], awkward[(number + 2) % awkward.size()], any(random), all - 1};
    }
    std::erase_if(stops, [all](std::uint64_t step) { return step == 0 || step >= all; });
    return stops;
}

/// Returns how often the run was stopped.
std::size_t check_resumes(const Variant& variant, std::size_t number)
{
    CAPTURE(variant.file);
    const ProgramFolder folder;
    const std::string command = command_of(variant);
    const ProgramResult whole = folder.run(command + "--threads 1 --out whole");
    CAPTURE(whole.error);
    REQUIRE(whole.status == 0);
    const nlohmann::json summary = nlohmann::json::parse(ProgramFolder::read(folder.path() / "whole/summary.json"));
    const std::set<std::uint64_t> stops = stops_of(summary, number);
    CAPTURE(fmt::format("{}", summary.at("steps").dump()));
    REQUIRE(stops.size() > 1);
    int threads = 2;
    std::string resume;
    for (const std::uint64_t stop : stops) {
        CAPTURE(stop);
        const ProgramResult part =
            folder.run(command + fmt::format("--threads {} --out parts --stop-after {} {}", threads, stop, resume));
        CAPTURE(part.error);
        REQUIRE(part.status == 130);
        threads = 3 - threads;
        resume = "--resume";
    }
    const ProgramResult last = folder.run(command + "--threads 2 --out parts --resume");
    CAPTURE(last.error);
    REQUIRE(last.status == 0);
    CHECK(differences_of(folder.path() / "whole", folder.path() / "parts") == std::set<std::string>{});
    return stops.size();
}

} // namespace

TEST_CASE("every shipped case that is stopped and resumed ends at the bits of the run that was never stopped")
{
    std::size_t stops = 0;
    for (std::size_t number = 0; number < variants.size(); ++number)
        stops += check_resumes(variants[number], number);
    MESSAGE(stops, " stops of ", variants.size(), " runs");
}

TEST_CASE("every shipped case has a variant, and every force state some")
{
    std::set<std::string> covered = finer, states;
    for (const Variant& variant : variants) {
        covered.insert(variant.file);
        states.insert(variant.force_state);
    }
    CHECK(states.size() == periporo::force_state_names().size());
    const std::filesystem::path root = PERIPORO_SOURCE_DIR "/cases";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".toml" || name.ends_with("_base.toml") || name == "sweeps.toml" ||
            entry.path().parent_path().filename() == "material")
            continue;
        std::filesystem::path file = std::filesystem::relative(entry.path(), root);
        CAPTURE(file.string());
        CHECK(covered.contains(file.replace_extension().string()));
    }
}
