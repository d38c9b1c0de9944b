// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "csv": every digit of the history, complete files, resumed runs.
#include "made_up_run.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include "periporo/earlier_output.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace {

using namespace periporo;
using test::TemporaryFolder;

std::string content(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    REQUIRE(stream.is_open());
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// What a run leaves that is stopped at a step.
void stop_at(const std::filesystem::path& folder, std::uint64_t step)
{
    const auto writer = test::output("csv");
    writer->begin(test::made_up_run(folder));
    test::give_steps(*writer, 0, step);
    writer->flush(step);
    writer->finish(false);
}

/// Resumes at a step and runs to step 60; @return what the writer says aloud.
/// @param losses what it notes as lost
std::string finish_from(const std::filesystem::path& folder, std::uint64_t step,
                        std::vector<std::string>* losses = nullptr)
{
    std::string said;
    RunDescription run = test::resumed_run(folder, step);
    run.warn = [&](const std::string& warning) { said += warning + '\n'; };
    if (losses != nullptr)
        run.note_loss = [losses](const std::string& words) { losses->push_back(words); };
    const auto writer = test::output("csv");
    writer->begin(run);
    test::give_steps(*writer, step + 1, 60);
    writer->finish(true);
    writer->clean_up();
    return said;
}

std::string whole_run(std::uint64_t last_step)
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("csv"), folder.path(), last_step);
    return content(folder / "history.csv");
}

} // namespace

TEST_CASE("the header names step and columns with their units, and each step is a row")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    writer->begin(test::made_up_run(folder.path()));
    writer->history(0, std::vector<double>{-0.5, 0.25, 3.0});
    writer->history(12, std::vector<double>{1e-9, 1e300, 0.0});
    writer->finish(true);
    CHECK(content(folder / "history.csv") == "step,time [s],kinetic_energy [J],free_grains [-]\n"
                                             "0,-0.5,0.25,3\n"
                                             "12,1e-09,1e+300,0\n");
}

TEST_CASE("every number reads back as the same double")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    RunDescription run = test::made_up_run(folder.path());
    run.history = {{"value", "-", ""}};
    writer->begin(run);
    std::vector<double> values{0.1, 1.0 / 3.0, std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::max(), -0.0};
    for (std::size_t i = 0; i < 200; ++i)
        values.push_back(test::made_up_value(i, i));
    for (std::size_t i = 0; i < values.size(); ++i)
        writer->history(i, std::span(&values[i], 1));
    writer->finish(true);
    std::istringstream lines(content(folder / "history.csv"));
    std::string line;
    std::getline(lines, line);
    for (const double value : values) {
        REQUIRE(std::getline(lines, line));
        const double read = std::strtod(line.c_str() + line.find(',') + 1, nullptr);
        CHECK(std::bit_cast<std::uint64_t>(read) == std::bit_cast<std::uint64_t>(value));
    }
    CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("a name with a comma or a quote is one cell")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    RunDescription run = test::made_up_run(folder.path());
    run.history = {{"height, \"front\"", "m", ""}};
    writer->begin(run);
    writer->finish(true);
    CHECK(content(folder / "history.csv") == "step,\"height, \"\"front\"\" [m]\"\n");
}

TEST_CASE("every row is in the file as soon as it is given, and a complete run leaves the file alone")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    writer->begin(test::made_up_run(folder.path()));
    for (std::uint64_t step = 0; step < 20; ++step) {
        test::give_steps(*writer, step, step);
        CHECK(content(folder / "history.csv") == whole_run(step));
    }
    writer->finish(true);
    writer->clean_up();
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("a run that was stopped and resumed leaves the same bytes as one that never stopped")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 40);
    CHECK(finish_from(folder.path(), 40).empty());
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE("a run that is resumed at a step whose row is there writes it once")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 40);
    const auto writer = test::output("csv");
    writer->begin(test::resumed_run(folder.path(), 40));
    test::give_steps(*writer, 40, 60);
    writer->finish(true);
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE(
    "after a kill in the middle of a row the run goes on from its checkpoint with the same bytes, and says nothing")
{
    const TemporaryFolder folder;
    {
        const auto killed = test::output("csv");
        killed->begin(test::made_up_run(folder.path()));
        test::give_steps(*killed, 0, 33);
        killed->flush(33);
        test::give_steps(*killed, 34, 47);
    }
    std::filesystem::resize_file(folder / "history.csv", std::filesystem::file_size(folder / "history.csv") - 9);
    CHECK(finish_from(folder.path(), 33).empty());
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE("a row that is damaged is noticed by its checksum; the sound ones stay and the damaged file is kept")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 33);
    const std::string sound = content(folder / "history.csv");
    const std::size_t at = sound.find("\n20,") + 4; // the time of step 20, one digit of it
    std::string damaged = sound;
    damaged[at] = damaged[at] == '1' ? '2' : '1';
    std::ofstream(folder / "history.csv", std::ios::binary) << damaged;
    test::check_mentions(finish_from(folder.path(), 33),
                         {(folder / "history.csv").string(), "33 rows are sound", "1 are lost", "history.csv.damaged"});
    CHECK(content(folder / "history.csv.damaged") == damaged);
    std::string expected = whole_run(60);
    const std::size_t row = expected.find("\n20,") + 1;
    expected.erase(row, expected.find('\n', row) + 1 - row);
    CHECK(content(folder / "history.csv") == expected);
}

TEST_CASE("rows that are missing at the end, or the whole file, are said, and the run goes on")
{
    const TemporaryFolder cut;
    stop_at(cut.path(), 33);
    const std::string rows = content(cut / "history.csv");
    std::ofstream(cut / "history.csv", std::ios::binary) << rows.substr(0, rows.find("\n30,") + 1);
    std::vector<std::string> losses;
    test::check_mentions(finish_from(cut.path(), 33, &losses), {"30 rows are sound", "4 are lost"});
    CHECK(losses == std::vector<std::string>{"4 rows of history.csv up to step 33"});
    const TemporaryFolder empty;
    stop_at(empty.path(), 33);
    std::filesystem::remove(empty / "history.csv");
    test::check_mentions(finish_from(empty.path(), 33), {"0 rows are sound", "34 are lost"});
    CHECK(content(empty / "history.csv").starts_with("step,time [s],kinetic_energy [J],free_grains [-]\n34,"));
}

TEST_CASE("without the checksums rows are kept by their form, and this is said")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 33);
    std::filesystem::remove(folder / "history.csv.journal");
    test::check_mentions(finish_from(folder.path(), 33), {"34 rows are sound", "history.csv.journal is damaged"});
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE("a file with other columns is kept under another name")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 33);
    std::ofstream(folder / "history.csv") << "step,time [s]\n0,0\n";
    test::check_mentions(finish_from(folder.path(), 33), {"history.csv.damaged"});
    CHECK(content(folder / "history.csv.damaged") == "step,time [s]\n0,0\n");
}

TEST_CASE("a directory that cannot be written is an error with the path and the reason")
{
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "not a directory";
    const auto writer = test::output("csv");
    test::check_mentions(test::message_of_error([&] { writer->begin(test::made_up_run(folder / "file")); }),
                         {(folder / "file" / "history.csv").string(), "Not a directory"});
}

TEST_CASE("the writer says how many rows it finds of an earlier run, and that a table is gone")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    const auto* reader = dynamic_cast<const EarlierOutputReader*>(writer.get());
    REQUIRE(reader != nullptr);
    CHECK(reader->earlier_output(folder.path()).holds.empty());
    CHECK(reader->earlier_output(folder.path()).missing_record.starts_with("history.csv"));
    test::write_whole_run(*test::output("csv"), folder.path(), 20);
    CHECK(reader->earlier_output(folder.path()).holds == std::vector<std::string>{"21 rows in history.csv"});
    CHECK(reader->earlier_output(folder.path()).missing_result.empty());
}
