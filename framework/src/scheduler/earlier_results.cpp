// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Asks each writer of the case.
#include "scheduler/earlier_results.hpp"

#include "io/folder_error.hpp"
#include "periporo/earlier_output.hpp"

#include <exception>
#include <memory>
#include <system_error>

namespace periporo {
namespace {

void add(EarlierResults& results, const OutputWriter& writer, const std::filesystem::path& folder)
{
    const auto* reader = dynamic_cast<const EarlierOutputReader*>(&writer);
    if (reader == nullptr) { // nobody knows what its files are worth
        std::error_code ignored;
        for (const std::string& name : writer.files())
            if (std::filesystem::exists(std::filesystem::symlink_status(folder / name, ignored)))
                results.holds.push_back(name);
        return;
    }
    const EarlierOutput found = reader->earlier_output(folder);
    results.holds.insert(results.holds.end(), found.holds.begin(), found.holds.end());
    results.complete = results.complete || found.complete;
    if (!found.missing_result.empty())
        results.missing.push_back(found.missing_result);
}

} // namespace

EarlierResults earlier_results(const CaseDescription& description, const PluginRegistry& registry,
                               const std::filesystem::path& folder)
{
    EarlierResults results;
    try {
        for (const OutputDescription& output : description.outputs)
            add(results, *registry.make_output(output.writer.name, output.writer.parameters), folder);
    } catch (const std::exception& error) {
        throw FolderError(error.what());
    }
    return results;
}

std::vector<std::string> files_of_writers(const CaseDescription& description, const PluginRegistry& registry)
{
    std::vector<std::string> names;
    for (const OutputDescription& output : description.outputs)
        for (std::string& name : registry.make_output(output.writer.name, output.writer.parameters)->files())
            names.push_back(std::move(name));
    return names;
}

} // namespace periporo
