// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/run.hpp"

#include "periporo/file.hpp"
#include "scheduler/build_model.hpp"
#include "scheduler/run_log.hpp"
#include "scheduler/set_up_picture.hpp"
#include "scheduler/simulation.hpp"
#include "scheduler/size_estimate.hpp"

#include <fstream>
#include <omp.h>
#include <spdlog/sinks/ringbuffer_sink.h>

namespace periporo {

RunOutcome run_case(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options)
{
    if (options.threads > 0)
        omp_set_num_threads(options.threads);
    RunLog log(options.quiet);
    try {
        for (const std::string& warning : description.warnings)
            log.logger()->warn(warning);
        log.logger()->info("{}: '{}' into {}", description.file.string(), description.title,
                           options.directory.string());
        Simulation simulation(description, registry, options, log.logger());
        simulation.prepare();
        if (options.take_folder)
            options.take_folder();
        else
            std::filesystem::create_directories(options.directory);
        log.open(options.directory / "run.log", options.resume);
        write_whole(options.directory / "case.toml", description.resolved);
        return simulation.run();
    } catch (const std::exception& error) {
        log.add_to_file(error.what());
        throw;
    }
}

std::vector<std::string> check_case(const CaseDescription& description, const PluginRegistry& registry)
{
    const auto warnings = std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(1000);
    warnings->set_level(spdlog::level::warn);
    warnings->set_pattern("%v");
    RunOptions options;
    options.quiet = true;
    Simulation(description, registry, options, std::make_shared<spdlog::logger>("check", warnings)).prepare();
    return warnings->last_formatted();
}

void draw_case(const CaseDescription& description, const PluginRegistry& registry, const std::filesystem::path& file)
{
    check_size(description, registry);
    draw_set_up(build_model(description, registry), description).save(file);
}

} // namespace periporo
