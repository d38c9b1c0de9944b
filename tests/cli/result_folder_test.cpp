// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The folder of a run: one run at a time, nothing of somebody else touched, no links followed, a clear message.
#include "cli/program.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <sys/stat.h>
#include <unistd.h>

#include <map>

using namespace periporo::test;

namespace {

constexpr const char* run_it = "run case.toml --quiet --threads 1 --out it ";

/// A block that floats for an hour of computing, with checkpoints all the time.
constexpr const char* for_long = R"(--set 'stage.0.duration=1000 s' --set 'run.checkpoint_every=10 ms' )"
                                 R"(--set 'gravity=["0 m/s2", "0 m/s2", "0 m/s2"]' --set 'output.0.every=10 ms' )";

class CaseFolder : public ProgramFolder {
public:
    CaseFolder() { write("case.toml", small_case); }
};

/// Every file below a folder with its content.
std::map<std::string, std::string> files_in(const std::filesystem::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[std::filesystem::relative(entry.path(), folder).string()] = ProgramFolder::read(entry.path());
    return files;
}

/// What a run leaves that was killed after a checkpoint.
void leave_unfinished_run(const ProgramFolder& folder)
{
    folder.write("killed.sh",
                 fmt::format("'{}' {} {} &\n"
                             "pid=$!\n"
                             "while kill -0 $pid && ! ls it/checkpoint.* > /dev/null 2>&1; do sleep 0.02; done\n"
                             "kill -KILL $pid\nwait $pid\n",
                             PERIPORO_PROGRAM, run_it, for_long));
    std::system(("cd '" + folder.path().string() + "' && sh killed.sh 2> /dev/null").c_str());
}

} // namespace

TEST_CASE("a second run into the folder of a run that goes on is refused with the number of its process")
{
    const CaseFolder folder;
    folder.write("both.sh", fmt::format("'{0}' {1} {2} &\n"
                                        "pid=$!\n"
                                        "echo $pid > process\n"
                                        "while kill -0 $pid && ! [ -s it/history.csv ]; do sleep 0.02; done\n"
                                        "for more in '' --resume --overwrite; do\n"
                                        "  '{0}' {1} $more 2>> errors\n"
                                        "  echo $? >> statuses\n"
                                        "done\n"
                                        "kill -TERM $pid\nwait $pid\necho $? >> statuses\n",
                                        PERIPORO_PROGRAM, run_it, for_long));
    std::system(("cd '" + folder.path().string() + "' && sh both.sh").c_str());
    CHECK(ProgramFolder::read(folder.path() / "statuses") == "2\n2\n2\n130\n"); // the first one did not notice
    const std::string errors = ProgramFolder::read(folder.path() / "errors");
    std::string process = ProgramFolder::read(folder.path() / "process");
    process.pop_back();
    CAPTURE(errors);
    CHECK(contains(errors, "another run writes into it: process " + process));
    CHECK(contains(errors, "--out"));
}

TEST_CASE("a second run is refused although somebody has deleted or replaced the mark of the first")
{
    for (const char* mark : {"rm it/periporo.run", "rm it/periporo.run; : > it/periporo.run"}) {
        CAPTURE(mark);
        const CaseFolder folder;
        folder.write("both.sh", fmt::format("'{0}' {1} {2} &\n"
                                            "pid=$!\n"
                                            "while kill -0 $pid && ! [ -s it/history.csv ]; do sleep 0.02; done\n"
                                            "{3}\n"
                                            "for more in '' --resume --overwrite; do\n"
                                            "  '{0}' {1} $more 2>> errors\n"
                                            "  echo $? >> statuses\n"
                                            "done\n"
                                            "kill -TERM $pid\nwait $pid\necho $? >> statuses\n",
                                            PERIPORO_PROGRAM, run_it, for_long, mark));
        std::system(("cd '" + folder.path().string() + "' && sh both.sh").c_str());
        CHECK(ProgramFolder::read(folder.path() / "statuses") == "2\n2\n2\n130\n");
        CHECK(contains(ProgramFolder::read(folder.path() / "errors"), "another run writes into it"));
    }
}

TEST_CASE("the lock of a run that was killed does not stop the next one")
{
    const CaseFolder folder;
    leave_unfinished_run(folder);
    REQUIRE(std::filesystem::exists(folder.path() / "it/periporo.run"));
    CHECK(folder.run(std::string(run_it) + "--overwrite").status == 0);
}

TEST_CASE("a folder with files of somebody else and no run is refused by its list, and nothing in it is touched")
{
    const CaseFolder folder;
    folder.write("it/thesis.tex", "years of work");
    folder.write("it/case.toml", "of the user");
    folder.write("it/run.log", "what the user redirected into it");
    folder.write("it/history.csv", "1,2,3");
    folder.write("it/results.parts/000000-0.h5", "of the user");
    const auto before = files_in(folder.path() / "it");
    for (const char* more : {"", "--resume", "--overwrite"}) {
        CAPTURE(more);
        const ProgramResult result = folder.run(run_it + std::string(more));
        CHECK(result.status == 2);
        CHECK(contains(result.error, "choose another --out") + contains(result.error, "--out DIR") > 0);
        CHECK(files_in(folder.path() / "it") == before);
    }
    CHECK(contains(folder.run(std::string(run_it) + "--overwrite").error, "thesis.tex"));
}

TEST_CASE("--overwrite deletes what a run wrote and leaves the rest, which it names")
{
    const CaseFolder folder;
    REQUIRE(folder.run(run_it).status == 0);
    folder.write("it/notes.txt", "the best run");
    folder.write("it/checkpoint_notes.h5", "of the user");
    folder.write("it/figures/final.png", "a picture");
    folder.write("it/history.csv.damaged", "of a run");
    folder.write("it/results.parts/000007-9.h5", "of a run");
    const ProgramResult result = folder.run(std::string(run_it) + "--overwrite");
    CHECK(result.status == 0);
    CHECK(contains(result.error, "left alone, since no run wrote it: checkpoint_notes.h5, figures, notes.txt"));
    CHECK(ProgramFolder::read(folder.path() / "it/notes.txt") == "the best run");
    CHECK(ProgramFolder::read(folder.path() / "it/figures/final.png") == "a picture");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "it/history.csv.damaged"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "it/results.parts"));
}

TEST_CASE("links out of the folder are not followed: refused by --resume, deleted as links by --overwrite")
{
    for (const char* name : {"results.parts", "history.csv", "run.log", "results.h5"}) {
        CAPTURE(name);
        const CaseFolder folder;
        leave_unfinished_run(folder);
        folder.write("else/where", "of somebody else");
        const auto target = folder.path() / (std::string(name) == "results.parts" ? "else" : "else/where");
        std::filesystem::remove_all(folder.path() / "it" / name);
        std::filesystem::create_symlink(target, folder.path() / "it" / name);
        const auto before = files_in(folder.path() / "else");
        const ProgramResult resumed = folder.run(std::string(run_it) + "--resume " + for_long);
        CHECK(resumed.status == 2);
        CHECK(files_in(folder.path() / "else") == before);
        CHECK(folder.run(std::string(run_it) + "--overwrite").status == 0);
        CHECK(files_in(folder.path() / "else") == before);
    }
}

TEST_CASE("a case file whose name is all extension writes to a folder of its own and not into the working folder")
{
    for (const char* name : {"...toml", ".toml", "..toml"}) {
        CAPTURE(name);
        const ProgramFolder folder;
        folder.write(name, small_case);
        folder.write("mine.txt", "of the user");
        REQUIRE(folder.run(fmt::format("run ./{} --quiet --threads 1", name)).status == 0);
        CHECK(folder.entries() == std::set<std::string>{name, "mine.txt", "results"});
        CHECK(std::filesystem::exists(folder.path() / "results/toml/results.h5"));
    }
}

TEST_CASE("a folder that cannot be written is refused before anything is computed")
{
    if (::geteuid() == 0) {
        MESSAGE("not tried: root may write everywhere");
        return;
    }
    const CaseFolder folder;
    std::filesystem::create_directory(folder.path() / "it");
    ::chmod((folder.path() / "it").c_str(), 0555);
    const ProgramResult result = folder.run(run_it);
    ::chmod((folder.path() / "it").c_str(), 0755);
    CHECK(result.status == 2);
    CHECK(contains(result.error, "Permission denied; make the folder writable or choose another one"));
}

TEST_CASE("a folder that is taken away while a run writes into it ends the run with one message")
{
    const CaseFolder folder;
    folder.write("away.sh",
                 fmt::format("'{}' {} {} 2> errors &\n"
                             "pid=$!\n"
                             "while kill -0 $pid && ! ls it/checkpoint.* > /dev/null 2>&1; do sleep 0.02; done\n"
                             "mv it gone\nwait $pid\necho $? > status\n",
                             PERIPORO_PROGRAM, run_it, for_long));
    std::system(("cd '" + folder.path().string() + "' && sh away.sh").c_str());
    CHECK(ProgramFolder::read(folder.path() / "status") == "1\n");
    const std::string errors = ProgramFolder::read(folder.path() / "errors");
    CAPTURE(errors);
    CHECK(contains(errors, "No such file or directory; has somebody taken the folder away?"));
    CHECK(errors.find("periporo: ") == errors.rfind("periporo: "));
    CHECK(std::filesystem::exists(folder.path() / "gone/results.h5"));
}
