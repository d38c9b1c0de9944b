// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds [plugins] paths in the tree of a case.
#include "case/plugin_paths.hpp"

#include <fmt/format.h>

#include <system_error>

namespace periporo {

std::vector<std::filesystem::path> resolve_plugin_paths(CaseNode& root, Diagnostics& diagnostics)
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
        if (text->empty()) {
            diagnostics.error(member.place, "'paths' of [plugins] names no folder: the text is empty",
                              "paths = [\"my_plugins\"]");
            continue;
        }
        const std::filesystem::path folder = member.place.source->file.parent_path();
        paths.push_back(std::filesystem::absolute(folder / *text).lexically_normal());
        *text = paths.back().string();
        std::error_code fault;
        if (!std::filesystem::is_directory(paths.back(), fault))
            diagnostics.warning(member.place,
                                fmt::format("'paths' of [plugins]: there is no folder {}", paths.back().string()));
    }
    return paths;
}

} // namespace periporo
