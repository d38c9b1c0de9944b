// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Folders from which somebody took checkpoints, parts, summaries or rights, and what --resume and --overwrite make of
// them: nothing is lost without a word, and what is refused stays as it was.
#include "cli/program.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace periporo::test;

namespace fs = std::filesystem;

namespace {

/// Twenty steps with snapshots at steps 0, 4, 8 and so on.
const std::string twenty_steps = "run case.toml --quiet --threads 1 --out it --set 'time.step=0.1 ms' "
                                 "--set 'stage.0.duration=2 ms' --set 'run.history_every=0.1 ms' "
                                 "--set 'output.0.every=0.4 ms' ";

std::set<std::string> names_in_folder(const fs::path& folder)
{
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

class RunFolder : public ProgramFolder {
public:
    RunFolder()
    {
        write("case.toml", small_case);
        fs::create_directory(it());
    }
    fs::path it() const { return path() / "it"; }
    ProgramResult go(const std::string& more) const { return run(twenty_steps + more); }
    void stop_after_ten() const { REQUIRE(go("--stop-after 10").status == 130); }
    void complete() const { REQUIRE(go("").status == 0); }

    /// Every entry below `it` with its content, when it is a file.
    std::map<std::string, std::string> content() const
    {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(it()))
            files[fs::relative(entry.path(), it()).string()] =
                fs::is_regular_file(entry.symlink_status()) ? read(entry.path()) : "";
        return files;
    }
    /// The command ends with status 2 and these words, and nothing is touched.
    void check_refused(const std::string& more, const std::vector<std::string>& words) const
    {
        CAPTURE(more);
        const auto before = content();
        check_words(go(more), words);
        CHECK(content() == before);
    }
    static void check_words(const ProgramResult& result, const std::vector<std::string>& words)
    {
        CAPTURE(result.error);
        CHECK(result.status == 2);
        for (const std::string& word : words) {
            CAPTURE(word);
            CHECK(contains(result.error, word));
        }
        for (const char* raw : {"HDF5", "filesystem error", "Failed opening"})
            CHECK_FALSE(contains(result.error, raw));
    }
};

} // namespace

TEST_CASE("--resume of a run whose checkpoints were deleted is refused, names what is there, and deletes nothing")
{
    const RunFolder folder;
    folder.stop_after_ten();
    for (const char* name : {"checkpoint.bin", "checkpoint.previous.bin"})
        fs::remove(folder.it() / name);
    const std::vector<std::string> words{"no checkpoint", "3 snapshots in results.parts", "11 rows in history.csv",
                                         "--out DIR", "--overwrite"};
    folder.check_refused("--resume", words);
    fs::remove(folder.it() / "summary.json"); // as after a kill
    folder.check_refused("--resume", words);
    fs::remove_all(folder.it() / "results.parts");
    fs::remove(folder.it() / "results.h5");
    folder.check_refused("--resume", {"no checkpoint", "11 rows in history.csv"});
    fs::remove(folder.it() / "history.csv");
    CHECK(folder.go("--resume").status == 0); // nothing is left that could be lost
}

TEST_CASE("a complete run whose summary is damaged, empty or missing is complete by its results")
{
    const RunFolder folder;
    folder.complete();
    for (const char* summary : {"{\"outcome\": \"comp", "", "{\"outcome\": \"interrupted\"}"}) {
        folder.write("it/summary.json", summary);
        folder.check_refused("--resume", {"already complete", "summary.json is", "--overwrite"});
    }
    fs::remove(folder.it() / "summary.json");
    folder.check_refused("--resume", {"already complete", "summary.json is missing"});
}

TEST_CASE("what a complete run left when it was killed at its very end is deleted by --resume and named")
{
    const RunFolder folder;
    folder.stop_after_ten();
    fs::copy(folder.it(), folder.path() / "before", fs::copy_options::recursive);
    REQUIRE(folder.go("--resume").status == 0);
    auto complete = folder.content();
    for (const char* name : {"results.parts", "history.csv.journal", "checkpoint.bin"})
        fs::copy(folder.path() / "before" / name, folder.it() / name, fs::copy_options::recursive);
    const ProgramResult result = folder.go("--resume");
    RunFolder::check_words(
        result, {"already complete", "deleted now: checkpoint.bin, history.csv.journal, results.parts/000000-0.h5"});
    auto left = folder.content();
    for (auto* content : {&complete, &left})
        content->erase("periporo.run"); // which has the number of the last process
    CHECK(left == complete);
    CHECK_FALSE(contains(folder.go("--resume").error, "deleted now"));

    fs::copy(folder.path() / "before/results.parts", folder.it() / "results.parts");
    folder.write("it/results.parts/notes.txt", "of the user");
    folder.write("it/results.parts/000001-4.h5.damaged", "kept for the user");
    RunFolder::check_words(folder.go("--resume"), {"deleted now: results.parts/000000-0.h5"});
    CHECK(names_in_folder(folder.it() / "results.parts") == std::set<std::string>{"000001-4.h5.damaged", "notes.txt"});
}

TEST_CASE("nothing that a complete run left is deleted when its results are gone")
{
    const RunFolder folder;
    folder.stop_after_ten();
    fs::copy(folder.it() / "results.parts", folder.path() / "before");
    REQUIRE(folder.go("--resume").status == 0);
    fs::copy(folder.path() / "before", folder.it() / "results.parts");
    fs::remove(folder.it() / "results.h5");
    folder.check_refused("--resume", {"already complete", "results.h5 is gone or damaged"});
}

TEST_CASE("another title and other times of checkpoints do not refuse a resume, and the title is remarked upon")
{
    const RunFolder folder;
    folder.stop_after_ten();
    const ProgramResult result = folder.go("--resume --set 'title=another name' --set 'run.checkpoint_every=1 s'");
    CAPTURE(result.error);
    CHECK(result.status == 0);
    CHECK(contains(ProgramFolder::read(folder.it() / "run.log"), "there and \"another name\" here"));
    CHECK(contains(ProgramFolder::read(folder.it() / "case.toml"), "another name"));
}

TEST_CASE("a complete run whose results are gone is not called complete without a word")
{
    for (const char* name : {"results.h5", "history.csv"}) {
        const RunFolder folder;
        folder.complete();
        fs::remove(folder.it() / name);
        folder.check_refused("--resume", {"already complete", fmt::format("{} is gone or damaged", name)});
    }
    const RunFolder folder;
    folder.complete();
    folder.write("it/results.h5", "no HDF5");
    folder.check_refused("--resume", {"already complete", "results.h5 is gone or damaged"});
}

TEST_CASE("a resume without snapshots that the checkpoint counts on is refused with their times")
{
    const RunFolder folder;
    folder.stop_after_ten();
    fs::remove(folder.it() / "results.parts/000001-4.h5");
    folder.check_refused("--resume", {"snapshot 000001 of step 4, time 0.0004 s", "--without-lost-results"});
    fs::remove_all(folder.it() / "results.parts");
    folder.check_refused("--resume", {"snapshot 000000 of step 0, time 0 s", "snapshot 000001 of step 4",
                                      "snapshot 000002 of step 8", "results.parts/journal"});
    fs::remove(folder.it() / "history.csv");
    folder.check_refused("--resume", {"history.csv, the rows of the history"});
}

TEST_CASE("--without-lost-results goes on with the true numbers and a lasting mark in the summary")
{
    const RunFolder folder;
    folder.stop_after_ten();
    fs::remove_all(folder.it() / "results.parts");
    REQUIRE(folder.go("--resume --without-lost-results --stop-after 15").status == 130);
    CHECK(fs::exists(folder.it() / "results.parts/000003-12.h5"));
    CHECK_FALSE(fs::exists(folder.it() / "results.parts/000000-12.h5"));
    REQUIRE(folder.go("--resume").status == 0); // the loss is known
    const auto summary = nlohmann::json::parse(ProgramFolder::read(folder.it() / "summary.json"));
    CHECK(summary.at("outcome") == "complete");
    CHECK(contains(summary.at("message").get<std::string>(), "lost"));
    CHECK(contains(summary.at("losses").dump(), "snapshot 000002 of step 8, time 0.0008 s"));
    CHECK(contains(ProgramFolder::read(folder.it() / "run.log"), "complete, but parts of the results are lost"));
    CHECK(contains(ProgramFolder::read(folder.it() / "results.h5"), "snapshot 000002 of step 8")); // its "missing"
}

TEST_CASE("the losses in the summary are one entry for each loss, also when the terminal names a part of them")
{
    const RunFolder folder;
    REQUIRE(folder.go("--stop-after 17 --set 'output.0.every=0.2 ms'").status == 130); // nine snapshots
    for (int number = 0; number < 8; ++number)
        folder.write(fmt::format("it/results.parts/{:06}-{}.h5", number, 2 * number), "damaged");
    const ProgramResult result = folder.go("--resume --set 'output.0.every=0.2 ms' --stop-after 18");
    CAPTURE(result.error);
    REQUIRE(result.status == 130);
    CHECK(contains(result.error, "and 2 more"));
    REQUIRE(folder.go("--resume --set 'output.0.every=0.2 ms'").status == 0); // which finds the same losses
    const auto losses = nlohmann::json::parse(ProgramFolder::read(folder.it() / "summary.json"))
                            .at("losses")
                            .get<std::vector<std::string>>();
    CHECK(losses.size() == 8);
    for (int number = 0; number < 8; ++number)
        CHECK(std::ranges::any_of(losses, [&](const std::string& loss) {
            return loss.starts_with(fmt::format("snapshot {:06} of step {}", number, 2 * number));
        }));
}

TEST_CASE("what is damaged and mended without a loss is no loss in the summary")
{
    const RunFolder folder;
    folder.stop_after_ten();
    const std::string bytes = ProgramFolder::read(folder.it() / "history.csv.journal");
    folder.write("it/history.csv.journal", bytes.substr(0, 64) + "put in" + bytes.substr(64));
    const ProgramResult result = folder.go("--resume");
    REQUIRE(result.status == 0);
    CHECK(contains(result.error, "history.csv.journal was damaged and is mended"));
    CHECK_FALSE(nlohmann::json::parse(ProgramFolder::read(folder.it() / "summary.json")).contains("losses"));
}

TEST_CASE("a pipe, a folder or a link in place of any file of a run is refused by its name, and nothing waits")
{
    const RunFolder folder;
    folder.stop_after_ten();
    std::vector<std::string> names{"summary.json.part"};
    for (const auto& [name, content] : folder.content())
        if (fs::is_regular_file(folder.it() / name))
            names.push_back(name);
    REQUIRE(names.size() > 10);
    for (const std::string& name : names) {
        CAPTURE(name);
        const RunFolder other;
        fs::copy(folder.it(), other.it(), fs::copy_options::recursive);
        fs::remove(other.it() / name);
        REQUIRE(::mkfifo((other.it() / name).c_str(), 0600) == 0);
        for (const char* more : {"--resume", "--overwrite", ""}) {
            CAPTURE(more);
            const ProgramResult result = other.run(twenty_steps + more, "timeout 30");
            CAPTURE(result.error);
            CHECK(result.status == 2);
            if (*more != '\0')
                CHECK(contains(result.error, "it/" + name + " is a pipe and not a regular file"));
        }
        fs::remove(other.it() / name);
        fs::create_directory(other.it() / name);
        other.check_refused("--resume", {"it/" + name + " is a folder and not a regular file"});
    }
}

TEST_CASE("--overwrite deletes no file that the case reads")
{
    const RunFolder folder;
    folder.complete();
    fs::copy_file(folder.path() / "case.toml", folder.it() / "case.toml", fs::copy_options::overwrite_existing);
    const auto before = folder.content();
    const auto check = [&](const std::string& command, const std::string& name) {
        CAPTURE(command);
        RunFolder::check_words(folder.run(command + " --overwrite --quiet"), {"would delete", name, "choose another"});
        CHECK(folder.content() == before);
    };
    check("run it/case.toml --out it", "it/case.toml");
    check("run it/../it/case.toml --out ./it/", "case.toml");
    fs::create_symlink("it/case.toml", folder.path() / "link.toml");
    check("run link.toml --out it", "link.toml");
    fs::create_directory_symlink("it", folder.path() / "other_name");
    check("run it/case.toml --out other_name", "it/case.toml");
    folder.write("includes.toml", "include = [\"it/case.toml\"]\n");
    check("run includes.toml --out it", "it/case.toml");
}

TEST_CASE("--overwrite deletes no table that the case names in the folder of results")
{
    const RunFolder folder;
    folder.complete();
    // A point in a table that has the name of a result.
    folder.write("it/history.csv", "x,y,z,volume\n0.0125,0.0125,0.0125,1.5625e-5\n");
    std::string text = small_case;
    const std::string box = R"({ generator = "box", size = ["100 mm", "100 mm", "100 mm"] })";
    text.replace(text.find(box), box.size(), R"({ generator = "points", file = "it/history.csv" })");
    folder.write("case.toml", text);
    const auto before = folder.content();
    RunFolder::check_words(folder.go("--overwrite"), {"would delete", "it/history.csv"});
    CHECK(folder.content() == before);
}

TEST_CASE("--overwrite deletes nothing that a mark names and no run makes, and leaves the user's files among the parts")
{
    const RunFolder folder;
    folder.stop_after_ten();
    folder.write("it/thesis.tex", "years of work");
    folder.write("it/figures/final.png", "a picture");
    folder.write("it/periporo.run",
                 ProgramFolder::read(folder.it() / "periporo.run") + "thesis.tex\nfigures\n../case.toml\n");
    folder.write("it/results.parts/notes.txt", "of the user");
    folder.write("it/results.parts/1-2.h5", "of the user");
    folder.write("it/results.parts/deep/file", "of the user");
    const ProgramResult result = folder.go("--overwrite");
    CAPTURE(result.error);
    CHECK(result.status == 0);
    CHECK(contains(result.error,
                   "left alone, since no run wrote it: figures, results.parts/1-2.h5, results.parts/deep, "
                   "results.parts/notes.txt, thesis.tex"));
    for (const char* name : {"thesis.tex", "figures/final.png", "results.parts/notes.txt", "results.parts/1-2.h5",
                             "results.parts/deep/file"})
        CHECK_FALSE(ProgramFolder::read(folder.it() / name).empty());
    CHECK_FALSE(fs::exists(folder.it() / "results.parts/journal"));
}

TEST_CASE("--overwrite touches nothing when a folder stands where a run has a file")
{
    const RunFolder folder;
    folder.stop_after_ten();
    fs::remove(folder.it() / "history.csv");
    folder.write("it/history.csv/mine", "of the user");
    folder.check_refused("--overwrite", {"it/history.csv is a folder and not a regular file"});
}

TEST_CASE("a folder that holds nothing but a case file is named by it")
{
    const RunFolder folder;
    folder.write("it/case.toml", small_case);
    const auto before = folder.content();
    RunFolder::check_words(folder.run("run it/case.toml --out it"), {"it holds no run of periporo but case.toml"});
    CHECK(folder.content() == before);
}

TEST_CASE("what a user may not read is named with the way out, and not taken for damaged")
{
    // Root reads everything: the program runs as the user "nobody" then.
    const bool root = ::geteuid() == 0;
    const std::string as_user = root ? "setpriv --reuid 65534 --regid 65534 --clear-groups" : "";
    for (const char* name : {"checkpoint.bin", "results.parts", "."}) {
        CAPTURE(name);
        const RunFolder folder;
        folder.stop_after_ten();
        REQUIRE(folder.go("--resume --stop-after 15").status == 130); // a checkpoint before the newest one
        if (root) {
            fs::permissions(folder.path(), fs::perms::all);
            for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
                REQUIRE(::chown(entry.path().c_str(), 65534, 65534) == 0);
        }
        ::chmod((folder.it() / name).c_str(), 0);
        for (const char* more : {"--resume", "--overwrite", ""}) {
            CAPTURE(more);
            if (std::string(name) == "checkpoint.bin" && std::string(more) != "--resume")
                continue;
            const ProgramResult result = folder.run(twenty_steps + more, as_user);
            if (std::string(more).empty() && std::string(name) == "results.parts" && result.status == 2)
                continue; // it is not looked into, or cannot be
            RunFolder::check_words(result, {"cannot read it", "Permission denied; make it readable"});
            CHECK_FALSE(contains(result.error, "start anew"));
        }
        ::chmod((folder.it() / name).c_str(), 0755);
        CHECK(folder.go("--resume").status == 0);
    }
}

TEST_CASE("a file of the folder that cannot be read or written is found before the first step, with the right way out")
{
    struct Right {
        const char* name;
        mode_t mode;
        const char* words;
    };
    const std::vector<Right> rights{{"results.parts/journal", 0, "make it readable"},
                                    {"results.parts/000001-4.h5", 0, "make it readable"},
                                    {"results.h5", 0, "make it readable"},
                                    {"history.csv.journal", 0, "make it readable"},
                                    {"summary.json", 0, "make it readable"},
                                    {"case.toml", 0, "make it readable"},
                                    {"history.csv", 0444, "make the file writable"},
                                    {"history.csv", 0, "make it readable"},
                                    {"run.log", 0444, "make the file writable"},
                                    {"run.log", 0, "make the file readable and writable"}};
    const bool root = ::geteuid() == 0;
    const std::string as_user = root ? "setpriv --reuid 65534 --regid 65534 --clear-groups" : "";
    const RunFolder folder;
    folder.stop_after_ten();
    if (root) {
        fs::permissions(folder.path(), fs::perms::all);
        for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
            REQUIRE(::chown(entry.path().c_str(), 65534, 65534) == 0);
    }
    for (const Right& right : rights) {
        CAPTURE(right.name);
        REQUIRE(::chmod((folder.it() / right.name).c_str(), right.mode) == 0);
        RunFolder::check_words(folder.run(twenty_steps + "--resume", as_user),
                               {right.name, "Permission denied", right.words});
        ::chmod((folder.it() / right.name).c_str(), 0644);
    }
    CHECK(folder.run(twenty_steps + "--resume", as_user).status == 0);
}

TEST_CASE("want of memory is told in plain words with the way out, wherever it is found")
{
    const RunFolder folder;
    std::size_t told = 0;
    ProgramResult result;
    for (int mebibytes = 20; result.status != 0 && mebibytes < 2000; ++mebibytes) { // of addresses, libraries included
        fs::remove_all(folder.it());
        result = folder.run(twenty_steps, fmt::format("OMP_NUM_THREADS=1 prlimit --as={}", mebibytes << 20));
        CAPTURE(mebibytes);
        CAPTURE(result.error);
        CHECK_FALSE(contains(result.error, "HDF5: "));
        told += contains(result.error, "Cannot allocate memory; allow more memory, as with ulimit -v") ? 1 : 0;
    }
    CHECK(result.status == 0);
    CHECK(told > 0);
}

TEST_CASE("few file handles and small files are told with the limit to raise, in plain words")
{
    const RunFolder folder;
    for (int handles = 5; handles <= 12; ++handles) {
        CAPTURE(handles);
        fs::remove_all(folder.it());
        const ProgramResult result = folder.run(twenty_steps, fmt::format("prlimit --nofile={}", handles));
        CAPTURE(result.error);
        if (result.status == 0)
            continue;
        CHECK(contains(result.error, "ulimit -n"));
        const bool can_go_on = fs::exists(folder.it() / "checkpoint.bin");
        CHECK_FALSE((can_go_on && contains(result.error, "no checkpoint")));
        if (can_go_on) {
            CHECK(contains(result.error, "--resume goes on from the checkpoint of step "));
            CHECK(folder.go("--resume").status == 0);
        }
        CHECK_FALSE(contains(result.error, "HDF5"));
        CHECK_FALSE(contains(result.error, "Failed opening"));
    }
    for (const int bytes : {1000, 10000, 30000}) {
        CAPTURE(bytes);
        fs::remove_all(folder.it());
        const ProgramResult result =
            folder.run(twenty_steps + "--stop-after 5", fmt::format("prlimit --fsize={}", bytes));
        CAPTURE(result.error);
        CHECK((result.status == 130 || contains(result.error, "ulimit -f")));
    }
}

TEST_CASE("a pipe in place of the mark of an empty folder is refused by its name")
{
    const RunFolder folder;
    REQUIRE(::mkfifo((folder.it() / "periporo.run").c_str(), 0600) == 0);
    RunFolder::check_words(folder.run(twenty_steps, "timeout 30"), {"it/periporo.run is a pipe"});
}
