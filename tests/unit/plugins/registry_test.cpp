// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finding plugins by kind and name, making their objects, and what is said when that cannot be done.
#include "plugins/registry.hpp"

#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <string>

namespace {

using namespace periporo;
using test::check_mentions;
using test::message_of_error;

const std::filesystem::path libraries = PERIPORO_TEST_LIBRARIES;

} // namespace

TEST_CASE("a plugin is found by kind and name with its summary, file and parameters")
{
    PluginRegistry registry;
    registry.load_folders({libraries / "speck"});
    const PluginRecord& record = registry.require(PluginKind::geometry, "speck");
    CHECK(record.kind == PluginKind::geometry);
    CHECK(record.summary == "A cube about the origin");
    CHECK(record.file == std::filesystem::canonical(libraries / "speck" / "speck.so"));
    REQUIRE(record.parameters.size() == 1);
    CHECK(record.parameters.front().name == "width");
    CHECK(registry.find(PluginKind::material, "speck") == nullptr);
}

TEST_CASE("an object made by a plugin computes with the parameters it was given")
{
    PluginRegistry registry;
    registry.load_folders({libraries / "speck"});
    Parameters parameters;
    parameters.set("width", 0.5);
    CHECK(registry.make_geometry("speck", parameters)->volume() == 0.125); // exact in binary
}

TEST_CASE("an object outlives the registry that made it")
{
    std::unique_ptr<Geometry> geometry;
    {
        PluginRegistry registry;
        registry.load_folders({libraries / "speck"});
        Parameters parameters;
        parameters.set("width", 1.0);
        geometry = registry.make_geometry("speck", parameters);
    }
    CHECK(geometry->contains(Vector3(0.5, 0.5, 0.5)));
}

TEST_CASE("a constructor that throws becomes an error with plugin, file and message")
{
    PluginRegistry registry;
    registry.load_folders({libraries / "speck"});
    Parameters parameters;
    parameters.set("width", 2.0);
    check_mentions(message_of_error([&] { registry.make_geometry("speck", parameters); }),
                   {"geometry plugin \"speck\"", "speck.so", "a speck is not wider than 1 m"});
}

TEST_CASE("two files with one kind and name are an error that names both")
{
    PluginRegistry registry;
    check_mentions(message_of_error([&] {
                       registry.load_folders({libraries / "speck", libraries / "speck_again"});
                   }),
                   {"two geometry plugins are named \"speck\"", "speck/speck.so", "speck_again/speck_again.so"});
}

TEST_CASE("one file reached through two folders is one plugin")
{
    const test::TemporaryFolder folder;
    std::filesystem::create_directory_symlink(libraries / "speck", folder / "link");
    PluginRegistry registry;
    registry.load_folders({libraries / "speck", folder / "link"});
    registry.load_folders({libraries / "speck"});
    CHECK(registry.plugins().size() == 1);
    CHECK(registry.searched().size() == 2);
}

TEST_CASE("a missing name is answered with the nearest name, all names, the folders and the refused libraries")
{
    PluginRegistry registry;
    registry.load_folders({libraries / "speck", libraries / "wrong_api_version", "/no/such/folder"});
    const std::string message = message_of_error([&] { registry.require(PluginKind::geometry, "spekc"); });
    check_mentions(message, {"no geometry plugin \"spekc\"", "did you mean speck?", "geometry plugins: speck",
                             (libraries / "speck").string(), "/no/such/folder (no such folder)",
                             "wrong_api_version.so: built for another plugin API", "found 77"});
    CHECK(message == registry.missing_message(PluginKind::geometry, "spekc"));
}

TEST_CASE("asking an empty registry says that nothing is loaded")
{
    const PluginRegistry registry;
    check_mentions(message_of_error([&] { registry.require(PluginKind::retention, "van_genuchten"); }),
                   {"no retention plugin is loaded", "folders searched: none"});
}

TEST_CASE("a good plugin is loaded although its neighbour in the folder is refused")
{
    const test::TemporaryFolder folder;
    std::filesystem::copy(libraries / "speck" / "speck.so", folder / "speck.so");
    std::filesystem::copy(libraries / "text" / "text.so", folder / "a_text.so");
    std::filesystem::copy(libraries / "text" / "text.so", folder / "text.txt");
    PluginRegistry registry;
    registry.load_folders({folder.path()});
    CHECK(registry.plugins().size() == 1);
    CHECK(registry.failures().size() == 1); // text.txt is not considered
}

TEST_CASE("a library that was cut off anywhere is refused, since loading it would end the program")
{
    const test::TemporaryFolder folder;
    const auto size = std::filesystem::file_size(libraries / "speck" / "speck.so");
    for (const std::uintmax_t length :
         {std::uintmax_t{0}, std::uintmax_t{40}, std::uintmax_t{100}, size / 4, size / 2, size - 1}) {
        CAPTURE(length);
        const std::filesystem::path file = folder / std::to_string(length) / "cut.so";
        std::filesystem::create_directory(file.parent_path());
        std::filesystem::copy(libraries / "speck" / "speck.so", file);
        std::filesystem::resize_file(file, length);
        PluginRegistry registry;
        registry.load_folders({file.parent_path()});
        CHECK(registry.plugins().empty());
        REQUIRE(registry.failures().size() == 1);
        const std::string& reason = registry.failures()[0].reason;
        const bool told =
            reason.find("cut off") != std::string::npos || reason.find("it is no shared library") != std::string::npos;
        CHECK_MESSAGE(told, reason);
    }
}

TEST_CASE("a pipe that calls itself a library is refused")
{
    const test::TemporaryFolder folder;
    REQUIRE(mkfifo((folder / "pipe.so").c_str(), 0600) == 0);
    PluginRegistry registry;
    registry.load_folders({folder.path()});
    REQUIRE(registry.failures().size() == 1);
    CHECK(registry.failures()[0].reason == "cannot be loaded: pipe.so: it is no regular file");
}
