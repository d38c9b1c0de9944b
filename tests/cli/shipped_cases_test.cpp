// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every case in the tree is a sound case.
#include "cli/program.hpp"

#include <doctest/doctest.h>

using namespace periporo::test;

TEST_CASE("every shipped case passes the check without a warning")
{
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(PERIPORO_SOURCE_DIR "/cases")) {
        const std::string name = entry.path().filename().string();
        // What ends in _base.toml is included by others and is no case by itself; cases/material holds paths of one
        // point, which drive_test.cpp runs; sweeps.toml lists runs of cases.
        if (entry.path().extension() != ".toml" || name.ends_with("_base.toml") || name == "sweeps.toml" ||
            entry.path().parent_path().filename() == "material")
            continue;
        ++count;
        // A fine case is built on a coarse lattice: its 1.9 GB say nothing more.
        const std::string coarse = name.ends_with("_fine.toml") ? " --set 'discretization.spacing=10 mm'" : "";
        const ProgramResult result = ProgramFolder().run("check '" + entry.path().string() + "'" + coarse);
        CAPTURE(result.error);
        CHECK(result.status == 0);
        CHECK(result.error.empty());
    }
    CHECK(count > 0);
}
