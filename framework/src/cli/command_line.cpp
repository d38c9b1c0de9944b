// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Options and help of every command. Each command leaves its action behind when it is the one that was asked for.
#include "cli/command_line.hpp"

#include "cli/commands.hpp"
#include "cli/threads.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdint>
#include <memory>

namespace periporo::cli {
namespace {

/// An option that may be repeated and takes one text each time, so that it never swallows the case file.
template <class Member>
CLI::Option* add_repeatable(CLI::App& command, const std::string& name, std::vector<Member>& values,
                            const std::string& documentation)
{
    return command.add_option(name, values, documentation)->type_size(1)->allow_extra_args(false)->take_all();
}

std::string objection_to_plugin_folder(const std::string& text)
{
    std::error_code error;
    if (std::filesystem::is_directory(text, error))
        return {};
    return fmt::format("there is no folder \"{}\"", text);
}

/// Adds --plugin-path.
void add_plugin_path(CLI::App& command, std::vector<std::filesystem::path>& folders)
{
    add_repeatable(command, "--plugin-path", folders, "Folder of plugin libraries, searched first; may be repeated")
        ->check(CLI::Validator(objection_to_plugin_folder, "", "plugins"))
        ->type_name("DIR");
}

/// Adds CASE, --set and --plugin-path.
void add_case_arguments(CLI::App& command, CaseArguments& arguments)
{
    command.add_option("CASE", arguments.file, "The case file")->required()->type_name("FILE");
    add_repeatable(
        command, "--set", arguments.options.overrides,
        "Override a value of the case; may be repeated. Entries of lists go by name, stage.collapse.duration, "
        "or by number from 0, contact.0.friction")
        ->type_name("KEY=VALUE");
    add_plugin_path(command, arguments.options.command_line_plugins);
}

std::string objection_to_folder(const std::string& text)
{
    return text.empty() ? "the name is empty; leave the option out for the default folder" : "";
}

/// Adds --out DIR.
void add_out(CLI::App& command, std::filesystem::path& folder, const std::string& documentation)
{
    command.add_option("--out", folder, documentation)
        ->check(CLI::Validator(objection_to_folder, "", "folder"))
        ->type_name("DIR");
}

std::string objection_to_threads(const std::string& text)
{
    int threads = 0;
    if (CLI::detail::lexical_cast(text, threads) && threads >= 1 && threads <= most_threads())
        return {};
    return fmt::format("\"{}\" is no number of threads; give 1 to {}, the number of processors here", text,
                       processors());
}

/// Adds --threads N, from 1 to most_threads().
void add_threads(CLI::App& command, int& threads)
{
    command.add_option("--threads", threads, "Number of threads (default: all processors)")
        ->check(CLI::Validator(objection_to_threads, "", "threads"))
        ->type_name("N");
}

/// Makes `run_command` with the arguments the action of a command.
template <class Arguments, class Command>
void set_action(CLI::App& command, Action& action, const std::shared_ptr<Arguments>& arguments, Command run_command)
{
    command.callback(
        [arguments, &action, run_command] { action = [arguments, run_command] { return run_command(*arguments); }; });
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

void add_run(CLI::App& program, Action& action)
{
    CLI::App* command = program.add_subcommand("run", "Run a case and write its results");
    const auto arguments = std::make_shared<RunArguments>();
    add_case_arguments(*command, arguments->the_case);
    add_out(*command, arguments->options.directory, "Folder for the results (default: results/<name of CASE>)");
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
    set_action(*command, action, arguments, run);
}

void add_check(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("check", "Build what a run would build and report what is wrong; run and write nothing");
    const auto arguments = std::make_shared<CaseArguments>();
    add_case_arguments(*command, *arguments);
    command->footer("Example:\n  periporo check my_case.toml --set discretization.spacing=\"5 mm\"\n\n"
                    "Exit status 0 when the case is sound, 2 when it is not.");
    set_action(*command, action, arguments, check);
}

void add_explain(CLI::App& program, Action& action)
{
    CLI::App* command = program.add_subcommand(
        "explain", "Say in plain words what a case is: points, memory, stages, time step, duration");
    const auto arguments = std::make_shared<ExplainArguments>();
    add_case_arguments(*command, arguments->the_case);
    add_threads(*command, arguments->threads);
    command
        ->add_option("--picture", arguments->picture,
                     "Draw bodies, obstacles, boundaries, axes and sizes into this SVG file")
        ->check([](const std::string& file) {
            return file.ends_with(".svg") ? std::string() : fmt::format("{}: the name must end in .svg", file);
        });
    command->footer("Example:\n  periporo explain my_case.toml --picture set_up.svg");
    set_action(*command, action, arguments, explain);
}

void add_inspect(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("inspect", "List the plugins, or the parameters of one with units and defaults");
    const auto arguments = std::make_shared<InspectArguments>();
    command->add_option("NAME", arguments->name, "A plugin; all of them when left out")->type_name("");
    add_plugin_path(*command, arguments->plugin_folders);
    CLI::Option* as_markdown =
        command->add_flag("--markdown", arguments->markdown, "As a page of reference, with all parameters");
    command->add_flag("--json", arguments->json, "For machines, with all parameters")->excludes(as_markdown);
    command->footer("Example:\n  periporo inspect viscoplastic_critical_state\n"
                    "  periporo inspect --markdown > reference.md");
    set_action(*command, action, arguments, inspect);
}

void add_dispersion(CLI::App& program, Action& action)
{
    CLI::App* command = program.add_subcommand(
        "dispersion", "Print as CSV how fast plane waves run in the lattice of a case, for every force state");
    const auto arguments = std::make_shared<DispersionArguments>();
    add_case_arguments(*command, arguments->the_case);
    command->add_option("--cells", arguments->cells, "Points of a curve, up to the corner of the zone")
        ->check(CLI::Range(2, 50))
        ->capture_default_str()
        ->type_name("N");
    command->footer("Example:\n  periporo dispersion my_case.toml > dispersion.csv");
    set_action(*command, action, arguments, print_dispersion);
}

void add_drive(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("drive", "Lead one point of a material along a path of strains and stresses");
    const auto arguments = std::make_shared<DriveArguments>();
    add_case_arguments(*command, arguments->path);
    command->get_option("CASE")->description("The file of the path: material, start and stages of one point");
    add_out(*command, arguments->folder, "Folder for the results (default: results/<name of CASE>)");
    command->footer(
        "Example:\n"
        "  periporo drive cases/material/triaxial_drained.toml --set material.silt.critical_state_slope=1.3\n\n"
        "Writes path.csv, path.toml (the whole path, resolved) and, where the law has one, yield_surface.csv.\n"
        "When a step fails, failing_step.toml makes this step alone. tools/drive draws the path too.");
    set_action(*command, action, arguments, drive);
}

void add_schema(CLI::App& program, Action& action)
{
    CLI::App* command =
        program.add_subcommand("schema", "Print the JSON schema of case files, for completion and checks in an editor");
    const auto arguments = std::make_shared<SchemaArguments>();
    add_plugin_path(*command, arguments->plugin_folders);
    command->footer("Example:\n  periporo schema > periporo.schema.json\n\n"
                    "An editor that knows TOML takes it from a first line like this in the case:\n"
                    "  #:schema ./periporo.schema.json");
    set_action(*command, action, arguments, print_schema);
}

void add_new(CLI::App& program, Action& action)
{
    CLI::App* command = program.add_subcommand(
        "new", "Write a plugin of your own: a small project that builds and passes its tests as it is");
    const auto arguments = std::make_shared<NewArguments>();
    std::vector<std::string> kinds;
    for (const PluginKind kind :
         {PluginKind::material, PluginKind::geometry, PluginKind::contact, PluginKind::retention, PluginKind::output})
        kinds.emplace_back(kind_name(kind));
    command->add_option("KIND", arguments->kind, fmt::format("{}", fmt::join(kinds, ", ")))
        ->required()
        ->check(CLI::IsMember(kinds).description(""))
        ->type_name("");
    command->add_option("NAME", arguments->name, "Name of the plugin in case files, as in my_clay")
        ->required()
        ->type_name("");
    add_out(*command, arguments->folder, "Folder to make; ./NAME when left out");
    add_plugin_path(*command, arguments->plugin_folders);
    command->footer("Example:\n  periporo new material my_clay");
    set_action(*command, action, arguments, write_new_plugin);
}

} // namespace

std::variant<Action, ExitStatus> parse_command_line(int count, const char* const* arguments)
{
    CLI::App program("Large-deformation simulation of unsaturated soil by stabilized periporomechanics", "periporo");
    program.set_version_flag("--version", "periporo " PERIPORO_VERSION, "Print the version and exit");
    program.require_subcommand(1);
    program.footer("Example:\n  periporo run cases/column_collapse/quickstart.toml\n\n"
                   "Exit status: 0 done, 1 failed while running, 2 wrong input, 130 interrupted.");
    Action action;
    add_run(program, action);
    add_check(program, action);
    add_explain(program, action);
    add_inspect(program, action);
    add_dispersion(program, action);
    add_drive(program, action);
    add_schema(program, action);
    add_new(program, action);
    try {
        program.parse(count, arguments);
    } catch (const CLI::Success& request) { // --help and --version
        program.exit(request);
        return ExitStatus::done;
    } catch (const CLI::ParseError& error) {
        program.exit(error);
        return ExitStatus::wrong_input;
    }
    return action;
}

} // namespace periporo::cli
