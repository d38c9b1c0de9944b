// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the loader refuses, and that each refusal says expected against found.
#include "plugins/registry.hpp"

#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <string>

namespace {

using namespace periporo;
using test::check_mentions;

std::filesystem::path library(const std::string& variant)
{
    return std::filesystem::path(PERIPORO_TEST_LIBRARIES) / variant;
}

/// Loads the one library of the variant, which must be refused, and returns the reason.
std::string reason_of_refusal(const std::string& variant)
{
    PluginRegistry registry;
    registry.load_folders({library(variant)});
    CHECK(registry.plugins().empty());
    REQUIRE(registry.failures().size() == 1);
    CHECK(registry.failures().front().file.filename() == variant + ".so");
    return registry.failures().front().reason;
}

} // namespace

TEST_CASE("a library without the plugin symbol is refused by naming the symbol")
{
    check_mentions(reason_of_refusal("no_symbol"), {"periporo_plugin", "no symbol"});
}

TEST_CASE("a wrong magic number is refused with both numbers")
{
    check_mentions(reason_of_refusal("wrong_magic"), {"expected the magic number 0x70706f72", "found 0x12345678"});
}

TEST_CASE("a wrong API version is refused with both versions")
{
    check_mentions(reason_of_refusal("wrong_api_version"),
                   {"expected version " + std::to_string(plugin_api_version), "found 77"});
}

TEST_CASE("a descriptor of another size is refused with both sizes")
{
    check_mentions(reason_of_refusal("wrong_size"),
                   {"expected " + std::to_string(sizeof(PluginDescriptor)) + " bytes", "found 8"});
}

TEST_CASE("a descriptor of another alignment is refused with both alignments")
{
    check_mentions(reason_of_refusal("wrong_alignment"),
                   {"alignment of " + std::to_string(alignof(PluginDescriptor)) + " bytes", "found 512"});
}

TEST_CASE("a library built with other settings is refused with both fingerprints")
{
    check_mentions(reason_of_refusal("wrong_fingerprint"), {abi_fingerprint.data(), "found \"cfront 3\""});
}

TEST_CASE("a text file that calls itself a library is refused")
{
    const std::string reason = reason_of_refusal("text");
    check_mentions(reason, {"cannot be loaded", "text.so"});
    CHECK(reason.find("boost") == std::string::npos); // the message of the system alone
}

TEST_CASE("a library with an unresolved function is refused when it is loaded, by naming the function")
{
    check_mentions(reason_of_refusal("unresolved"), {"cannot be loaded", "periporo_nobody_provides_this"});
}

TEST_CASE("a descriptor of an unknown kind or with missing members is refused")
{
    const PluginDescriptor sound{plugin_magic,
                                 plugin_api_version,
                                 sizeof(PluginDescriptor),
                                 alignof(PluginDescriptor),
                                 abi_fingerprint.data(),
                                 PluginKind::geometry,
                                 "sound",
                                 "Accepted",
                                 [](std::vector<Parameter>&) {},
                                 [](const Parameters&, std::string&) -> void* { return nullptr; }};
    PluginRegistry registry;
    PluginDescriptor descriptor = sound;
    descriptor.kind = static_cast<PluginKind>(9);
    registry.add(descriptor, "unknown_kind.so");
    descriptor = sound;
    descriptor.name = "";
    registry.add(descriptor, "no_name.so");
    descriptor = sound;
    descriptor.create = nullptr;
    registry.add(descriptor, "no_create.so");
    REQUIRE(registry.failures().size() == 3);
    check_mentions(registry.failures()[0].reason, {"expected 1 to 5", "found 9"});
    check_mentions(registry.failures()[1].reason, {"names no plugin"});
    check_mentions(registry.failures()[2].reason, {"sound", "incomplete"});
    registry.add(sound, "sound.so");
    CHECK(registry.find(PluginKind::geometry, "sound") != nullptr);
}

TEST_CASE("a list of parameters that fails is a refusal with its message")
{
    static const PluginDescriptor descriptor{plugin_magic,
                                             plugin_api_version,
                                             sizeof(PluginDescriptor),
                                             alignof(PluginDescriptor),
                                             abi_fingerprint.data(),
                                             PluginKind::contact,
                                             "broken",
                                             "Its parameters() throws",
                                             [](std::vector<Parameter>&) { throw std::runtime_error("no list today"); },
                                             [](const Parameters&, std::string&) -> void* { return nullptr; }};
    PluginRegistry registry;
    registry.add(descriptor, "broken.so");
    REQUIRE(registry.failures().size() == 1);
    check_mentions(registry.failures().front().reason, {"parameters", "no list today"});
}
