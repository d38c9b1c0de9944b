// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The two checkpoints of a folder: which one is found, and what is said of the others.
#include "io/checkpoint.hpp"

#include "io/case_difference.hpp"
#include "io/folder_error.hpp"
#include "support/archives.hpp"
#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <sys/stat.h>

using namespace periporo;
using test::check_mentions;
using test::message_of_error;

namespace {

const std::string the_case = "title = \"a case\"\n\n[time]\nsafety = 0.85\n";

/// A folder with checkpoints of steps 1 to `last`.
struct Checkpoints {
    explicit Checkpoints(int last)
    {
        for (int step = 1; step <= last; ++step)
            write(step);
    }
    void write(int step) const
    {
        write_checkpoint(folder.path(), the_case, [&](ArchiveWriter& archive) { archive("step", 1.0 * step); });
    }
    /// The step of the checkpoint that is found.
    double found() const
    {
        FoundCheckpoint checkpoint = find_checkpoint(folder.path(), the_case);
        double step = 0.0;
        if (checkpoint.archive)
            (*checkpoint.archive)("step", step);
        return step;
    }
    void cut_off(const char* name) const
    {
        const std::string bytes = test::bytes_of(folder / name);
        test::write_bytes(folder / name, bytes.substr(0, bytes.size() / 2));
    }

    test::TemporaryFolder folder;
};

/// A folder with a checkpoint of a case that has keys without influence on the results.
struct TemporaryRun {
    TemporaryRun()
    {
        write_checkpoint(folder.path(),
                         "title = \"a case\"\n\n[plugins]\npaths = [\"/a\"]\n\n[time]\nsafety = 0.85\n\n[run]\n"
                         "checkpoint_every = 60.0  # s\nhistory_every = 1.0  # s\n",
                         [](ArchiveWriter&) {});
    }
    test::TemporaryFolder folder;
};

} // namespace

TEST_CASE("the newest checkpoint is found, and the one before it is kept")
{
    const Checkpoints checkpoints(3);
    CHECK(checkpoints.found() == 3.0);
    std::filesystem::remove(checkpoints.folder / checkpoint_name); // as a kill between the two renames leaves it
    CHECK(checkpoints.found() == 2.0);
    CHECK_FALSE(has_checkpoint(Checkpoints(0).folder.path()));
    CHECK(Checkpoints(0).found() == 0.0);
}

TEST_CASE("a damaged checkpoint is named, and the one before it is found")
{
    const Checkpoints checkpoints(3);
    checkpoints.cut_off(checkpoint_name);
    CHECK(checkpoints.found() == 2.0);
    const FoundCheckpoint found = find_checkpoint(checkpoints.folder.path(), the_case);
    REQUIRE(found.refused.size() == 1);
    check_mentions(found.refused[0], {(checkpoints.folder / checkpoint_name).string(), "is damaged"});
}

TEST_CASE("a damaged checkpoint that is set aside does not take the place of the sound one")
{
    const Checkpoints checkpoints(3);
    checkpoints.cut_off(checkpoint_name);
    set_damaged_checkpoint_aside(checkpoints.folder.path());
    CHECK(std::filesystem::exists(checkpoints.folder / damaged_checkpoint_name));
    checkpoints.write(4);
    checkpoints.cut_off(checkpoint_name);
    CHECK(checkpoints.found() == 2.0);
    remove_checkpoints(checkpoints.folder.path());
    CHECK(std::filesystem::is_empty(checkpoints.folder.path()));
}

TEST_CASE("two damaged checkpoints are an error with both names and the way out")
{
    const Checkpoints checkpoints(2);
    checkpoints.cut_off(checkpoint_name);
    checkpoints.cut_off(previous_checkpoint_name);
    check_mentions(message_of_error([&] { find_checkpoint(checkpoints.folder.path(), the_case); }),
                   {checkpoint_name, previous_checkpoint_name, "--overwrite"});
}

TEST_CASE("a checkpoint that cannot be read is neither damaged nor passed over for the one before it")
{
    const Checkpoints checkpoints(3);
    std::filesystem::remove(checkpoints.folder / checkpoint_name);
    std::filesystem::create_symlink(checkpoint_name, checkpoints.folder / checkpoint_name); // ELOOP, also for root
    CHECK_THROWS_AS(checkpoints.found(), FolderError);
    std::filesystem::remove(checkpoints.folder / checkpoint_name);
    REQUIRE(::mkfifo((checkpoints.folder / checkpoint_name).c_str(), 0600) == 0);
    check_mentions(message_of_error([&] { find_checkpoint(checkpoints.folder.path(), the_case); }),
                   {"is a pipe and not a regular file"});
}

TEST_CASE("a checkpoint of another case names the first key that differs, and one of another version says so")
{
    const Checkpoints checkpoints(1);
    const auto message = [&](const std::string& resolved) {
        try {
            find_checkpoint(checkpoints.folder.path(), resolved);
        } catch (const ForeignCheckpoint& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    check_mentions(message("title = \"a case\"\n\n[time]\nsafety = 0.8\n"),
                   {"another case", "time.safety is 0.85 there and 0.8 here", "--overwrite"});
    test::ArchiveContent content(checkpoints.folder / checkpoint_name);
    REQUIRE(content.entries[0].name == "format");
    content.entries[0].numbers.back() = 'x';
    content.write(checkpoints.folder / checkpoint_name);
    check_mentions(message(the_case), {"another version of the program", checkpoint_name});
    std::filesystem::remove(checkpoints.folder / checkpoint_name);
    test::write_bytes(checkpoints.folder / "checkpoint.h5", "of format 7");
    check_mentions(message(the_case), {"another version of the program", "checkpoint.h5"});
}

TEST_CASE("another title, other times of checkpoints and other folders of plugins do not keep a run from going on")
{
    const TemporaryRun run;
    const std::string other = "title = \"another # case\"\n\n[plugins]\npaths = [\"/b\"]\n\n[time]\nsafety = 0.85\n\n"
                              "[run]\ncheckpoint_every = 1.0  # s\nhistory_every = 1.0  # s\n";
    const FoundCheckpoint found = find_checkpoint(run.folder.path(), other);
    CHECK(found.archive);
    CHECK(found.differences == std::vector<std::string>{"title is \"a case\" there and \"another # case\" here",
                                                        "plugins.paths is [\"/a\"] there and [\"/b\"] here",
                                                        "run.checkpoint_every is 60.0 there and 1.0 here"});
    std::string changed = other;
    changed.replace(changed.find("history_every = 1.0"), 19, "history_every = 2.0");
    check_mentions(message_of_error([&] { find_checkpoint(run.folder.path(), changed); }),
                   {"run.history_every is 1.0 there and 2.0 here"});
}

TEST_CASE("a checkpoint that is in place is told, also when the folder does not get to the disk afterwards")
{
    const Checkpoints checkpoints(1);
    int placed = 0;
    const auto write = [&](const std::function<void(ArchiveWriter&)>& save) {
        write_checkpoint(checkpoints.folder.path(), the_case, save, [&] { ++placed; });
    };
    write([](ArchiveWriter& archive) { archive("step", 2.0); });
    CHECK(placed == 1);
    CHECK_THROWS(write([](ArchiveWriter&) { throw std::runtime_error("no memory"); }));
    CHECK(placed == 1);
    CHECK(checkpoints.found() == 2.0);
}

TEST_CASE("the difference of two cases is the first key whose value differs, with its tables and their numbers")
{
    const std::string text =
        "title = \"a # b\"  # said\n\n[body.sand]\nmaterial = \"sand\"\n\n[[stage]]\nname = \"one\"\n\n"
        "[stage.until]\nresidual = 0.001\n\n[[stage]]\nname = \"two\"\nduration = 1.0  # s\n\n[run]\n"
        "history_every = 0.1\n";
    const auto difference = [&](const std::string& from, const std::string& to) {
        std::string other = text;
        const std::size_t at = other.find(from);
        REQUIRE(at != std::string::npos);
        return case_difference(text, other.replace(at, from.size(), to));
    };
    CHECK(difference("# b", "# c") == "title is \"a # b\" there and \"a # c\" here");
    CHECK(difference("0.001", "0.01") == "stage.0.until.residual is 0.001 there and 0.01 here");
    CHECK(difference("1.0  # s", "2.0  # s") == "stage.1.duration is 1.0 there and 2.0 here");
    CHECK(difference("history_every", "energy_error_limit") == "run.history_every is only there");
    CHECK(difference("[run]\n", "[run]\nwindow = 1\n") == "run.window is only here");
    CHECK(difference("[run]\n", "[[stage]]\nname = \"three\"\n\n[run]\n") == "stage.2 is only here");
    CHECK(difference("[body.sand]", "[body.clay]") == "body.sand.material is only there");
}
