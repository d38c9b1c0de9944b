// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The way of a case: files, overrides, plugins, check, description.
#include "case/reader.hpp"

#include "case/build_description.hpp"
#include "case/checker.hpp"
#include "case/cross_checks.hpp"
#include "case/overrides.hpp"
#include "case/resolved.hpp"
#include "case/toml_source.hpp"

namespace periporo {
namespace {

/// Makes the paths of [plugins] absolute, each relative to the file it was written in (an override: to the current
/// folder), and returns them. What is not a list of texts is left for the check to report.
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

} // namespace

CaseDescription read_case(const std::filesystem::path& file, const CaseOptions& options, PluginRegistry& registry)
{
    Diagnostics diagnostics;
    CaseNode root = read_toml_files(file, diagnostics);
    apply_overrides(root, options.overrides, case_rules(), diagnostics);
    registry.load_folders(plugin_search_path(options.command_line_plugins, resolve_plugin_paths(root)));

    const CheckedTable checked = check_case(root, registry, diagnostics);
    check_together(checked, diagnostics);
    diagnostics.raise();
    try_plugins(checked, registry, diagnostics);
    diagnostics.raise();

    CaseDescription description = build_description(checked);
    description.file = file;
    description.resolved = resolved_text(checked);
    description.warnings = diagnostics.warnings();
    return description;
}

} // namespace periporo
