// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What holds for every material, for every material plugin of this build.
#include "support/material_examples.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

TEST_CASE("every material plugin passes the checks of the material kit with each of its examples")
{
    std::size_t checked = 0;
    for (const PluginRecord& plugin : built_plugins().plugins()) {
        if (plugin.kind != PluginKind::material)
            continue;
        std::vector<MaterialExample> examples;
        CHECK_NOTHROW_MESSAGE(examples = material_examples(plugin.name, plugin.parameters), plugin.name);
        for (const MaterialExample& example : examples) {
            const std::unique_ptr<Material> material = built_plugins().make_material(plugin.name, example.parameters);
            std::vector<std::string> faults = kit::check_parameters(plugin.parameters, example.parameters);
            for (std::string& fault : kit::check_material(*material, example.range))
                faults.push_back(std::move(fault));
            for (const std::string& fault : faults)
                MESSAGE(plugin.name << ", " << example.name << ": " << fault);
            CHECK(faults.empty());
            ++checked;
        }
    }
    CHECK(checked > 0);
}
