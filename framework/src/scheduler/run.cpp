// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/run.hpp"

#include "io/checkpoint.hpp"
#include "io/write_whole.hpp"
#include "operator/refresh.hpp"
#include "scheduler/build_model.hpp"
#include "scheduler/interruption.hpp"
#include "scheduler/progress.hpp"
#include "scheduler/set_up_picture.hpp"
#include "scheduler/simulation.hpp"
#include "water/standing_water.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <omp.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

namespace periporo {
namespace {

std::shared_ptr<spdlog::logger> make_log(const RunOptions& options)
{
    const auto file =
        std::make_shared<spdlog::sinks::basic_file_sink_mt>((options.directory / "run.log").string(), !options.resume);
    file->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
    const auto terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    terminal->set_pattern("%v");
    terminal->set_level(options.quiet ? spdlog::level::warn : spdlog::level::info);
    auto log = std::make_shared<spdlog::logger>("run", spdlog::sinks_init_list{file, terminal});
    log->flush_on(spdlog::level::info);
    return log;
}

struct Extremes {
    double least = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    void add(double value)
    {
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    std::string text() const
    {
        return least == largest ? fmt::format("{:.4g}", least) : fmt::format("{:.4g} to {:.4g}", least, largest);
    }
};

} // namespace

RunOutcome run_case(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options)
{
    // Before anything is written: the checkpoint may be of another case.
    FoundCheckpoint checkpoint;
    if (options.resume)
        checkpoint = find_checkpoint(options.directory, description.resolved);
    InterruptionGuard interruption;
    std::filesystem::create_directories(options.directory);
    if (options.threads > 0)
        omp_set_num_threads(options.threads);
    const std::shared_ptr<spdlog::logger> log = make_log(options);
    try {
        for (const std::string& warning : description.warnings)
            log->warn(warning);
        log->info("{}: '{}' into {}", description.file.string(), description.title, options.directory.string());
        write_whole(options.directory / "case.toml", description.resolved);
        for (const std::string& refused : checkpoint.refused)
            log->warn("{}; going on from the older checkpoint, {}", refused, checkpoint.archive->file().string());
        if (!checkpoint.refused.empty())
            set_damaged_checkpoint_aside(options.directory);
        if (options.resume && !checkpoint.archive)
            log->warn("{} holds no checkpoint yet; starting from the beginning", options.directory.string());
        Simulation simulation(description, registry, options, interruption, log);
        return simulation.run(std::move(checkpoint.archive));
    } catch (const std::exception& error) {
        log->sinks().front()->log({"run", spdlog::level::err, error.what()});
        log->flush();
        throw;
    }
}

std::string explain_case(const CaseDescription& description, const PluginRegistry& registry)
{
    BuiltModel built = build_model(description, registry);
    Model& model = built.model;
    model.isometries.set_generators(image_generators(description, description.stages.front()));
    const auto force_state = make_force_state(description.operators.force_state,
                                              Influence::by_name(description.operators.influence, model.horizon));
    find_first_families(model, *force_state);
    FrequencyEstimate frequency;
    ContactForces contact(std::move(built.contacts));
    contact.find_candidates(model, description.discretization.skin());
    const StableStep stable = stable_step(model, *force_state, contact, frequency, description.time.safety, 0.0, true,
                                          contact_resolution(true));
    const double step = description.time.step.value_or(stable.step);

    std::string text = fmt::format("{}\n", description.title);
    const StandingWater standing(model);
    for (std::size_t b = 0; b < description.bodies.size(); ++b) {
        std::size_t count = 0;
        double mass = 0.0;
        double volume = 0.0, below = 0.0;
        Extremes suction, saturation;
        for (std::size_t i = 0; i < model.size(); ++i)
            if (model.points.body[i] == b) {
                ++count;
                mass += model.points.mass[i];
                volume += model.points.volume[i];
                below += model.points.volume[i] * standing.share_below(standing.height_of(i));
                suction.add(model.points.suction(i));
                saturation.add(model.points.saturation[i]);
            }
        const BodyDescription& body = description.bodies[b];
        text += fmt::format("  body '{}': {} of '{}', {} points, {:.4g} kg, {}\n", body.name, body.geometry.name,
                            body.material, count, mass,
                            body.water.type == "dry"
                                ? "dry"
                                : fmt::format("suction {} Pa at saturation {}", suction.text(), saturation.text()));
        if (model.bodies[b].has_standing_water())
            text += fmt::format("    {:.1f} per cent of its volume below the water table, saturated and buoyant\n",
                                100.0 * below / volume);
    }
    for (const ObstacleDescription& obstacle : description.obstacles)
        text += fmt::format("  obstacle '{}': {}\n", obstacle.name, obstacle.geometry.name);
    for (const std::string& remark : built.remarks)
        text += fmt::format("  {}\n", remark);
    text += fmt::format("  spacing {:.4g} m, horizon {:.4g} m, {} bonds ({:.1f} a point), {} images\n", model.spacing,
                        model.horizon, model.families.bonds(),
                        static_cast<double>(model.families.bonds()) / static_cast<double>(model.size()),
                        model.families.images().size());
    text += fmt::format("  force state {}, influence {}\n", description.operators.force_state,
                        description.operators.influence);
    text += fmt::format(
        "  step {:.4g} s (2/omega {:.4g} s, wave rule {:.4g} s{})\n", step, 2.0 / stable.frequency, stable.wave_limit,
        stable.damping_rate > 0.0 ? fmt::format(", dashpots of contacts {:.3g} 1/s", stable.damping_rate) : "");
    if (step > stable.limit)
        text += fmt::format("  this step is not stable, a run would refuse it: the largest stable one is {:.4g} s\n",
                            stable.limit);
    double point_steps = 0.0;
    for (const StageDescription& stage : description.stages) {
        if (stage.type == "quasi_static") {
            text += fmt::format("  stage '{}': settles under gravity until the residual is {:.1e}, at most {} steps\n",
                                stage.name, stage.residual, stage.maximum_steps);
            continue;
        }
        const double steps = stage.duration / step;
        point_steps += steps * static_cast<double>(model.size());
        text += fmt::format("  stage '{}': {:.4g} s, {:.0f} steps\n", stage.name, stage.duration, steps);
        for (const WaterChangeDescription& change : stage.water_changes)
            text += fmt::format("    the water of '{}' becomes {} within {:.4g} s\n", change.body, change.water.type,
                                change.over);
    }
    // One evaluation, timed, tells the speed on this machine. A step of soil in flow takes twice as long: the material,
    // families anew, the step estimate.
    model.update_records();
    const double begin = omp_get_wtime();
    force_state->evaluate(model, {StressUpdate::tangent, MaterialResponse::elastic, 0.0});
    const double seconds = omp_get_wtime() - begin;
    text += fmt::format(
        "  {:.1f} MB; about {} for the dynamic stages on {} threads", 1e-6 * static_cast<double>(model.memory()),
        duration_text(2.0 * seconds * point_steps / static_cast<double>(model.size())), omp_get_max_threads());
    return text;
}

void draw_case(const CaseDescription& description, const PluginRegistry& registry, const std::filesystem::path& file)
{
    draw_set_up(build_model(description, registry), description).save(file);
}

} // namespace periporo
