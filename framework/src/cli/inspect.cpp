// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo inspect [NAME]`: what plugins there are and which parameters they take.
#include "case/resolved.hpp"
#include "case/value.hpp"
#include "cli/command.hpp"
#include "sdk/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

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

std::string parameter_table(const std::vector<Parameter>& parameters)
{
    std::vector<Row> rows{{"PARAMETER", "UNIT", "RANGE", "DEFAULT", "MEANING"}};
    for (const Parameter& parameter : parameters) {
        std::string documentation = parameter.documentation;
        if (!parameter.former_names.empty())
            documentation += fmt::format(" (formerly {})", fmt::join(parameter.former_names, ", "));
        rows.push_back({parameter.name, type_text(parameter), parameter.range_text(), default_text(parameter),
                        std::move(documentation)});
    }
    return parameters.empty() ? "  no parameters\n" : table(rows, "  ");
}

std::string all_plugins(const PluginRegistry& registry)
{
    std::string text;
    for (const PluginKind kind :
         {PluginKind::geometry, PluginKind::material, PluginKind::contact, PluginKind::retention, PluginKind::output}) {
        std::vector<Row> rows;
        for (const PluginRecord& plugin : registry.plugins())
            if (plugin.kind == kind)
                rows.push_back({plugin.name, plugin.summary, plugin.file.string()});
        std::sort(rows.begin(), rows.end());
        if (!rows.empty())
            text += fmt::format("{}\n{}", kind_name(kind), table(rows, "  "));
    }
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

/// All plugins of the name, of whatever kind.
/// @throws UsageError when there is none.
std::string one_plugin(const PluginRegistry& registry, const std::string& name)
{
    std::string text;
    std::set<std::string> names;
    for (const PluginRecord& plugin : registry.plugins()) {
        names.insert(plugin.name);
        if (plugin.name == name)
            text += fmt::format("{} {}: {}\n  provided by {}\n{}", kind_name(plugin.kind), plugin.name, plugin.summary,
                                plugin.file.string(), parameter_table(plugin.parameters));
    }
    if (!text.empty())
        return text;
    const std::optional<std::string> nearest = nearest_name(name, {names.begin(), names.end()});
    throw UsageError(fmt::format("there is no plugin '{}'{}\n{}", name,
                                 nearest ? fmt::format(", did you mean '{}'?", *nearest) : "", all_plugins(registry)));
}

} // namespace

void add_inspect_command(CLI::App& program, Action& action)
{
    struct Arguments {
        std::string name;
        std::vector<std::filesystem::path> folders;
    };
    CLI::App* command =
        program.add_subcommand("inspect", "List the plugins, or the parameters of one with units and defaults");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("NAME", arguments->name, "A plugin; all of them when left out")->type_name("");
    add_plugin_path(*command, arguments->folders);
    command->footer("Example:\n  periporo inspect viscoplastic_critical_state");
    command->callback([arguments, &action] {
        action = [arguments] {
            PluginRegistry registry;
            registry.load_folders(plugin_search_path(arguments->folders, {}));
            fmt::print("{}", arguments->name.empty() ? all_plugins(registry) : one_plugin(registry, arguments->name));
            return ExitStatus::done;
        };
    });
}

} // namespace periporo::cli
