// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo new KIND NAME`: a working project of a plugin outside the source tree.
#include "cli/commands.hpp"
#include "cli/plugin_name.hpp"
#include "cli/project_templates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

/// @throws UsageError when a new plugin of the kind cannot be called so.
void check_name(const NewArguments& arguments)
{
    if (const std::string objection = name_objection(arguments.name); !objection.empty())
        throw UsageError(fmt::format("'{}' cannot be the name of a plugin: {}", arguments.name, objection));
    PluginRegistry registry;
    registry.load_folders(plugin_search_path(arguments.plugin_folders, {}));
    for (const PluginRecord& plugin : registry.plugins())
        if (kind_name(plugin.kind) == arguments.kind && plugin.name == arguments.name)
            throw UsageError(fmt::format("there is a {} plugin '{}' already, in {}; choose another name",
                                         arguments.kind, arguments.name, plugin.file.string()));
}

void write(const fs::path& file, const std::string& text)
{
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    if (!stream.flush())
        throw std::runtime_error(fmt::format("cannot write {}", file.string()));
}

/// Writes the project into a folder that it makes, and returns the names of the files.
/// @throws UsageError when the folder exists or cannot be made.
std::vector<std::string> write_project(const std::string& kind, const std::string& name, const fs::path& folder)
{
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error)))
        throw UsageError(fmt::format("{} exists already; choose another name or --out DIR", folder.string()));
    fs::create_directories(folder, error);
    if (error)
        throw UsageError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
    std::vector<std::string> files;
    try {
        for (const ProjectTemplate& part : project_templates()) {
            if (part.kind != kind)
                continue;
            files.push_back(renamed(part.file, name));
            write(folder / files.back(), renamed(part.text, name));
        }
    } catch (...) { // half a project is none
        fs::remove_all(folder, error);
        throw;
    }
    return files;
}

/// A text as a shell takes it for one word.
std::string shell_word(const std::string& text)
{
    const bool plain = text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+:") ==
                       std::string::npos;
    if (plain && !text.empty())
        return text;
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + '\'';
}

/// What to type next, with the places of this very program and of the SDK beside it.
std::string next_commands(const std::string& name, const fs::path& folder, bool has_case)
{
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const std::string command = error ? "periporo" : shell_word(program.string());
    const std::string prefix = error ? "PREFIX" : shell_word(program.parent_path().parent_path().string());
    std::string text = fmt::format("Next:\n"
                                   "  cd {}\n"
                                   "  cmake -G Ninja -B build -DCMAKE_PREFIX_PATH={}\n"
                                   "  cmake --build build\n"
                                   "  ctest --test-dir build --output-on-failure\n"
                                   "  {} inspect {} --plugin-path build/lib/periporo\n",
                                   shell_word(folder.string()), prefix, command, name);
    if (has_case)
        text += fmt::format("  {} run {}.toml\n", command, name);
    return text;
}

} // namespace

ExitStatus write_new_plugin(const NewArguments& arguments)
{
    check_name(arguments);
    const fs::path folder = arguments.folder.empty() ? fs::path(arguments.name) : arguments.folder;
    const std::vector<std::string> files = write_project(arguments.kind, arguments.name, folder);
    fmt::print("Wrote {} plugin '{}' to {}: {}\n", arguments.kind, arguments.name, folder.string(),
               fmt::join(files, ", "));
    const bool has_case = std::find(files.begin(), files.end(), arguments.name + ".toml") != files.end();
    fmt::print("{}", next_commands(arguments.name, folder, has_case));
    return ExitStatus::done;
}

} // namespace periporo::cli
