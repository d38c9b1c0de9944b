// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are complete or absent, and errors with the reason of the system.
#include "periporo/file.hpp"

#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <sys/stat.h>

#include <cerrno>
#include <fstream>
#include <utility>

using namespace periporo;
using test::TemporaryFolder;

TEST_CASE("the checksum is the CRC-32 of zlib, also in pieces")
{
    CHECK(crc32("123456789") == 0xcbf43926); // the check value of the standard
    CHECK(crc32("56789", crc32("1234")) == 0xcbf43926);
    CHECK(crc32("") == 0);
}

TEST_CASE("a file that is written whole replaces the earlier one, and no part is left")
{
    const TemporaryFolder folder;
    write_whole(folder / "file", "first");
    write_whole(folder / "file", std::string(100000, 'x'));
    CHECK(read_whole(folder / "file") == std::string(100000, 'x'));
    CHECK_FALSE(std::filesystem::exists(folder / "file.part"));
}

TEST_CASE("a reader of the earlier file keeps it")
{
    const TemporaryFolder folder;
    write_whole(folder / "file", "first");
    std::ifstream reader(folder / "file");
    write_whole(folder / "file", "second");
    std::string text;
    reader >> text;
    CHECK(text == "first");
}

TEST_CASE("an error has the deed, the path, the reason and a way out")
{
    const TemporaryFolder folder;
    test::check_mentions(
        test::message_of_error([&] { write_whole(folder / "none" / "file", "text"); }),
        {"cannot write " + (folder / "none" / "file").string(), "No such file or directory", "taken the folder away"});
    test::check_mentions(
        test::message_of_error([&] { static_cast<void>(size_of_file(folder / "none")); }),
        {"cannot read " + (folder / "none").string(), "No such file or directory", "taken the folder away"});
    test::check_mentions(FileError("cannot write", "out/file", ENOSPC).what(),
                         {"cannot write out/file: No space left on device; make room there"});
}

TEST_CASE("links are not followed")
{
    const TemporaryFolder folder;
    write_whole(folder / "target", "of somebody else");
    std::filesystem::create_symlink(folder / "target", folder / "link");
    CHECK_THROWS_AS(AppendedFile(folder / "link"), FileError);
    CHECK_THROWS_AS(read_whole(folder / "link"), FileError);
    write_whole(folder / "link", "mine"); // takes the place of the link
    CHECK(read_whole(folder / "target") == "of somebody else");
}

TEST_CASE("a damaged file gets a name that is free")
{
    const TemporaryFolder folder;
    for (const char* expected : {"file.damaged", "file.damaged.2", "file.damaged.3"}) {
        write_whole(folder / "file", expected);
        CHECK(set_aside(folder / "file") == folder / expected);
        CHECK(read_whole(folder / expected) == expected);
    }
}

TEST_CASE("an appended file grows and is cut, and notices that it was deleted or replaced")
{
    const TemporaryFolder folder;
    write_whole(folder / "file", "ab");
    AppendedFile file(folder / "file");
    file.append("cd");
    file.cut(3);
    file.append("e");
    file.synchronize();
    CHECK(read_whole(folder / "file") == "abce");
    write_whole(folder / "file", "another");
    CHECK_THROWS_AS(file.synchronize(), FileError);
    remove_file(folder / "file");
    CHECK_THROWS_AS(file.synchronize(), FileError);
    CHECK_NOTHROW(remove_file(folder / "file"));
}

TEST_CASE("a pipe, a folder or a device is no file to read or to append to, and nothing waits for its other end")
{
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "sub");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (const auto& [file, kind] : {std::pair(folder / "pipe", "a pipe"), std::pair(folder / "sub", "a folder"),
                                     std::pair(std::filesystem::path("/dev/null"), "a device")}) {
        const std::string words = file.string() + " is " + kind + " and not a regular file";
        test::check_mentions(test::message_of_error([&] { static_cast<void>(read_whole(file)); }), {words});
        test::check_mentions(test::message_of_error([&] { AppendedFile appended(file); }), {words});
        test::check_mentions(test::message_of_error([&] { require_regular(file); }), {words});
    }
    REQUIRE(::mkfifo((folder / "file.part").c_str(), 0600) == 0);
    test::check_mentions(test::message_of_error([&] { write_whole(folder / "file", "text"); }),
                         {"file.part is a pipe"});
    CHECK_NOTHROW(require_regular(folder / "none"));
}

TEST_CASE("the names in a folder are sorted, and a folder that is none is an error")
{
    const TemporaryFolder folder;
    for (const char* name : {"b", "a", "c"})
        write_whole(folder / name, "");
    CHECK(names_in(folder.path()) == std::vector<std::string>{"a", "b", "c"});
    CHECK_THROWS_AS(static_cast<void>(names_in(folder / "a")), FileError);
    CHECK_THROWS_AS(static_cast<void>(names_in(folder / "none")), FileError);
}

TEST_CASE("a file that may not be read advises to make it readable, and one that may not be written the folder")
{
    test::check_mentions(FileError("cannot read", "out/file", EACCES).what(), {"make it readable"});
    test::check_mentions(FileError("cannot write", "out/file", EACCES).what(), {"make the folder writable"});
}
