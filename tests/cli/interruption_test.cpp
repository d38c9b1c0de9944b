// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs that are stopped, killed, damaged or finished, and what --resume makes of them. PERIPORO_LONG_TESTS=1 kills a
// run 200 times instead of 10.
#include "cli/resume_support.hpp"
#include "support/archives.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>
#include <string>

using namespace periporo::test;

namespace {

/// 150 points that settle and collapse, some 400 steps.
const std::string coarse = "run " PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart.toml "
                           "--set 'discretization.spacing=20 mm' --set 'stage.1.duration=20 ms' "
                           R"(--set 'output=[{ writer = "csv", every = "1 s" }]' --quiet )";
/// The same, some 10,000 steps, with a checkpoint as often as it can be.
const std::string long_run =
    "run " PERIPORO_SOURCE_DIR "/cases/column_collapse/quickstart.toml "
    "--set 'discretization.spacing=20 mm' --set 'stage.1.duration=0.4 s' "
    "--set 'run.checkpoint_every=1 ms' "
    R"(--set 'output=[{ writer = "csv", every = "1 s" }, { writer = "hdf5", every = "20 ms" }]' )"
    "--quiet ";

/// Names, content and times of all files in a folder.
std::map<std::string, std::string> everything_in(const std::filesystem::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files[entry.path().filename().string()] =
            std::to_string(entry.last_write_time().time_since_epoch().count()) + ProgramFolder::read(entry.path());
    return files;
}

/// Runs a script in the folder; $program is the program.
int shell(const ProgramFolder& folder, const std::string& script)
{
    folder.write("script.sh", "program='" PERIPORO_PROGRAM "'\n" + script);
    const int status = std::system(("cd '" + folder.path().string() + "' && sh script.sh 2> error").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace

TEST_CASE("--resume leaves a complete run as it is")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    REQUIRE(folder.run("run case.toml --quiet --out it").status == 0);
    const auto before = everything_in(folder.path() / "it");
    for (const char* more : {"", " --set 'time.safety=0.5'", " --stop-after 1"}) {
        CAPTURE(more);
        const ProgramResult result = folder.run("run case.toml --out it --resume" + std::string(more));
        CHECK(result.status == 2);
        CHECK(contains(result.error, "already complete"));
        CHECK(contains(result.error, "--overwrite"));
        CHECK(everything_in(folder.path() / "it") == before);
    }
}

TEST_CASE("--resume with another case names the first key that differs and touches nothing")
{
    const ProgramFolder folder;
    REQUIRE(folder.run(coarse + "--out it --stop-after 30").status == 130);
    for (const bool with_checkpoint : {true, false}) {
        CAPTURE(with_checkpoint);
        if (!with_checkpoint) // as a run that was killed before its first one
            for (const char* name : {"checkpoint.bin", "summary.json"})
                std::filesystem::remove(folder.path() / "it" / name);
        const auto before = everything_in(folder.path() / "it");
        const ProgramResult result = folder.run(coarse + "--out it --resume --set 'contact.0.friction=0.4'");
        CHECK(result.status == 2);
        CHECK(contains(result.error, "contact.0.friction is 0.5 there and 0.4 here"));
        CHECK(everything_in(folder.path() / "it") == before);
    }
}

TEST_CASE("--resume touches no folder that holds no run")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    folder.write("mine/history.csv", "of the Romans");
    folder.write("mine/case.toml", "a case of mine");
    const auto before = everything_in(folder.path() / "mine");
    const ProgramResult result = folder.run("run case.toml --out mine --resume");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "holds no run to resume"));
    CHECK(everything_in(folder.path() / "mine") == before);
}

TEST_CASE("a run that failed is resumed from its first checkpoint and fails with the same words and results")
{
    const ProgramFolder folder;
    const std::string fails = coarse + "--set 'run.energy_error_limit=1e-9' --out it ";
    REQUIRE(folder.run(fails).status == 1);
    std::filesystem::copy(folder.path() / "it", folder.path() / "first", std::filesystem::copy_options::recursive);
    const ProgramResult result = folder.run(fails + "--resume");
    CHECK(result.status == 1);
    CHECK(contains(result.error, "last snapshot"));
    CHECK(differences_of(folder.path() / "first", folder.path() / "it") == std::set<std::string>{});
}

TEST_CASE("--resume does not compute anew a run that failed and whose checkpoints are gone")
{
    const ProgramFolder folder;
    const std::string fails = coarse + "--set 'run.energy_error_limit=1e-9' --out it ";
    REQUIRE(folder.run(fails).status == 1);
    for (const char* name : {"it/checkpoint.bin", "it/checkpoint.previous.bin"})
        std::filesystem::remove(folder.path() / name);
    const auto before = everything_in(folder.path() / "it");
    const ProgramResult result = folder.run(fails + "--resume");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "no checkpoint to go on from"));
    CHECK(everything_in(folder.path() / "it") == before);
}

TEST_CASE("a damaged checkpoint is named and set aside, and the run goes on from the one before to the same bits")
{
    const ProgramFolder folder;
    REQUIRE(folder.run(coarse + "--out whole").status == 0);
    REQUIRE(folder.run(coarse + "--out parts --stop-after 100").status == 130);
    REQUIRE(folder.run(coarse + "--out parts --stop-after 150 --resume").status == 130);
    const std::filesystem::path newest = folder.path() / "parts/checkpoint.bin";
    std::string bytes = bytes_of(newest);
    bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 16);
    write_bytes(newest, bytes);
    const ProgramResult result = folder.run(coarse + "--out parts --resume");
    CHECK(result.status == 0);
    CHECK(contains(result.error, "parts/checkpoint.bin is damaged"));
    CHECK(contains(result.error, "checkpoint.previous.bin"));
    CHECK(contains(ProgramFolder::read(folder.path() / "parts/run.log"), "at step 100,"));
    CHECK(differences_of(folder.path() / "whole", folder.path() / "parts") == std::set<std::string>{});
    for (const auto& [name, content] : everything_in(folder.path() / "parts"))
        CHECK_FALSE(name.starts_with("checkpoint"));
}

TEST_CASE("two damaged checkpoints are refused with both names and nothing is touched")
{
    const ProgramFolder folder;
    REQUIRE(folder.run(coarse + "--out it --stop-after 20").status == 130);
    REQUIRE(folder.run(coarse + "--out it --stop-after 30 --resume").status == 130);
    for (const char* name : {"it/checkpoint.bin", "it/checkpoint.previous.bin"})
        write_bytes(folder.path() / name, bytes_of(folder.path() / name).substr(0, 5000));
    const auto before = everything_in(folder.path() / "it");
    const ProgramResult result = folder.run(coarse + "--out it --resume");
    CHECK(result.status == 2);
    CHECK(contains(result.error, "it/checkpoint.bin is damaged"));
    CHECK(contains(result.error, "it/checkpoint.previous.bin is damaged"));
    CHECK(contains(result.error, "--overwrite"));
    CHECK(everything_in(folder.path() / "it") == before);
}

TEST_CASE("a run that has done the steps of --stop-after already stops at once")
{
    const ProgramFolder folder;
    REQUIRE(folder.run(coarse + "--out it --stop-after 30").status == 130);
    const std::string checkpoint = bytes_of(folder.path() / "it/checkpoint.bin");
    const ProgramResult result = folder.run(coarse + "--out it --stop-after 30 --resume");
    CHECK(result.status == 130);
    CHECK(contains(result.error, "30 steps already"));
    CHECK(bytes_of(folder.path() / "it/checkpoint.bin") == checkpoint);
}

TEST_CASE("SIGTERM, SIGINT, SIGHUP and the end of the processor time stop with a checkpoint at the next step")
{
    const ProgramFolder folder;
    for (const std::string signal : {"TERM", "INT", "HUP", "XCPU"}) {
        CAPTURE(signal);
        // The tests themselves may run under nohup.
        const int status =
            shell(folder, "env --default-signal=HUP $program " + long_run + "--out " + signal +
                              " & pid=$!\n"
                              "while kill -0 $pid && [ ! -f " +
                              signal + "/checkpoint.bin ]; do :; done\nkill -s " + signal + " $pid\nwait $pid\n");
        CHECK(status == 130);
        const std::string log = ProgramFolder::read(folder.path() / signal / "run.log");
        CHECK(contains(log, fmt::format("SIG{}", signal)));
        CHECK(contains(log, "interrupted the run"));
        CHECK(std::filesystem::exists(folder.path() / signal / "history.csv"));
    }
}

TEST_CASE("a SIGHUP that is ignored, as nohup does it, stays ignored")
{
    const ProgramFolder folder;
    CHECK(shell(folder, "trap '' HUP\n$program " + long_run +
                            "--out it & pid=$!\n"
                            "while kill -0 $pid && [ ! -f it/checkpoint.bin ]; do :; done\nkill -s HUP $pid\n"
                            "kill -s TERM $pid\nwait $pid\n") == 130);
    CHECK(contains(ProgramFolder::read(folder.path() / "it/run.log"), "SIGTERM interrupted the run"));
}

TEST_CASE("a signal while the run is set up ends it at once and leaves nothing")
{
    const ProgramFolder folder;
    const std::string slow = // 150,000 points in a shape that takes long to fill
        coarse + R"(--set 'discretization.spacing=2 mm' --set 'body.column.geometry={ generator = "cylinder", )" +
        R"(radius = "100 mm", height = "120 mm" }' )";
    CHECK(shell(folder, "$program " + slow + "--out it & pid=$!\nsleep 2\nkill $pid\nwait $pid\n") == 130);
    CHECK(contains(ProgramFolder::read(folder.path() / "error"), "while the run was set up"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "it"));
    const ProgramResult again = folder.run(slow + "--out it --resume");
    CHECK(again.status == 2);
    CHECK(contains(again.error, "holds no run to resume"));
}

TEST_CASE("a run outlives its terminal")
{
    const ProgramFolder folder;
    folder.write("case.toml", small_case);
    shell(folder, "( $program run case.toml --out it; echo $? > status ) 2>&1 | true\n"
                  "while [ ! -s status ]; do :; done\n");
    CHECK(ProgramFolder::read(folder.path() / "status") == "0\n");
    folder.write("case.toml", "title = 3\n"); // a message that nobody reads does not change the exit status
    shell(folder, "rm status; ( $program run case.toml --out other; echo $? > status ) 2>&1 | true\n"
                  "while [ ! -s status ]; do :; done\n");
    CHECK(ProgramFolder::read(folder.path() / "status") == "2\n");
}

TEST_CASE("a checkpoint that may not grow is an error with its name and the reason, and leaves the one before")
{
    const ProgramFolder folder;
    REQUIRE(folder.run(coarse + "--out it --stop-after 20").status == 130);
    const std::string sound = bytes_of(folder.path() / "it/checkpoint.bin");
    CHECK(shell(folder, "ulimit -f 100\n$program " + coarse + "--out it --resume --stop-after 30\n") == 1);
    const std::string error = ProgramFolder::read(folder.path() / "error");
    CHECK(contains(error, "checkpoint.bin.part: File too large"));
    CHECK(bytes_of(folder.path() / "it/checkpoint.bin") == sound);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "it/checkpoint.bin.part"));
    CHECK(folder.run(coarse + "--out it --resume").status == 0);
}

TEST_CASE("a run that is killed again and again ends at the same bits")
{
    const ProgramFolder folder;
    REQUIRE(folder.run(long_run + "--threads 1 --out whole").status == 0);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> seconds(0.05, 0.8);
    const int kills = long_tests() ? 200 : 10;
    int killed = 0, complete = 0;
    const auto go_on = [&](double limit) {
        const bool begun = std::filesystem::exists(folder.path() / "parts/periporo.run");
        const int status = shell(folder, fmt::format("timeout -s KILL {:.3f} $program {} --threads {} --out parts {}\n",
                                                     limit, long_run, 1 + killed % 2, begun ? "--resume" : ""));
        const std::string error = ProgramFolder::read(folder.path() / "error");
        CAPTURE(status);
        CAPTURE(error);
        // A kill at the very end leaves a complete run.
        const bool is_complete = status == 0 || (status == 2 && contains(error, "already complete"));
        REQUIRE((is_complete || status == 137 || status == -1));
        if (!is_complete) {
            ++killed;
            return;
        }
        ++complete;
        CHECK(differences_of(folder.path() / "whole", folder.path() / "parts") == std::set<std::string>{});
        std::filesystem::remove_all(folder.path() / "parts");
    };
    while (killed < kills && complete < kills)
        go_on(seconds(random));
    CHECK(killed == kills);
    go_on(600.0);
    CHECK(complete > 0);
    MESSAGE(killed, " kills of ", complete, " runs");
}
