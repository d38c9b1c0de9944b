// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo new`: which names it takes, and what it writes. tests/sdk builds and runs what it writes.
#include "cli/program.hpp"
#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

using namespace periporo::test;

namespace {

const std::string kinds[] = {"material", "geometry", "contact", "retention", "output"};

/// Every file of the folder, by name.
std::map<std::string, std::string> files_in(const std::filesystem::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files[entry.path().filename().string()] = ProgramFolder::read(entry.path());
    return files;
}

} // namespace

TEST_CASE("a new plugin of each kind is a project that bears its name and no trace of the template's")
{
    for (const std::string& kind : kinds) {
        CAPTURE(kind);
        const ProgramFolder folder;
        const ProgramResult result = folder.run("new " + kind + " wet_clay2");
        CAPTURE(result.error);
        REQUIRE(result.status == 0);
        const auto files = files_in(folder.path() / "wet_clay2");
        for (const char* name : {"CMakeLists.txt", "README.md", "wet_clay2.hpp", "wet_clay2.cpp", "wet_clay2_test.cpp"})
            CHECK(files.count(name) == 1);
        for (const auto& [name, text] : files) {
            CAPTURE(name);
            CHECK(contains(result.out, name));
            for (const char* form : {"my_plugin", "MyPlugin", "my plugin", "Copyright"})
                CHECK_FALSE(contains(name + text, form));
        }
        CHECK(contains(files.at("wet_clay2.hpp"), "class WetClay2"));
        CHECK(contains(files.at("CMakeLists.txt"), "NAME wet_clay2 KIND " + kind));
    }
}

TEST_CASE("the CMakeLists of a new plugin has at most twelve lines")
{
    for (const std::string& kind : kinds) {
        const ProgramFolder folder;
        REQUIRE(folder.run("new " + kind + " wet_clay").status == 0);
        const std::string text = ProgramFolder::read(folder.path() / "wet_clay/CMakeLists.txt");
        CHECK(std::count(text.begin(), text.end(), '\n') <= 12);
    }
}

TEST_CASE("the new project says what to type next, with the places of this program")
{
    const ProgramFolder folder;
    const ProgramResult result = folder.run("new material wet_clay --out 'a lab/clay'");
    REQUIRE(result.status == 0);
    const std::string program = std::filesystem::canonical(PERIPORO_PROGRAM).string();
    check_mentions(result.out,
                   {"cd 'a lab/clay'", "cmake -G Ninja -B build -DCMAKE_PREFIX_PATH=", "cmake --build build",
                    "ctest --test-dir build", program, "inspect wet_clay", "run wet_clay.toml"});
    CHECK(files_in(folder.path() / "a lab/clay").count("wet_clay.toml") == 1);
}

TEST_CASE("a name that is not in lower snake case is refused and nothing is written")
{
    for (const std::string name : {"MyClay", "2clay", "my-clay", "my clay", "clay_", "_clay", "my__clay", "kl\xc3\xa4y",
                                   "../clay", "clay.cpp", ""}) {
        CAPTURE(name);
        const ProgramFolder folder;
        const ProgramResult result = folder.run("new material '" + name + "'");
        CHECK(result.status == 2);
        CHECK(contains(result.error, "lower-case letters, digits and single underscores"));
        CHECK(folder.entries().empty());
    }
}

TEST_CASE("a keyword of C++ is refused as a name")
{
    for (const std::string name : {"class", "co_await", "xor", "static_assert"}) {
        CAPTURE(name);
        const ProgramFolder folder;
        const ProgramResult result = folder.run("new geometry " + name);
        CHECK(result.status == 2);
        CHECK(contains(result.error, "keyword of C++"));
        CHECK(folder.entries().empty());
    }
}

TEST_CASE("the name of a plugin that is known is refused for its kind, with the file that has it")
{
    const ProgramFolder folder;
    const ProgramResult result = folder.run("new material linear_elastic");
    CHECK(result.status == 2);
    check_mentions(result.error, {"material plugin 'linear_elastic'", "periporo_material_linear_elastic.so"});
    CHECK(folder.entries().empty());
    CHECK(folder.run("new geometry linear_elastic").status == 0);
}

TEST_CASE("a kind that is none is refused with those that are")
{
    const ProgramFolder folder;
    const ProgramResult result = folder.run("new clay my_clay");
    CHECK(result.status == 2);
    for (const std::string& kind : kinds)
        CHECK(contains(result.error, kind));
    CHECK(folder.entries().empty());
}

TEST_CASE("a folder or a file that exists is refused and left as it is")
{
    const ProgramFolder folder;
    folder.write("wet_clay/thesis.txt", "years of work");
    folder.write("file", "of another");
    for (const std::string arguments : {"", "--out wet_clay", "--out file", "--out file/below"}) {
        CAPTURE(arguments);
        const ProgramResult result = folder.run("new material wet_clay " + arguments);
        CHECK(result.status == 2);
        CHECK_FALSE(result.error.empty());
    }
    CHECK(files_in(folder.path() / "wet_clay") == std::map<std::string, std::string>{{"thesis.txt", "years of work"}});
    CHECK(ProgramFolder::read(folder.path() / "file") == "of another");
}

TEST_CASE("new has a help with an example")
{
    const ProgramResult result = ProgramFolder().run("new --help");
    CHECK(result.status == 0);
    CHECK(contains(result.out, "Example:\n  periporo new material my_clay"));
}
