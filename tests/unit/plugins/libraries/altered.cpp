// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A library whose descriptor is wrong in one member: PERIPORO_ALTERATION, set by CMake, spoils `descriptor`. Calling
// anything of it ends the program, so a loader that calls before it has checked fails its test.
#include "periporo/plugin.hpp"

#include <cstdlib>

extern "C" __attribute__((visibility("default"))) const periporo::PluginDescriptor* periporo_plugin()
{
    static const periporo::PluginDescriptor altered = [] {
        periporo::PluginDescriptor descriptor{periporo::plugin_magic,
                                              periporo::plugin_api_version,
                                              sizeof(periporo::PluginDescriptor),
                                              alignof(periporo::PluginDescriptor),
                                              periporo::abi_fingerprint.data(),
                                              periporo::PluginKind::geometry,
                                              "altered",
                                              "Must be refused",
                                              [](std::vector<periporo::Parameter>&) { std::abort(); },
                                              [](const periporo::Parameters&, std::string&) -> void* { std::abort(); }};
        PERIPORO_ALTERATION;
        return descriptor;
    }();
    return &altered;
}
