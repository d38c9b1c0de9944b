// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Says what a case is, how large it is and how long it takes; a large one is measured on a coarser lattice.
#include "preview/explain.hpp"

#include "assembly/size_estimate.hpp"
#include "case/refusal.hpp"
#include "scheduler/progress.hpp"
#include "scheduler/run.hpp"
#include "scheduler/simulation.hpp"
#include "water/standing_water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <omp.h>
#include <optional>
#include <spdlog/sinks/null_sink.h>

namespace periporo {
namespace {

constexpr double points_to_build = 5000.0; ///< takes about a second
constexpr double measured_seconds = 0.7;
/// A step of soil in flow takes up to twice as long: the law iterates and families are found anew. And it becomes
/// shorter where points come closer.
constexpr double slower_in_flow = 4.0;

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

/// A case, or the same case with a larger spacing, ready for its first step.
struct Sample {
    CaseDescription description;
    double coarser = 1.0; ///< its spacing over that of the case
    RunOptions options = {};
    InterruptionGuard interruption;
    std::unique_ptr<Simulation> simulation = nullptr;
};

std::unique_ptr<Sample> prepared(const CaseDescription& description, const PluginRegistry& registry,
                                 Geometries& geometries, double coarser)
{
    auto sample = std::make_unique<Sample>();
    sample->description = description;
    sample->coarser = coarser;
    sample->description.discretization.spacing *= coarser;
    sample->description.time.step.reset();
    if (coarser > 1.0) // which need not divide the edges of a body
        for (BodyDescription& body : sample->description.bodies)
            body.fill.align = LatticeAxes::axes;
    sample->options.quiet = true;
    sample->options.stand_in = coarser > 1.0;
    const auto silent = std::make_shared<spdlog::logger>("explain", std::make_shared<spdlog::sinks::null_sink_mt>());
    sample->simulation = std::make_unique<Simulation>(sample->description, registry, sample->options,
                                                      sample->interruption, silent, &geometries);
    sample->simulation->prepare();
    return sample;
}

/// The case itself when it is small. A coarser lattice may miss thin parts, or the points in a thin layer; then others
/// are tried, up to twice the points and down to a third of them: four times as many take too long.
std::unique_ptr<Sample> sample_of(const CaseDescription& description, const PluginRegistry& registry,
                                  Geometries& geometries, double points, std::string& why_none)
{
    const double coarser = std::max(1.0, std::cbrt(points / points_to_build));
    if (coarser == 1.0)
        return prepared(description, registry, geometries, 1.0);
    for (const double factor : {1.0, 0.9, 1.1, 0.8, 1.2, 1.3, 1.4})
        try {
            return prepared(description, registry, geometries, std::max(1.0, factor * coarser));
        } catch (const std::exception& error) {
            if (why_none.empty())
                why_none = error.what();
        }
    return nullptr;
}

/// @param estimate of its points, or nothing when the model has all of them
std::string body_text(const BodyDescription& body, const Model& model, std::uint32_t b,
                      const std::optional<double>& estimate)
{
    const StandingWater standing(model);
    double count = 0.0, mass = 0.0, volume = 0.0, below = 0.0;
    Extremes suction, saturation;
    for (std::size_t i = 0; i < model.size(); ++i)
        if (model.state.points.body[i] == b) {
            count += 1.0;
            mass += model.state.points.mass[i];
            volume += model.state.points.volume[i];
            below += model.state.points.volume[i] * standing.share_below(standing.height_of(i));
            suction.add(model.state.points.suction(i));
            saturation.add(model.state.points.saturation[i]);
        }
    const std::string points = estimate ? fmt::format("about {:.2g}", *estimate) : fmt::format("{:.0f}", count);
    std::string text = fmt::format("  body '{}': {} of '{}', {} points, {:.4g} kg, {}\n", body.name, body.geometry.name,
                                   body.material, points, mass,
                                   body.water.kind == WaterKind::dry ? "dry"
                                                                     : fmt::format("suction {} Pa at saturation {}",
                                                                                   suction.text(), saturation.text()));
    if (model.state.bodies[b].has_standing_water())
        text += fmt::format("    {:.1f} per cent of its volume below the water table, saturated and buoyant\n",
                            100.0 * below / volume);
    return text;
}

std::string time_range_text(double shortest, double longest)
{
    constexpr double century = 3.2e9;
    return shortest < century ? fmt::format("{} to {}", duration_text(shortest), duration_text(longest))
                              : "more than a century";
}

std::string memory_line(const SizeEstimate& size)
{
    const double available = available_memory();
    return fmt::format("  memory: {} kept, up to {} while families are found anew; {} available{}\n",
                       memory_text(size.bytes), memory_text(size.peak_bytes), memory_text(available),
                       size.peak_bytes < available ? "" : ": does not fit, give a larger discretization.spacing");
}

std::string model_text(const CaseDescription& description, const Sample& sample, const SizeEstimate& size)
{
    const Model& model = sample.simulation->model();
    std::string text;
    for (std::uint32_t b = 0; b < description.bodies.size(); ++b)
        text += body_text(description.bodies[b], model, b,
                          sample.coarser == 1.0 ? std::nullopt : std::optional(size.points_of_bodies[b]));
    for (const ObstacleDescription& obstacle : description.obstacles)
        text += fmt::format("  obstacle '{}': {}\n", obstacle.name, obstacle.geometry.name);
    if (sample.coarser == 1.0) {
        for (const std::string& remark : sample.simulation->remarks())
            text += fmt::format("  {}\n", remark);
        text +=
            fmt::format("  spacing {:.4g} m, horizon {:.4g} m, {} bonds ({:.1f} a point), {} images\n",
                        model.state.spacing, model.state.horizon, model.neighbourhood.families.bonds(),
                        static_cast<double>(model.neighbourhood.families.bonds()) / static_cast<double>(model.size()),
                        model.neighbourhood.families.images().size());
    } else {
        text += fmt::format("  spacing {:.4g} m, horizon {:.4g} m\n", description.discretization.spacing,
                            description.discretization.horizon());
    }
    return text + fmt::format("  force state {}, influence {}\n", description.operators.force_state,
                              description.operators.influence);
}

/// @param step of the case [s], or nothing when it is not known
std::string stages_text(const CaseDescription& description, const std::optional<double>& step)
{
    std::string text;
    for (const StageDescription& stage : description.stages) {
        if (stage.kind == StageType::quasi_static) {
            text += fmt::format("  stage '{}': settles under gravity until the residual is {:.1e}, at most {} steps\n",
                                stage.name, stage.residual, stage.maximum_steps);
            continue;
        }
        text += fmt::format("  stage '{}': {:.4g} s{}\n", stage.name, stage.duration,
                            step ? fmt::format(", {:.6g} steps", std::ceil(stage.duration / *step)) : "");
        for (const WaterChangeDescription& change : stage.water_changes)
            text += fmt::format("    the water of '{}' becomes {} within {:.4g} s\n", change.body,
                                name_of(change.water.kind), change.over);
    }
    return text;
}

/// Lengths scale with the spacing, and the stable step with them.
std::string step_text(const CaseDescription& description, const StableStep& stable, double coarser, double step)
{
    std::string text = fmt::format("  step {:.4g} s (2/omega {:.4g} s, wave rule {:.4g} s{})\n", step,
                                   2.0 / stable.frequency / coarser, stable.wave_limit / coarser,
                                   stable.damping_rate > 0.0
                                       ? fmt::format(", dashpots of contacts {:.3g} 1/s", stable.damping_rate * coarser)
                                       : "");
    if (description.time.step && step > stable.limit / coarser)
        text += fmt::format("  this step is not stable, a run would refuse it: the largest stable one is {:.4g} s\n",
                            stable.limit / coarser);
    return text;
}

} // namespace

std::string explain_case(const CaseDescription& description, const PluginRegistry& registry)
{
    Geometries geometries(description, registry);
    const SizeEstimate size = estimate_size(description, registry, geometries);
    std::string text = fmt::format("{}\n", description.title);
    std::string why_none;
    const std::unique_ptr<Sample> sample = sample_of(description, registry, geometries, size.points, why_none);
    if (!sample)
        return text +
               fmt::format("  about {:.2g} points with {:.0f} bonds each\n", size.points, size.bonds_of_a_point) +
               memory_line(size) + stages_text(description, description.time.step) +
               fmt::format("  the time that a run takes is not known: on a coarser lattice, {}", why_none);
    text += model_text(description, *sample, size) + memory_line(size);
    const StableStep stable = sample->simulation->step_of_motion();
    const double step = description.time.step.value_or(stable.step / sample->coarser);
    text += step_text(description, stable, sample->coarser, step) + stages_text(description, step);
    double steps = 0.0;
    for (const StageDescription& stage : description.stages)
        steps += stage.kind == StageType::quasi_static ? 0.0 : stage.duration / step;
    const double more_points =
        sample->coarser == 1.0 ? 1.0 : size.points / static_cast<double>(sample->simulation->model().size());
    const double seconds = steps * more_points * sample->simulation->seconds_of_a_step(measured_seconds);
    return text + fmt::format("  {} for the dynamic stages on {} threads, as measured {}",
                              time_range_text(seconds, slower_in_flow * seconds), omp_get_max_threads(),
                              sample->coarser == 1.0
                                  ? "on its first steps"
                                  : fmt::format("at a spacing of {:.3g} m", sample->simulation->model().state.spacing));
}

} // namespace periporo
