// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/output_schedule.hpp"

#include "io/folder_error.hpp"
#include "periporo/earlier_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

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

constexpr std::size_t most_told = 20; ///< of what is gone, on the terminal

/// Adds what is gone, in words.
/// @param known losses that an earlier resume has accepted
void add_gone(std::vector<std::string>& gone, const EarlierOutput& found, const std::vector<SnapshotMoment>& given,
              const std::vector<std::string>& known)
{
    if (found.snapshots)
        for (std::size_t number = 0; number < given.size(); ++number) {
            const std::string words =
                fmt::format("snapshot {:06} of step {}, time {:.6g} s", number, given[number].step, given[number].time);
            if (std::ranges::find(*found.snapshots, given[number].step) == found.snapshots->end() &&
                std::ranges::find(known, words) == known.end())
                gone.push_back(words);
        }
    if (!found.missing_record.empty())
        gone.push_back(found.missing_record);
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

void OutputSchedule::expect_earlier(const std::filesystem::path& folder, bool without_lost)
{
    std::vector<std::string> gone;
    const std::vector<std::string> known = losses();
    for (Output& output : outputs_) {
        auto* reader = dynamic_cast<EarlierOutputReader*>(output.writer.get());
        if (reader == nullptr)
            continue;
        std::vector<SnapshotMoment> given;
        for (std::size_t n = 0; n < output.steps.size(); ++n)
            given.push_back({output.steps[n], output.moments[n]});
        try {
            add_gone(gone, reader->earlier_output(folder), given, known);
        } catch (const std::exception& error) {
            throw FolderError(error.what());
        }
        reader->expect(std::move(given));
    }
    if (without_lost)
        for (const std::string& words : gone)
            note_loss(words);
    if (gone.empty() || without_lost)
        return;
    const std::size_t told = std::min(gone.size(), most_told);
    throw FolderError(fmt::format(
        "results in {} are gone that the checkpoint counts on: {}{}; bring them back, or go on without them by "
        "--resume --without-lost-results, or start anew with --overwrite",
        folder.string(), fmt::join(gone.begin(), gone.begin() + static_cast<std::ptrdiff_t>(told), "; "),
        told < gone.size() ? fmt::format("; and {} more", gone.size() - told) : ""));
}

void OutputSchedule::note_loss(const std::string& text)
{
    const std::vector<std::string> known = losses();
    if (std::ranges::find(known, text) == known.end() && losses_.size() + text.size() < longest_losses)
        losses_ += text + '\n';
}

std::vector<std::string> OutputSchedule::losses() const
{
    std::vector<std::string> lines;
    std::istringstream text(losses_);
    for (std::string line; std::getline(text, line);)
        lines.push_back(line);
    return lines;
}

void OutputSchedule::check(std::uint64_t step) const
{
    const bool lines = losses_.empty() || (losses_.ends_with('\n') && losses_.front() != '\n' &&
                                           losses_.find("\n\n") == std::string::npos);
    const auto is_control = [](char c) { return c != '\n' && static_cast<unsigned char>(c) < ' '; };
    if (!lines || std::ranges::any_of(losses_, is_control))
        throw std::runtime_error("the losses that were named are no lines of text");
    for (const Output& output : outputs_) {
        const bool rising = std::ranges::adjacent_find(output.steps, std::greater_equal<>()) == output.steps.end();
        if (output.steps.size() != output.moments.size() || !rising ||
            (!output.steps.empty() && output.steps.back() > step))
            throw std::runtime_error("the snapshots that were written do not follow one another");
    }
}

void OutputSchedule::Output::take(const Snapshot& snapshot)
{
    use([&](OutputWriter& to) { to.snapshot(snapshot); });
    written_step = snapshot.step;
    if (!steps.empty() && steps.back() == snapshot.step)
        return;
    steps.push_back(snapshot.step);
    moments.push_back(snapshot.time);
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
        output.take(taken);
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
        output.take(taken);
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
