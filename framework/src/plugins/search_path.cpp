// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The folders in which plugins are looked for.
#include "plugins/registry.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace periporo {

namespace {

using std::filesystem::path;

bool lies_in(const path& file, const path& folder)
{
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// The plugins that belong to the running program: those that lie beside it as in a build folder or in an installation,
/// wherever that was moved to; for another program of the build tree those of the build; for a program that was taken
/// out of its installation those of the configured one.
path own_plugins()
{
    std::error_code error;
    const path build_plugins = PERIPORO_BUILD_PLUGINS;
    const path program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) {
        path beside = (program.parent_path() / PERIPORO_PLUGINS_FROM_PROGRAM).lexically_normal();
        if (std::filesystem::is_directory(beside, error))
            return std::filesystem::equivalent(beside, build_plugins, error) ? build_plugins : beside;
        // <build>/lib/periporo
        const path build = std::filesystem::weakly_canonical(build_plugins.parent_path().parent_path(), error);
        if (!error && lies_in(program, build))
            return build_plugins;
    }
    return PERIPORO_INSTALL_PLUGINS;
}

/// Two spellings of one folder are one folder.
path identity(const path& folder)
{
    std::error_code error;
    path canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(folder, error), error);
    if (error)
        canonical = folder.lexically_normal();
    return canonical.has_filename() ? canonical : canonical.parent_path(); // without a slash at its end
}

} // namespace

std::vector<path> plugin_search_path(const std::vector<path>& command_line, const std::vector<path>& from_case)
{
    std::vector<path> folders;
    std::vector<path> identities;
    const auto add = [&](const path& folder) {
        if (folder.empty())
            return;
        path id = identity(folder);
        if (std::find(identities.begin(), identities.end(), id) != identities.end())
            return;
        identities.push_back(std::move(id));
        folders.push_back(folder);
    };
    for (const path& folder : command_line)
        add(folder);
    for (const path& folder : from_case)
        add(folder);
    if (const char* variable = std::getenv("PERIPORO_PLUGIN_PATH")) {
        std::string_view rest = variable;
        while (!rest.empty()) {
            const std::string_view folder = rest.substr(0, rest.find(':'));
            add(path(folder));
            rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
        }
    }
    add(own_plugins());
    return folders;
}

} // namespace periporo
