// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo run CASE`: from a case file to results.
#include "cli/commands.hpp"
#include "cli/places.hpp"
#include "cli/result_folder.hpp"
#include "cli/threads.hpp"
#include "cli/unfinished_run.hpp"
#include "scheduler/earlier_results.hpp"

#include <csignal>
#include <optional>

namespace periporo::cli {
namespace {

ExistingResults existing_results(const RunArguments& arguments)
{
    if (arguments.overwrite)
        return ExistingResults::overwrite;
    return arguments.options.resume ? ExistingResults::resume : ExistingResults::refuse;
}

std::vector<std::filesystem::path> files_of(const std::vector<InputFile>& inputs)
{
    std::vector<std::filesystem::path> files;
    for (const InputFile& input : inputs)
        files.push_back(input.file);
    return files;
}

std::vector<std::filesystem::path> files_of(const InputHashes& inputs)
{
    std::vector<std::filesystem::path> files;
    for (const auto& [role, input] : inputs.entries())
        files.push_back(input.file);
    return files;
}

} // namespace

ExitStatus run(RunArguments arguments)
{
    // The run outlives its terminal, and a file that may not grow is an error of the write with its message.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    // The whole case is checked before anything is written or deleted. Its warnings are the first lines of the log.
    use_threads(arguments.options.threads);
    PluginRegistry registry;
    const CaseDescription description = read_case(arguments.the_case.file, arguments.the_case.options, registry);
    if (arguments.options.directory.empty())
        arguments.options.directory = default_result_folder(arguments.the_case.file);
    const ExistingResults existing = existing_results(arguments);
    const std::filesystem::path& folder = arguments.options.directory;
    const std::vector<std::string> of_writers = files_of_writers(description, registry);
    check_result_folder(folder, existing, of_writers);
    if (arguments.options.resume)
        require_unfinished_run(folder, description, registry);
    if (arguments.overwrite)
        require_no_input_in(folder, files_of(description.inputs), of_writers);
    require_possible_folder(folder);
    std::optional<FolderLock> lock; // until the end of the run
    arguments.options.take_folder = [&](const InputHashes& inputs) {
        if (arguments.overwrite) // with the libraries that plugins have loaded meanwhile
            require_no_input_in(folder, files_of(inputs), of_writers);
        lock.emplace(take_result_folder(folder, existing, of_writers));
    };
    const RunOutcome outcome = run_case(description, registry, arguments.options);
    return outcome == RunOutcome::complete ? ExitStatus::done : ExitStatus::interrupted;
}

} // namespace periporo::cli
