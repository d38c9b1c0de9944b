// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo run CASE`: from a case file to results.
#include "scheduler/run.hpp"
#include "cli/command.hpp"
#include "cli/result_folder.hpp"
#include "cli/threads.hpp"
#include "cli/unfinished_run.hpp"

#include <csignal>
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
    check_result_folder(arguments.options.directory, existing);
    if (arguments.options.resume)
        require_unfinished_run(arguments.options.directory, description.resolved);
    std::optional<FolderLock> lock; // until the end of the run
    arguments.options.take_folder = [&] { lock.emplace(take_result_folder(arguments.options.directory, existing)); };
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
    command->add_flag("--overwrite", arguments->overwrite, "Delete the earlier results in the folder")
        ->excludes(resume);
    command
        ->add_option("--stop-after", arguments->options.stop_after,
                     "Stop with a checkpoint after so many steps of all stages")
        ->check(CLI::PositiveNumber)
        ->type_name("STEPS");
    command->add_flag("--quiet", arguments->options.quiet, "No progress on the terminal");
    command->footer("Example:\n"
                    "  periporo run my_case.toml --set body.column.material=sand --out results/sand --threads 2\n\n"
                    "Ctrl-C, SIGTERM, SIGHUP and --stop-after stop with a checkpoint; the same command with --resume "
                    "goes on.");
    command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

} // namespace periporo::cli
