// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/output_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace periporo {
namespace {

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
/// A time that falls short of its due by this part of it is that time: the end of a stage is a sum of other numbers.
constexpr double round_off = 1e-12;

/// All times of an output: multiples of its interval up to the end of the run, and the times it names.
std::vector<double> times_of(const OutputDescription& output, double end)
{
    std::vector<double> times = output.times;
    if (output.every > 0.0)
        for (std::uint64_t k = 1; static_cast<double>(k) * output.every <= end * (1.0 + 1e-12); ++k)
            times.push_back(static_cast<double>(k) * output.every);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

} // namespace

OutputSchedule::OutputSchedule(const CaseDescription& description, const PluginRegistry& registry)
    : history_every_(description.history_every), history_step_(never)
{
    double end = 0.0;
    for (const StageDescription& stage : description.stages)
        end += stage.duration;
    for (const OutputDescription& output : description.outputs)
        outputs_.push_back(
            {registry.make_output(output.writer.name, output.writer.parameters), times_of(output, end), never});
}

std::vector<std::string> OutputSchedule::files() const
{
    std::vector<std::string> names;
    for (const Output& output : outputs_)
        for (std::string& name : output.writer->files())
            names.push_back(std::move(name));
    return names;
}

void OutputSchedule::begin(const Model& model, RunDescription run)
{
    run.history = history_columns(model);
    for (Output& output : outputs_)
        output.use([&](OutputWriter& writer) { writer.begin(run); });
}

Snapshot OutputSchedule::snapshot(const Model& model, const ForceState& force_state, const RunPosition& at,
                                  const std::string& stage)
{
    return {at.step,
            at.time,
            stage,
            {model.state.points.position.front().data(), 3 * model.size()},
            fields_.collect(model, force_state)};
}

void OutputSchedule::write_due(const Model& model, const ForceState& force_state, const Dynamics& dynamics,
                               const RunPosition& at, const std::string& stage)
{
    const double late = at.time * (1.0 + round_off);
    if (late >= static_cast<double>(next_history_) * history_every_) {
        write_history(model, dynamics, at);
        next_history_ = static_cast<std::uint64_t>(std::floor(late / history_every_)) + 1;
    }
    Snapshot taken;
    bool have = false;
    for (Output& output : outputs_) {
        std::uint64_t& next = output.next;
        if (next >= output.times.size() || late < output.times[next])
            continue;
        while (next < output.times.size() && late >= output.times[next])
            ++next;
        if (!have)
            taken = snapshot(model, force_state, at, stage);
        have = true;
        output.use([&](OutputWriter& writer) { writer.snapshot(taken); });
        output.written_step = at.step;
    }
}

void OutputSchedule::write_history(const Model& model, const Dynamics& dynamics, const RunPosition& at)
{
    if (history_step_ == at.step)
        return;
    history_step_ = at.step;
    const std::vector<double> row = history_row(model, dynamics, at.time, at.time_step);
    for (Output& output : outputs_)
        output.use([&](OutputWriter& writer) { writer.history(at.step, row); });
}

void OutputSchedule::write_now(const Model& model, const ForceState& force_state, const RunPosition& at,
                               const std::string& stage)
{
    Snapshot taken;
    bool have = false;
    for (Output& output : outputs_) {
        if (output.written_step == at.step)
            continue;
        if (!have)
            taken = snapshot(model, force_state, at, stage);
        have = true;
        output.use([&](OutputWriter& writer) { writer.snapshot(taken); });
        output.written_step = at.step;
    }
}

void OutputSchedule::flush(std::uint64_t step)
{
    for (Output& output : outputs_)
        output.use([&](OutputWriter& writer) { writer.flush(step); });
}

void OutputSchedule::finish(bool complete)
{
    std::exception_ptr first; // of one writer; the others finish all the same
    for (Output& output : outputs_)
        try {
            output.use([&](OutputWriter& writer) { writer.finish(complete); });
        } catch (...) {
            first = first ? first : std::current_exception();
        }
    if (first)
        std::rethrow_exception(first);
}

bool OutputSchedule::failed() const
{
    return std::ranges::any_of(outputs_, &Output::failed);
}

void OutputSchedule::clean_up()
{
    for (Output& output : outputs_)
        output.use([](OutputWriter& writer) { writer.clean_up(); });
}

} // namespace periporo
