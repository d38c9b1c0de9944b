// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds [plugins] paths in the tree of a case.
#include "case/plugin_paths.hpp"

namespace periporo {

std::vector<std::filesystem::path> resolve_plugin_paths(CaseNode& root)
{
    std::vector<std::filesystem::path> paths;
    CaseEntry* plugins = root.find("plugins");
    CaseEntry* entry = plugins == nullptr ? nullptr : plugins->node.find("paths");
    CaseNode::Array* list = entry == nullptr ? nullptr : entry->node.array();
    if (list == nullptr)
        return paths;
    for (CaseNode& member : *list) {
        auto* text = std::get_if<std::string>(&member.value);
        if (text == nullptr)
            continue;
        const std::filesystem::path folder = member.place.source->file.parent_path();
        paths.push_back(std::filesystem::absolute(folder / *text).lexically_normal());
        *text = paths.back().string();
    }
    return paths;
}

} // namespace periporo
