// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A run with its log, folder and checkpoint; and the same without a step, for `check`.
#include "scheduler/run.hpp"

#include "io/checkpoint.hpp"
#include "io/folder_error.hpp"
#include "periporo/file.hpp"
#include "scheduler/interruption.hpp"
#include "scheduler/run_log.hpp"
#include "scheduler/simulation.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/sinks/ringbuffer_sink.h>

namespace periporo {

RunOutcome run_case(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options)
{
    FoundCheckpoint checkpoint;
    if (options.resume)
        checkpoint = find_checkpoint(options.directory, description.resolved);
    InterruptionGuard interruption;
    if (options.threads > 0)
        omp_set_num_threads(options.threads);
    RunLog log(options.quiet);
    try {
        for (const std::string& warning : description.warnings)
            log.logger()->warn(warning);
        log.logger()->info("{}: '{}' into {}", description.file.string(), description.title,
                           options.directory.string());
        for (const std::string& refused : checkpoint.refused)
            log.logger()->warn("{}; going on from the older checkpoint, {}", refused,
                               checkpoint.archive->file().string());
        for (const std::string& difference : checkpoint.differences)
            log.logger()->info("{}; the run goes on all the same, since its results are the same", difference);
        if (options.resume && !checkpoint.archive)
            log.logger()->warn("{} holds no checkpoint yet; starting from the beginning", options.directory.string());
        Simulation simulation(description, registry, options, interruption, log.logger());
        simulation.prepare(std::move(checkpoint.archive));
        if (options.take_folder)
            options.take_folder(simulation.inputs());
        else
            std::filesystem::create_directories(options.directory);
        as_fault_of_folder([&] {
            log.open(options.directory / "run.log", options.resume);
            write_whole(options.directory / "case.toml", description.resolved);
            if (!checkpoint.refused.empty())
                set_damaged_checkpoint_aside(options.directory);
        });
        return simulation.run();
    } catch (const std::exception& error) {
        log.add_to_file(error.what());
        throw;
    }
}

std::vector<std::string> check_case(const CaseDescription& description, const PluginRegistry& registry, bool quiet)
{
    const auto warnings = std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(1000);
    warnings->set_level(spdlog::level::warn);
    warnings->set_pattern("%v");
    RunOptions options;
    options.quiet = quiet;
    InterruptionGuard interruption;
    Simulation(description, registry, options, interruption, std::make_shared<spdlog::logger>("check", warnings))
        .prepare();
    return warnings->last_formatted();
}

} // namespace periporo
