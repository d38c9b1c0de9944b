// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo inspect [NAME]`: what plugins there are and which parameters they take, as text, as a page of reference or
// for machines.
#include "case/resolved.hpp"
#include "case/value.hpp"
#include "cli/commands.hpp"
#include "sdk/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

namespace periporo::cli {
namespace {

using Row = std::vector<std::string>;

/// Rows as columns of even width; the last column is not padded.
std::string table(const std::vector<Row>& rows, const std::string& indent)
{
    std::vector<std::size_t> widths;
    for (const Row& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const Row& row : rows) {
        text += indent;
        for (std::size_t i = 0; i + 1 < row.size(); ++i)
            text += fmt::format("{:<{}}  ", row[i], widths[i]);
        text += row.back() + '\n';
    }
    return text;
}

std::string default_text(const Parameter& parameter)
{
    if (parameter.default_value)
        return toml_text(*parameter.default_value);
    return parameter.required ? "required" : "optional";
}

std::string meaning(const Parameter& parameter)
{
    return parameter.former_names.empty()
               ? parameter.documentation
               : fmt::format("{} (formerly {})", parameter.documentation, fmt::join(parameter.former_names, ", "));
}

std::string parameter_table(const std::vector<Parameter>& parameters)
{
    std::vector<Row> rows{{"PARAMETER", "UNIT", "RANGE", "DEFAULT", "MEANING"}};
    for (const Parameter& parameter : parameters)
        rows.push_back({parameter.name, type_text(parameter), parameter.range_text(), default_text(parameter),
                        meaning(parameter)});
    return parameters.empty() ? "  no parameters\n" : table(rows, "  ");
}

/// The plugins of a name, or all of them, by kind and name.
std::vector<const PluginRecord*> in_order(const PluginRegistry& registry, const std::string& name)
{
    std::vector<const PluginRecord*> plugins;
    for (const PluginRecord& plugin : registry.plugins())
        if (name.empty() || plugin.name == name)
            plugins.push_back(&plugin);
    std::sort(plugins.begin(), plugins.end(), [](const PluginRecord* a, const PluginRecord* b) {
        return std::tie(a->kind, a->name) < std::tie(b->kind, b->name);
    });
    return plugins;
}

std::string all_plugins(const PluginRegistry& registry)
{
    std::string text;
    std::optional<PluginKind> kind;
    std::vector<Row> rows;
    const auto end_kind = [&] {
        if (kind)
            text += fmt::format("{}\n{}", kind_name(*kind), table(rows, "  "));
        rows.clear();
    };
    for (const PluginRecord* plugin : in_order(registry, {})) {
        if (kind != plugin->kind)
            end_kind();
        kind = plugin->kind;
        rows.push_back({plugin->name, plugin->summary, plugin->file.string()});
    }
    end_kind();
    if (text.empty())
        text = "no plugins\n";
    text += "searched\n";
    for (const std::filesystem::path& folder : registry.searched())
        text += fmt::format("  {}\n", folder.string());
    if (!registry.failures().empty())
        text += "refused\n";
    for (const PluginFailure& failure : registry.failures())
        text += fmt::format("  {}: {}\n", failure.file.string(), failure.reason);
    return text;
}

/// @throws UsageError when no plugin has the name.
void demand(const PluginRegistry& registry, const std::string& name)
{
    if (name.empty() || !in_order(registry, name).empty())
        return;
    std::set<std::string> names;
    for (const PluginRecord& plugin : registry.plugins())
        names.insert(plugin.name);
    const std::optional<std::string> nearest = nearest_name(name, {names.begin(), names.end()});
    throw UsageError(fmt::format("there is no plugin '{}'{}\n{}", name,
                                 nearest ? fmt::format(", did you mean '{}'?", *nearest) : "", all_plugins(registry)));
}

/// The parameters of all plugins of one name.
std::string one_plugin(const PluginRegistry& registry, const std::string& name)
{
    std::string text;
    for (const PluginRecord* plugin : in_order(registry, name))
        text += fmt::format("{} {}: {}\n  provided by {}\n{}", kind_name(plugin->kind), plugin->name, plugin->summary,
                            plugin->file.string(), parameter_table(plugin->parameters));
    return text;
}

/// The same as a page of reference, of all plugins when there is no name.
std::string markdown(const PluginRegistry& registry, const std::string& name)
{
    const auto cell = [](std::string text) { // a bar would end the cell
        for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
            text.insert(at, 1, '\\');
        return text;
    };
    std::string text = "# Plugins\n";
    std::optional<PluginKind> kind;
    for (const PluginRecord* plugin : in_order(registry, name)) {
        if (kind != plugin->kind)
            text += fmt::format("\n## {}\n", kind_name(plugin->kind));
        kind = plugin->kind;
        text += fmt::format("\n### {}\n\n{}. Provided by `{}`.\n", plugin->name, plugin->summary,
                            plugin->file.filename().string());
        if (plugin->parameters.empty())
            continue;
        text += "\n| parameter | unit | range | default | meaning |\n|---|---|---|---|---|\n";
        for (const Parameter& p : plugin->parameters)
            text += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, cell(type_text(p)), cell(p.range_text()),
                                cell(default_text(p)), cell(meaning(p)));
    }
    return text;
}

nlohmann::json json_of(const Parameter& parameter)
{
    nlohmann::json record = {{"name", parameter.name},
                             {"unit", type_text(parameter)},
                             {"required", parameter.required},
                             {"range", parameter.range_text()},
                             {"meaning", parameter.documentation},
                             {"former_names", parameter.former_names}};
    if (parameter.default_value)
        std::visit([&](const auto& value) { record["default"] = value; }, *parameter.default_value);
    return record;
}

/// The same for machines; defaults in SI units.
std::string json(const PluginRegistry& registry, const std::string& name)
{
    nlohmann::json plugins = nlohmann::json::array();
    for (const PluginRecord* plugin : in_order(registry, name)) {
        nlohmann::json parameters = nlohmann::json::array();
        for (const Parameter& parameter : plugin->parameters)
            parameters.push_back(json_of(parameter));
        plugins.push_back({{"kind", kind_name(plugin->kind)},
                           {"name", plugin->name},
                           {"summary", plugin->summary},
                           {"file", plugin->file.string()},
                           {"parameters", parameters}});
    }
    return plugins.dump(2) + '\n';
}

} // namespace

ExitStatus inspect(const InspectArguments& arguments)
{
    PluginRegistry registry;
    registry.load_folders(plugin_search_path(arguments.plugin_folders, {}));
    demand(registry, arguments.name);
    const std::string& name = arguments.name;
    fmt::print("{}", arguments.markdown ? markdown(registry, name)
                     : arguments.json   ? json(registry, name)
                     : name.empty()     ? all_plugins(registry)
                                        : one_plugin(registry, name));
    return ExitStatus::done;
}

} // namespace periporo::cli
