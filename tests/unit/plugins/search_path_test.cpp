// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The order of the folders in which plugins are looked for.
#include "plugins/registry.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

namespace {

using periporo::plugin_search_path;
using Folders = std::vector<std::filesystem::path>;

const std::filesystem::path build_folder = std::filesystem::path(PERIPORO_BUILD_DIR) / "lib" / "periporo";

/// Sets the variable for one test.
class PluginPathVariable {
public:
    explicit PluginPathVariable(const char* value) { ::setenv("PERIPORO_PLUGIN_PATH", value, 1); }
    ~PluginPathVariable() { ::unsetenv("PERIPORO_PLUGIN_PATH"); }
    PluginPathVariable(const PluginPathVariable&) = delete;
    PluginPathVariable& operator=(const PluginPathVariable&) = delete;
};

} // namespace

TEST_CASE("command line, case, variable and build folder are searched in this order")
{
    const PluginPathVariable variable("/variable/one:/variable/two");
    CHECK(plugin_search_path({"/command"}, {"/case/one", "/case/two"}) ==
          Folders{"/command", "/case/one", "/case/two", "/variable/one", "/variable/two", build_folder});
}

TEST_CASE("without anything given a program of the build tree searches the build folder only")
{
    const PluginPathVariable variable("");
    CHECK(plugin_search_path({}, {}) == Folders{build_folder});
}

TEST_CASE("a folder that is given twice keeps its first place")
{
    const PluginPathVariable variable("/b::/a/../c:/a/");
    CHECK(plugin_search_path({"/a", "/b"}, {"/c", "/b/../b", build_folder}) == Folders{"/a", "/b", "/c", build_folder});
}
