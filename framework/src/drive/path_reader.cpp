// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The way of a path: file, overrides, plugins, check, description.
#include "drive/path_reader.hpp"

#include "case/checker.hpp"
#include "case/cross_checks.hpp"
#include "case/overrides.hpp"
#include "case/plugin_paths.hpp"
#include "case/resolved.hpp"
#include "case/toml_source.hpp"
#include "drive/build_path.hpp"
#include "drive/path_checks.hpp"
#include "drive/path_schema.hpp"

namespace periporo {
namespace {

/// The state variables of the material, or nothing when its section is not sound. The names of [initial.state] depend
/// on them, so they are needed before the file as a whole is checked; what is wrong is reported then.
std::optional<std::vector<StateVariable>> state_variables_of(const CaseNode& root, const PluginRegistry& registry)
{
    const CaseEntry* section = root.find("material");
    if (section == nullptr)
        return std::nullopt;
    TableRules rules = path_rules({});
    rules.parameters.clear();
    std::erase_if(rules.nested, [](const NestedRules& nested) { return nested.name != "material"; });
    Diagnostics unsaid;
    const CheckedTable checked = check_case({CaseNode::Table{*section}, root.place}, rules, registry, unsaid);
    if (unsaid.failed() || checked.all("material").size() != 1)
        return std::nullopt;
    try {
        const CheckedTable& material = checked.one("material");
        return registry.make_material(material.own.text("model"), material.plugin)->state_variables();
    } catch (const PluginError&) {
        return std::nullopt;
    }
}

/// Takes [initial.state] out of the tree, where nothing can be said about it.
void drop_state(CaseNode& root)
{
    if (CaseEntry* initial = root.find("initial"); initial != nullptr && initial->node.table() != nullptr)
        std::erase_if(*initial->node.table(), [](const CaseEntry& entry) { return entry.key == "state"; });
}

} // namespace

PathDescription read_path(const std::filesystem::path& file, const CaseOptions& options, PluginRegistry& registry)
{
    Diagnostics diagnostics;
    CaseNode root = read_toml_files(file, diagnostics);
    apply_overrides(root, options.overrides, path_rules({}), diagnostics);
    registry.load_folders(plugin_search_path(options.command_line_plugins, resolve_plugin_paths(root, diagnostics)));

    const std::optional<std::vector<StateVariable>> state_variables = state_variables_of(root, registry);
    if (!state_variables)
        drop_state(root);
    const TableRules rules = path_rules(state_variables.value_or(std::vector<StateVariable>{}));
    const CheckedTable checked = check_case(root, rules, registry, diagnostics);
    check_path(checked, diagnostics);
    diagnostics.raise();
    try_plugins(checked, registry, diagnostics);
    diagnostics.raise();

    PathDescription path = build_path(checked);
    path.resolved = resolved_text(checked);
    path.warnings = diagnostics.warnings();
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& folder : options.command_line_plugins)
        folders.push_back(std::filesystem::absolute(folder).lexically_normal());
    path.plugin_paths.insert(path.plugin_paths.begin(), folders.begin(), folders.end());
    return path;
}

} // namespace periporo
