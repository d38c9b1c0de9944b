// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "csv": every digit of the history, complete files, resumed runs.
#include "made_up_run.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

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

TEST_CASE("the file has its name only when it is finished")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    writer->begin(test::made_up_run(folder.path()));
    test::give_steps(*writer, 0, 5);
    CHECK(std::filesystem::exists(folder / "history.csv.part"));
    CHECK_FALSE(std::filesystem::exists(folder / "history.csv"));
    writer->finish(false);
    CHECK_FALSE(std::filesystem::exists(folder / "history.csv.part"));
    CHECK(content(folder / "history.csv") == whole_run(5));
}

TEST_CASE("after a flush every row given so far is in the file")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    writer->begin(test::made_up_run(folder.path()));
    test::give_steps(*writer, 0, 20); // no whole number of the writer's own flushes
    writer->flush();
    CHECK(content(folder / "history.csv.part") == whole_run(20));
    writer->finish(false);
}

TEST_CASE("a run that was stopped and resumed leaves the same bytes as one that never stopped")
{
    const TemporaryFolder folder;
    const auto first = test::output("csv");
    first->begin(test::made_up_run(folder.path()));
    test::give_steps(*first, 0, 40);
    first->finish(false);
    const auto second = test::output("csv");
    second->begin(test::resumed_run(folder.path(), 40));
    test::give_steps(*second, 41, 60);
    second->finish(true);
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE("after a kill in the middle of a row the run goes on from its checkpoint with the same bytes")
{
    const TemporaryFolder folder;
    // What a kill leaves: rows after the checkpoint of step 33, the last one cut.
    const std::string rows = whole_run(47);
    std::ofstream(folder / "history.csv.part", std::ios::binary) << rows.substr(0, rows.size() - 9);
    const auto writer = test::output("csv");
    writer->begin(test::resumed_run(folder.path(), 33));
    test::give_steps(*writer, 34, 60);
    writer->finish(true);
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE("the part of a killed run goes before the file of an earlier one")
{
    const TemporaryFolder folder;
    std::ofstream(folder / "history.csv") << "of an earlier run\n";
    std::ofstream(folder / "history.csv.part") << whole_run(30);
    const auto writer = test::output("csv");
    writer->begin(test::resumed_run(folder.path(), 30));
    test::give_steps(*writer, 31, 60);
    writer->finish(true);
    CHECK(content(folder / "history.csv") == whole_run(60));
}

TEST_CASE("a run cannot be resumed without its file, or with other columns")
{
    const TemporaryFolder folder;
    const auto writer = test::output("csv");
    test::check_mentions(test::message_of_error([&] { writer->begin(test::resumed_run(folder.path(), 1)); }),
                         {"cannot resume", (folder / "history.csv").string()});
    std::ofstream(folder / "history.csv") << "step,time [s]\n0,0\n";
    test::check_mentions(test::message_of_error([&] { writer->begin(test::resumed_run(folder.path(), 1)); }),
                         {"cannot resume", (folder / "history.csv").string(), "step,time [s]", "kinetic_energy [J]"});
}

TEST_CASE("a directory that cannot be written is an error with the path and the reason")
{
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "not a directory";
    const auto writer = test::output("csv");
    test::check_mentions(test::message_of_error([&] { writer->begin(test::made_up_run(folder / "file")); }),
                         {(folder / "file" / "history.csv").string(), "Not a directory"});
}
