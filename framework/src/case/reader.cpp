// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The way of a case: files, overrides, plugins, check, description.
#include "case/reader.hpp"

#include "case/build_description.hpp"
#include "case/checker.hpp"
#include "case/cross_checks.hpp"
#include "case/inputs.hpp"
#include "case/overrides.hpp"
#include "case/plugin_paths.hpp"
#include "case/resolved.hpp"
#include "case/toml_source.hpp"

namespace periporo {

CaseDescription read_case(const std::filesystem::path& file, const CaseOptions& options, PluginRegistry& registry)
{
    Diagnostics diagnostics;
    std::vector<std::filesystem::path> files_read;
    CaseNode root = read_toml_files(file, diagnostics, &files_read);
    apply_overrides(root, options.overrides, case_rules(), diagnostics);
    registry.load_folders(plugin_search_path(options.command_line_plugins, resolve_plugin_paths(root, diagnostics)));

    const CheckedTable checked = check_case(root, registry, diagnostics);
    check_together(checked, diagnostics);
    diagnostics.raise();
    try_plugins(checked, registry, diagnostics);
    try_contacts(checked, registry, diagnostics);
    diagnostics.raise();

    CaseDescription description = build_description(checked);
    description.file = file;
    for (const std::filesystem::path& read : files_read) {
        const std::size_t number = description.inputs.size();
        description.inputs.push_back({number == 0 ? "case" : "include " + std::to_string(number), read});
    }
    for (InputFile& named : files_named_by(checked, registry))
        description.inputs.push_back(std::move(named));
    description.places = places_of(checked);
    description.resolved = resolved_text(checked);
    description.warnings = diagnostics.warnings();
    return description;
}

} // namespace periporo
