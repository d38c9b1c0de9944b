// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Archives: what is read is what was written, a file is complete or absent, and nothing in it is believed.
#include "io/archive.hpp"

#include "support/archives.hpp"
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

constexpr std::size_t any_length = 1000000;

/// A value of every kind, a list of every kind, and a part within a part.
struct Inner {
    std::vector<Vector3> places;

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        visit("places", empty_or(self.places, points));
    }
};
struct Outer {
    double real = 0.0;
    bool yes = false;
    std::uint64_t number = 0;
    std::vector<std::int64_t> integers;
    std::vector<std::uint32_t> numbers;
    std::vector<std::uint8_t> bytes;
    std::string text;
    Inner inner;

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("real", self.real);
        visit("yes", self.yes);
        visit("number", self.number);
        visit("integers", at_most(self.integers, 10));
        visit("numbers", at_most(self.numbers, 10));
        visit("bytes", at_most(self.bytes, 10));
        visit("text", at_most(self.text, 100));
        visit.part("inner", self.inner, std::size_t{2});
    }
};

Outer sample()
{
    using namespace std::string_literals;
    Outer outer;
    outer.real = -0.0;
    outer.yes = true;
    outer.number = std::numeric_limits<std::uint64_t>::max();
    outer.integers = {std::numeric_limits<std::int64_t>::min(), -1, 0, std::numeric_limits<std::int64_t>::max()};
    outer.numbers = {0, 7, std::numeric_limits<std::uint32_t>::max()};
    outer.bytes = {0, 1, 127, 128, 255};
    outer.text = "suction \xcf\x83 with a \0 inside\n"s;
    outer.inner.places = {{1.0, 2.0, 3.0}, {-4.0, 5e-324, 6e300}};
    return outer;
}

/// A list under the name "list", as the only entry.
template <class Value>
void write_list(const std::filesystem::path& file, const std::vector<Value>& list)
{
    ArchiveWriter writer(file);
    writer("list", list);
    writer.commit();
}

template <class Value>
std::vector<Value> read_list(const std::filesystem::path& file)
{
    std::vector<Value> list;
    ArchiveReader reader(file);
    reader("list", at_most(list, any_length));
    return list;
}

} // namespace

TEST_CASE("reals come back bit by bit, those that are not numbers or not normal too")
{
    const test::TemporaryFolder folder;
    std::vector<double> values{0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::infinity(),
                               std::bit_cast<double>(std::uint64_t{0xfff8000000001234})}; // a NaN with a payload
    std::mt19937_64 random(1);
    for (int i = 0; i < 300000; ++i) // more than the buffer of a writer
        values.push_back(std::bit_cast<double>(random()));
    write_list(folder / "state", values);
    std::vector<double> read;
    ArchiveReader(folder / "state")("list", any_reals(at_most(read, any_length)));
    REQUIRE(read.size() == values.size());
    CHECK(std::memcmp(read.data(), values.data(), values.size() * sizeof(double)) == 0);
}

TEST_CASE("a part comes back as it was, with the parts within it")
{
    const Outer written = sample();
    Outer read;
    test::save_and_restore(written, read);
    CHECK(std::bit_cast<std::uint64_t>(read.real) == std::bit_cast<std::uint64_t>(written.real));
    CHECK(read.yes);
    CHECK(read.number == written.number);
    CHECK(read.integers == written.integers);
    CHECK(read.numbers == written.numbers);
    CHECK(read.bytes == written.bytes);
    CHECK(read.text == written.text);
    CHECK(read.inner.places == written.inner.places);
}

TEST_CASE("empty lists and an empty text are there and empty")
{
    Outer read = sample();
    test::save_and_restore(Outer(), read);
    CHECK(read.integers.empty());
    CHECK(read.bytes.empty());
    CHECK(read.text.empty());
    CHECK(read.inner.places.empty());
}

TEST_CASE("names lie in the groups of their parts")
{
    const test::TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "state");
        writer.part("outer", sample());
        writer.commit();
    }
    const ArchiveReader reader(folder / "state");
    CHECK(reader.has("outer/real"));
    CHECK(reader.has("outer/inner/places"));
    CHECK_FALSE(reader.has("outer"));
    CHECK_FALSE(reader.has("places"));
    CHECK_FALSE(reader.has(""));
}

TEST_CASE("a missing name is an error with the name and the file")
{
    const test::TemporaryFolder folder;
    ArchiveWriter(folder / "state").commit();
    ArchiveReader reader(folder / "state");
    double value = 0.0;
    const std::string message = message_of_error([&] { reader("stress", value); });
    check_mentions(message, {"\"stress\"", (folder / "state").string()});
}

TEST_CASE("a value of another kind is an error and not a conversion")
{
    const test::TemporaryFolder folder;
    write_list(folder / "state", std::vector<std::int64_t>{7});
    check_mentions(message_of_error([&] { read_list<double>(folder / "state"); }), {"\"list\"", "another kind"});
    check_mentions(message_of_error([&] { read_list<std::uint8_t>(folder / "state"); }), {"\"list\"", "another kind"});
}

TEST_CASE("a list keeps its length unless its owner allows another")
{
    const test::TemporaryFolder folder;
    write_list(folder / "state", std::vector<double>{1.0, 2.0, 3.0});
    ArchiveReader reader(folder / "state");
    std::vector<double> list(2);
    check_mentions(message_of_error([&] { reader("list", list); }), {"\"list\"", "3 values instead of 2", "state"});
    check_mentions(message_of_error([&] { reader("list", empty_or(list, 4)); }), {"3 values instead of 4"});
    check_mentions(message_of_error([&] { reader("list", at_most(list, 2)); }), {"3 values instead of 0 to 2"});
    check_mentions(message_of_error([&] { reader("list", exactly(list, 0)); }), {"3 values instead of 0"});
    CHECK(list.size() == 2); // nothing was made for them
    std::vector<Vector3> vectors;
    reader("list", at_most(vectors, 1));
    CHECK(vectors == std::vector<Vector3>{{1.0, 2.0, 3.0}});
    double value = 0.0;
    check_mentions(message_of_error([&] { reader("list", value); }), {"3 values instead of 1"});
}

TEST_CASE("numbers that are no whole vectors are no list of vectors")
{
    const test::TemporaryFolder folder;
    write_list(folder / "state", std::vector<double>{1.0, 2.0});
    check_mentions(message_of_error([&] { read_list<Vector3>(folder / "state"); }), {"\"list\" in", "2 numbers"});
}

TEST_CASE("reals that are not finite are refused unless their owner allows them")
{
    const test::TemporaryFolder folder;
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        write_list(folder / "state", std::vector<double>{1.0, value});
        check_mentions(message_of_error([&] { read_list<double>(folder / "state"); }), {"\"list\"", "not finite"});
    }
}

TEST_CASE("a name that is written twice is an error with the name")
{
    const test::TemporaryFolder folder;
    ArchiveWriter writer(folder / "state");
    writer("step", 1.0);
    check_mentions(message_of_error([&] { writer("step", 2.0); }), {"\"step\""});
}

TEST_CASE("before the commit the earlier archive stays, and without it nothing is left behind")
{
    const test::TemporaryFolder folder;
    write_list(folder / "state", std::vector<double>{1.0});
    {
        ArchiveWriter writer(folder / "state");
        writer("list", std::vector<double>{2.0});
        CHECK(std::filesystem::exists(folder / "state.part"));
        CHECK(read_list<double>(folder / "state").front() == 1.0);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "state.part"));
    CHECK(read_list<double>(folder / "state").front() == 1.0);
}

TEST_CASE("a commit replaces the earlier archive, or gives it another name, and leaves no part behind")
{
    const test::TemporaryFolder folder;
    for (const double step : {1.0, 2.0, 3.0}) {
        ArchiveWriter writer(folder / "state");
        writer("list", std::vector<double>{step});
        writer.commit(step == 3.0 ? folder / "before" : std::filesystem::path());
    }
    CHECK(read_list<double>(folder / "state").front() == 3.0);
    CHECK(read_list<double>(folder / "before").front() == 2.0);
    CHECK_FALSE(std::filesystem::exists(folder / "state.part"));
}

TEST_CASE("a path that cannot be written is an error with the path and the reason")
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "not a folder";
    const std::string message = message_of_error([&] { ArchiveWriter writer(folder / "file" / "state"); });
    check_mentions(message, {(folder / "file" / "state").string(), "Not a directory"});
}

TEST_CASE("what is no archive is an error with the path")
{
    const test::TemporaryFolder folder;
    const auto message = [&](const char* name) {
        return message_of_error([&] { ArchiveReader reader(folder / name); });
    };
    check_mentions(message("none"), {(folder / "none").string(), "No such file"});
    test::write_bytes(folder / "empty", "");
    check_mentions(message("empty"), {(folder / "empty").string(), "damaged"});
    test::write_bytes(folder / "text", "a text that is long enough to be an archive, but is none\n");
    check_mentions(message("text"), {(folder / "text").string(), "damaged"});
    std::filesystem::create_directory(folder / "folder");
    check_mentions(message("folder"), {(folder / "folder").string()});
}

TEST_CASE("an archive with any bit flipped, cut off anywhere or with bytes behind its end is refused")
{
    const test::TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "state");
        writer.part("outer", sample());
        writer.commit();
    }
    const std::string sound = test::bytes_of(folder / "state");
    const auto refused = [&](const std::string& bytes) {
        test::write_bytes(folder / "damaged", bytes);
        try {
            const ArchiveReader reader(folder / "damaged");
        } catch (const ArchiveError& error) {
            return std::string(error.what()).find("damaged is damaged: ") != std::string::npos;
        }
        return false;
    };
    REQUIRE_FALSE(refused(sound));
    std::size_t accepted = 0;
    for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
        std::string damaged = sound;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
        accepted += refused(damaged) ? 0 : 1;
    }
    for (std::size_t length = 0; length < sound.size(); ++length)
        accepted += refused(sound.substr(0, length)) ? 0 : 1;
    for (const std::string& more : {std::string(1, '\0'), std::string("more"), sound})
        accepted += refused(sound + more) ? 0 : 1;
    CHECK(accepted == 0);
}

TEST_CASE("an archive with a right checksum and senseless entries is refused without memory for them")
{
    const test::TemporaryFolder folder;
    write_list(folder / "state", std::vector<double>{1.0, 2.0, 3.0});
    const test::ArchiveContent sound(folder / "state");
    sound.write(folder / "forged");
    REQUIRE(read_list<double>(folder / "forged").size() == 3); // the forgery itself is sound
    const auto message = [&](auto&& forge) {
        test::ArchiveContent content = sound;
        forge(content.entries);
        content.write(folder / "forged");
        return message_of_error([&] { read_list<double>(folder / "forged"); });
    };
    using Entries = std::vector<test::ArchiveContent::Entry>;
    for (const std::uint64_t count : {std::uint64_t{4}, std::uint64_t{1} << 40, ~std::uint64_t{0} / 8})
        check_mentions(message([&](Entries& entries) { entries[0].count = count; }), {"\"list\" is longer"});
    check_mentions(message([](Entries& entries) { entries[0].count = 2; }), {"damaged"}); // what is left is no entry
    check_mentions(message([](Entries& entries) { entries[0].kind = static_cast<StoredKind>(99); }), {"no kind"});
    check_mentions(message([](Entries& entries) { entries[0].name = ""; }), {"no name"});
    check_mentions(message([](Entries& entries) { entries.push_back(entries[0]); }), {"\"list\" twice"});
}
