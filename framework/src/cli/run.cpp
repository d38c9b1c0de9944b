// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo run CASE`: from a case file to results.
#include "scheduler/run.hpp"
#include "cli/command.hpp"
#include "cli/result_folder.hpp"
#include "cli/threads.hpp"
#include "cli/unfinished_run.hpp"
#include "scheduler/earlier_results.hpp"

#include <fmt/format.h>

#include <charconv>
#include <csignal>
#include <cstdint>
#include <memory>
#include <optional>

namespace periporo::cli {
namespace {

struct RunArguments {
    CaseArguments the_case;
    RunOptions options;
    bool overwrite = false;
};

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

/// What is wrong with a number of steps, or an empty text.
std::string objection_to_steps(const std::string& text)
{
    std::uint64_t steps = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), steps);
    if (error == std::errc() && end == text.data() + text.size() && steps >= 1)
        return {};
    return fmt::format("\"{}\" is no number of steps; give a whole number from 1", text);
}

ExitStatus run(RunArguments& arguments)
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
    std::optional<FolderLock> lock; // until the end of the run
    arguments.options.take_folder = [&](const InputHashes& inputs) {
        if (arguments.overwrite) // with the libraries that plugins have loaded meanwhile
            require_no_input_in(folder, files_of(inputs), of_writers);
        lock.emplace(take_result_folder(folder, existing, of_writers));
    };
    const RunOutcome outcome = run_case(description, registry, arguments.options);
    return outcome == RunOutcome::complete ? ExitStatus::done : ExitStatus::interrupted;
}

} // namespace

void add_run_command(CLI::App& program, Action& action)
{
    CLI::App* command = program.add_subcommand("run", "Run a case and write its results");
    const auto arguments = std::make_shared<RunArguments>();
    add_case_arguments(*command, arguments->the_case);
    command
        ->add_option("--out", arguments->options.directory, "Folder for the results (default: results/<name of CASE>)")
        ->type_name("DIR");
    add_threads(*command, arguments->options.threads);
    CLI::Option* resume =
        command->add_flag("--resume", arguments->options.resume, "Go on with the interrupted run in the folder");
    command
        ->add_flag("--without-lost-results", arguments->options.without_lost,
                   "With --resume: go on although snapshots or rows are gone; the results name them")
        ->needs(resume);
    command->add_flag("--overwrite", arguments->overwrite, "Delete the earlier results in the folder")
        ->excludes(resume);
    command
        ->add_option("--stop-after", arguments->options.stop_after,
                     "Stop with a checkpoint after so many steps of all stages")
        ->check(CLI::Validator(objection_to_steps, "", "steps"))
        ->type_name("STEPS");
    command->add_flag("--quiet", arguments->options.quiet, "No progress on the terminal");
    command->footer("Example:\n"
                    "  periporo run my_case.toml --set body.column.material=sand --out results/sand --threads 2\n\n"
                    "Ctrl-C, SIGTERM, SIGHUP and --stop-after stop with a checkpoint; the same command with --resume "
                    "goes on.");
    command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

} // namespace periporo::cli
