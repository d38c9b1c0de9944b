// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Archives: what is read is what was written, and a file is complete or absent.
#include "io/archive.hpp"

#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

namespace {

using namespace periporo;

using test::check_mentions;
using test::message_of_error;

} // namespace

TEST_CASE("reals come back bit by bit, those that are not numbers or not normal too")
{
    const test::TemporaryFolder folder;
    std::vector<double> values{0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::infinity(),
                               std::bit_cast<double>(std::uint64_t{0xfff8000000001234})}; // a NaN with a payload
    std::mt19937_64 random(1);
    for (int i = 0; i < 1000; ++i)
        values.push_back(std::bit_cast<double>(random()));
    {
        ArchiveWriter writer(folder / "state");
        writer.put("values", values);
        writer.commit();
    }
    const std::vector<double> read = ArchiveReader(folder / "state").reals("values");
    REQUIRE(read.size() == values.size());
    CHECK(std::memcmp(read.data(), values.data(), values.size() * sizeof(double)) == 0);
}

TEST_CASE("integers, bytes and texts come back as they were")
{
    const test::TemporaryFolder folder;
    const std::vector<std::int64_t> integers{std::numeric_limits<std::int64_t>::min(), -1, 0,
                                             std::numeric_limits<std::int64_t>::max()};
    const std::vector<std::uint8_t> bytes{0, 1, 127, 128, 255};
    using namespace std::string_literals;
    const std::string text = "suction \xcf\x83 with a \0 inside\n"s;
    {
        ArchiveWriter writer(folder / "state");
        writer.put("integers", integers);
        writer.put("bytes", bytes);
        writer.put("text", text);
        writer.commit();
    }
    const ArchiveReader reader(folder / "state");
    CHECK(reader.integers("integers") == integers);
    CHECK(reader.bytes("bytes") == bytes);
    CHECK(reader.text("text") == text);
}

TEST_CASE("an array whose parts lie apart is one array, and fills other parts of the same length together")
{
    const test::TemporaryFolder folder;
    const std::vector<double> first{1.0, 2.0}, second, third{3.0, -0.0, 5.0};
    {
        ArchiveWriter writer(folder / "state");
        writer.put_parts("values", std::vector<std::span<const double>>{first, second, third});
        writer.put_parts("nothing", {});
        writer.commit();
    }
    const ArchiveReader reader(folder / "state");
    CHECK(reader.reals("values") == std::vector{1.0, 2.0, 3.0, -0.0, 5.0});
    CHECK(reader.reals("nothing").empty());
    std::vector<double> head(4), tail(1);
    reader.read_parts("values", std::vector<std::span<double>>{head, tail});
    CHECK(head == std::vector{1.0, 2.0, 3.0, -0.0});
    CHECK(tail == std::vector{5.0});

    std::vector<double> longer(2);
    const std::string message = message_of_error([&] {
        reader.read_parts("values", std::vector<std::span<double>>{head, longer});
    });
    check_mentions(message, {"values", "5 values instead of 6", "state"});
}

TEST_CASE("empty arrays and an empty text are there and empty")
{
    const test::TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "state");
        writer.put("reals", std::span<const double>());
        writer.put("integers", std::span<const std::int64_t>());
        writer.put("bytes", std::span<const std::uint8_t>());
        writer.put("text", std::string());
        writer.commit();
    }
    const ArchiveReader reader(folder / "state");
    CHECK(reader.has("reals"));
    CHECK(reader.reals("reals").empty());
    CHECK(reader.integers("integers").empty());
    CHECK(reader.bytes("bytes").empty());
    CHECK(reader.text("text").empty());
}

TEST_CASE("a name may lie in groups, and has() answers for every part of it")
{
    const test::TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "state");
        writer.put("body/column/stress", std::vector<double>{1.5});
        writer.commit();
    }
    const ArchiveReader reader(folder / "state");
    CHECK(reader.reals("body/column/stress") == std::vector<double>{1.5});
    CHECK(reader.has("body/column/stress"));
    CHECK_FALSE(reader.has("body/column")); // a group, no array
    CHECK_FALSE(reader.has("body/ground/stress"));
    CHECK_FALSE(reader.has(""));
}

TEST_CASE("a missing name is an error with the name and the file")
{
    const test::TemporaryFolder folder;
    ArchiveWriter(folder / "state").commit();
    const ArchiveReader reader(folder / "state");
    const std::string message = message_of_error([&] { reader.reals("stress"); });
    check_mentions(message, {"\"stress\"", (folder / "state").string()});
}

TEST_CASE("a value of another type is an error and not a conversion")
{
    const test::TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "state");
        writer.put("count", std::vector<std::int64_t>{7});
        writer.commit();
    }
    const ArchiveReader reader(folder / "state");
    check_mentions(message_of_error([&] { reader.reals("count"); }), {"not an array of reals"});
    check_mentions(message_of_error([&] { reader.bytes("count"); }), {"not an array of bytes"});
    check_mentions(message_of_error([&] { reader.text("count"); }), {"not a text"});
}

TEST_CASE("a name that is written twice is an error with the name")
{
    const test::TemporaryFolder folder;
    ArchiveWriter writer(folder / "state");
    writer.put("step", std::vector<std::int64_t>{1});
    check_mentions(message_of_error([&] { writer.put("step", std::vector<std::int64_t>{2}); }), {"\"step\""});
}

TEST_CASE("before the commit the earlier archive stays, and without it nothing is left behind")
{
    const test::TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "state");
        writer.put("step", std::vector<std::int64_t>{1});
        writer.commit();
    }
    {
        ArchiveWriter writer(folder / "state");
        writer.put("step", std::vector<std::int64_t>{2});
        CHECK(std::filesystem::exists(folder / "state.part"));
        CHECK(ArchiveReader(folder / "state").integers("step").front() == 1);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "state.part"));
    CHECK(ArchiveReader(folder / "state").integers("step").front() == 1);
}

TEST_CASE("a commit replaces the earlier archive and leaves no part behind")
{
    const test::TemporaryFolder folder;
    for (const std::int64_t step : {1, 2}) {
        ArchiveWriter writer(folder / "state");
        writer.put("step", std::vector<std::int64_t>{step});
        writer.commit();
    }
    CHECK(ArchiveReader(folder / "state").integers("step").front() == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "state.part"));
}

TEST_CASE("a path that cannot be written is an error with the path and the reason")
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "not a folder";
    const std::string message = message_of_error([&] { ArchiveWriter writer(folder / "file" / "state"); });
    check_mentions(message, {(folder / "file" / "state").string(), "Not a directory"});
}

TEST_CASE("a missing file and a file that is no archive are errors with the path")
{
    const test::TemporaryFolder folder;
    const std::string missing = message_of_error([&] { ArchiveReader reader(folder / "none"); });
    check_mentions(missing, {(folder / "none").string(), "No such file"});
    std::ofstream(folder / "text") << "no archive";
    check_mentions(message_of_error([&] { ArchiveReader reader(folder / "text"); }), {(folder / "text").string()});
}
