// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Set-up, stages and end of a run.
#include "scheduler/simulation.hpp"

#include "assembly/duration_checks.hpp"
#include "assembly/held_points.hpp"
#include "assembly/model_checks.hpp"
#include "assembly/size_estimate.hpp"
#include "assembly/stiffness_checks.hpp"
#include "case/refusal.hpp"
#include "io/checkpoint.hpp"
#include "io/folder_error.hpp"
#include "io/provenance.hpp"
#include "io/run_folder.hpp"
#include "operator/refresh.hpp"
#include "periporo/file.hpp"
#include "scheduler/output_checks.hpp"
#include "scheduler/rest.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <stdexcept>

namespace periporo {

Simulation::Simulation(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options,
                       InterruptionGuard& interruption, std::shared_ptr<spdlog::logger> log, Geometries* geometries)
    : description_(description), registry_(registry), options_(options), interruption_(interruption),
      log_(std::move(log)), progress_(options.quiet), state_(description, registry), stepper_(state_, progress_, *log_),
      report_(state_), checkpoints_(state_, report_, inputs_, options, *log_)
{
    Geometries own(description, registry);
    Geometries& known = geometries == nullptr ? own : *geometries;
    check_size(description, registry, known);
    BuiltModel built;
    refuse_failures(description, "", [&] {
        built = build_model(description, registry, known, [this](const std::string& body, double fraction) {
            progress_.update([&] { return fmt::format("filling body '{}': {:.0f} %", body, 100.0 * fraction); });
        });
    });
    progress_.clear();
    inputs_ = InputHashes::of(description, registry); // after all plugins have loaded their files
    set_obstacles(built.model, description, description.stages.front());
    if (!options.stand_in)
        check(built, known);
    remarks_ = built.remarks;
    state_.set_model(std::move(built));
    for (const std::string& remark : remarks_)
        log_->info(remark);
}

void Simulation::check(const BuiltModel& built, Geometries& geometries)
{
    progress_.announce([&] { return fmt::format("looking at {} points", built.model.size()); });
    std::vector<std::string> suspicions;
    Refusals refusals(description_);
    refusals.attempt("", [&] { suspicions = check_model(built, description_, geometries); });
    for (std::size_t s = 0; s < description_.stages.size(); ++s)
        refusals.attempt(fmt::format("stage.{}", s), [&] {
            IsometryTable().set_generators(image_generators(description_, description_.stages[s]));
            held_directions(built.model, description_, built.held_regions, description_.stages[s]);
        });
    progress_.clear();
    refusals.raise();
    for (const std::string& warning : suspicions)
        log_->warn(warning);
}

void Simulation::prepare(std::optional<ArchiveReader> checkpoint)
{
    resumed_ = checkpoint.has_value();
    if (resumed_)
        checkpoints_.restore(*checkpoint);
    refuse_failures(description_, "stage.0", [this] {
        if (!resumed_)
            begin_stage();
        check_fields(description_, registry_, state_.model, *state_.force_state);
    });
    progress_.clear();
    if (resumed_ || options_.stand_in)
        return;
    for (const std::string& warning : check_stiffness(state_.model, description_))
        log_->warn(warning);
    for (const std::string& warning : check_durations(description_, stepper_.step_of_dynamic_stages()))
        log_->warn(warning);
}

double Simulation::seconds_of_a_step(double budget)
{
    using Clock = std::chrono::steady_clock;
    constexpr int cold_steps = 2;
    constexpr int least_steps = 3;
    constexpr int most_steps = static_cast<int>(steps_per_check) - cold_steps - 1; // time and ledger stand still
    const StepOptions options = stepper_.options();
    for (int n = 0; n < cold_steps; ++n)
        stepper_.take(options);
    const Clock::time_point began = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
    int steps = 0;
    while (steps < least_steps || (steps < most_steps && seconds() < budget)) {
        stepper_.take(options);
        ++steps;
    }
    return seconds() / steps;
}

RunDescription Simulation::describe_run()
{
    RunDescription run;
    run.directory = options_.directory;
    run.title = description_.title;
    run.resolved_case = description_.resolved;
    run.provenance = provenance(inputs_, options_.threads);
    run.resumed = resumed_;
    run.resumed_step = state_.position.step;
    run.warn = [this](const std::string& text) { log_->warn(text); };
    run.note_loss = [this](const std::string& text) { state_.outputs.note_loss(text); };
    return run;
}

RunOutcome Simulation::run()
{
    interruption_.end_set_up();
    const RunPosition& at = state_.position;
    const bool stages_left = at.stage < description_.stages.size();
    if (resumed_ && stages_left && options_.stop_after && at.step >= *options_.stop_after) {
        log_->warn("the run has done {} steps already; --stop-after {} stops it here", at.step, *options_.stop_after);
        return RunOutcome::interrupted;
    }
    checkpoints_.start_clock();
    as_fault_of_folder([this] {
        note_names(options_.directory, state_.outputs.files(), !resumed_);
        state_.outputs.begin(state_.model, describe_run());
    });
    try {
        if (!run_stages())
            return stop();
        progress_.clear();
        state_.outputs.finish(true);
    } catch (const MaterialFailure& failure) {
        const Vector3& x = state_.model.state.points.position[failure.point()];
        fail(fmt::format("{} at position ({:.5g}, {:.5g}, {:.5g}) m", failure.what(), x.x(), x.y(), x.z()));
    } catch (const std::bad_alloc&) {
        fail("out of memory; a larger discretization.spacing or a smaller discretization.horizon needs less",
             Cause::outside);
    } catch (const std::exception& error) {
        const bool of_system = state_.outputs.failed() || dynamic_cast<const FileError*>(&error) != nullptr;
        fail(error.what(), of_system ? Cause::outside : Cause::run);
    }
    return complete();
}

bool Simulation::run_stages()
{
    RunPosition& at = state_.position;
    if (!resumed_)
        checkpoints_.write(); // a later failure of the system costs no stage that has ended
    while (at.stage < description_.stages.size()) {
        const StageDescription& stage = description_.stages[at.stage];
        if (!at.begun)
            begin_stage();
        open_history();
        if (!(is_quasi_static(stage) ? run_quasi_static(stage) : run_dynamic(stage)))
            return false;
        end_stage();
        at.begun = false;
        ++at.stage;
        if (at.stage < description_.stages.size() && !reason_to_stop().empty())
            return false;
        progress_.clear();
        checkpoints_.write_if_possible(); // behind the last stage too: merging the results needs room
    }
    return true;
}

void Simulation::begin_stage()
{
    RunPosition& at = state_.position;
    Model& model = state_.model;
    const StageDescription& stage = description_.stages[at.stage];
    at.begun = true;
    at.stage_step = 0;
    at.rest = {};
    at.stage_start = at.time;
    check_rollers(model, stage);
    state_.enter(stage);
    if (at.stage == 0)
        begin_first_stage();
    else
        state_.dynamics.refresh();
    state_.hold(stage);
    state_.water.begin_stage(model, stage);
    state_.dynamics.book(state_.water.follow(model, 0.0));
    state_.dynamics.start();
    progress_.announce([] { return std::string("estimating the stable step"); });
    stepper_.renew_step();
}

void Simulation::begin_first_stage()
{
    Model& model = state_.model;
    progress_.announce([&] { return fmt::format("finding the families of {} points", model.size()); });
    find_first_families(model, *state_.force_state);
    progress_.clear();
    set_initial_stress(model, *state_.force_state, description_);
    const double points = static_cast<double>(model.size());
    const double memory = static_cast<double>(model.memory()); // [bytes]
    const std::size_t bonds = model.neighbourhood.families.bonds();
    log_->info("{} points, {} bonds ({:.1f} a point), {:.1f} MB ({:.1f} kB a point)", model.size(), bonds,
               static_cast<double>(bonds) / points, 1e-6 * memory, 1e-3 * memory / points);
}

void Simulation::open_history()
{
    RunPosition& at = state_.position;
    const StageDescription& stage = description_.stages[at.stage];
    if (is_quasi_static(stage) || at.ledger_open)
        return;
    state_.dynamics.open_ledger();
    at.ledger_open = true;
    state_.outputs.write_due(state_.model, *state_.force_state, state_.dynamics, at, stage.name);
    state_.outputs.write_now(state_.model, *state_.force_state, at, stage.name);
}

bool Simulation::run_quasi_static(const StageDescription& stage)
{
    const Dynamics& dynamics = state_.dynamics;
    const RunPosition& at = state_.position;
    const StepOptions options = stepper_.options();
    // At rest means slower than one would become by falling over one spacing, by the tolerance of the residual. Without
    // gravity the unbalanced force at the start sets the acceleration.
    const auto rest = [&] {
        return stage.residual * std::sqrt(dynamics.acceleration_scale() * state_.model.state.spacing);
    };
    for (bool settled = false; !settled;) {
        if (at.stage_step >= static_cast<std::uint64_t>(stage.maximum_steps))
            throw std::runtime_error(fmt::format(
                "no equilibrium after {} steps: residual {:.2e} (wanted {:.2e}), mean speed {:.2e} m/s (wanted "
                "{:.2e}); raise maximum_steps, or until.residual, or look for a body that nothing holds",
                at.stage_step, dynamics.residual(), stage.residual, dynamics.mean_speed(), rest()));
        stepper_.take(options);
        progress_.update([&] {
            return fmt::format("{}: step {}, residual {:.2e} of {:.2e}", stage.name, at.stage_step, dynamics.residual(),
                               stage.residual);
        });
        settled = dynamics.residual() <= stage.residual && dynamics.mean_speed() <= rest();
        if (!settled && stop_here())
            return false;
    }
    stage_end_ = "in equilibrium";
    return true;
}

bool Simulation::run_dynamic(const StageDescription& stage)
{
    Dynamics& dynamics = state_.dynamics;
    RunPosition& at = state_.position;
    const double end = at.stage_start + stage.duration;
    std::optional<RestCriterion> rest;
    if (stage.rest_speed)
        rest.emplace(rest_rule(state_.model, description_, stage, at.stage_start + state_.water.last_change()),
                     at.rest);
    stage_end_ = "duration over";
    while (at.time < end) {
        stepper_.take(stepper_.options(), end);
        dynamics.times().time(Phase::output, [&] {
            state_.outputs.write_due(state_.model, *state_.force_state, dynamics, at, stage.name);
        });
        progress_.update([&] { return report_.progress_line((at.time - at.stage_start) / stage.duration); });
        if (rest && rest->follow(state_.model, at.time, dynamics.acceleration_scale())) {
            stage_end_ = "at rest";
            return true;
        }
        // A stage that is over is not interrupted but ended: what is written at its end is written once.
        if (at.time < end && stop_here())
            return false;
    }
    if (rest)
        stage_end_ += fmt::format(", still moving at {:.3g} mm/s", 1e3 * dynamics.mean_speed());
    return true;
}

void Simulation::end_stage()
{
    RunPosition& at = state_.position;
    Model& model = state_.model;
    const StageDescription& stage = description_.stages[at.stage];
    stepper_.check_motion();
    report_.add_stage(stage_end_, *log_);
    if (!is_quasi_static(stage)) {
        state_.outputs.write_history(model, state_.dynamics, at);
        state_.outputs.write_now(model, *state_.force_state, at, stage.name);
        return;
    }
    if (stage.response == MaterialResponse::elastic)
        initialize_materials(model, *state_.force_state);
    std::fill(model.state.points.velocity.begin(), model.state.points.velocity.end(), Vector3::Zero());
    const EnergyLedger& ledger = state_.dynamics.ledger();
    at.error_before = at.ledger_open ? ledger.error() - ledger.kinetic : 0.0;
}

bool Simulation::stop_here()
{
    if (checkpoints_.due())
        state_.dynamics.times().time(Phase::output, [&] { checkpoints_.write(); });
    return !reason_to_stop().empty();
}

std::string Simulation::reason_to_stop() const
{
    if (const char* signal = interruption_.signal())
        return signal;
    if (options_.stop_after && state_.position.step >= *options_.stop_after)
        return fmt::format("--stop-after {}", *options_.stop_after);
    return {};
}

RunOutcome Simulation::stop()
{
    const RunPosition& at = state_.position;
    progress_.clear();
    checkpoints_.write();
    state_.outputs.finish(false);
    write_summary("interrupted", "");
    log_->warn("{} interrupted the run {} stage '{}' after {} steps, time {:.6g} s; --resume goes on from here",
               reason_to_stop(), at.begun ? "in" : "before", description_.stages[at.stage].name, at.step, at.time);
    return RunOutcome::interrupted;
}

RunOutcome Simulation::complete()
{
    write_summary("complete", state_.outputs.losses().empty() ? "" : "parts of the results are lost, see \"losses\"");
    remove_checkpoints(options_.directory);
    state_.outputs.clean_up();
    return RunOutcome::complete;
}

void Simulation::write_summary(const std::string& outcome, const std::string& message)
{
    report_.write_summary(outcome, message, inputs_, options_.threads, options_.directory, *log_);
}

void Simulation::fail(const std::string& what, Cause cause)
{
    const RunPosition& at = state_.position;
    const std::string& stage = state_.current_stage().name;
    const std::string message = fmt::format("stage '{}', step {}, time {:.6g} s: {}", stage, at.step, at.time, what);
    progress_.clear();
    const bool not_written = state_.outputs.failed();
    std::string second; // an error while failing does not hide the first
    const auto attempt = [&](auto&& action) {
        try {
            action();
        } catch (const std::exception& error) {
            if (second.empty())
                second = error.what();
        }
    };
    if (cause == Cause::run) // a resume computes a sound state again
        attempt([&] { state_.outputs.write_now(state_.model, *state_.force_state, at, stage); });
    attempt([&] { state_.outputs.finish(false); });
    const bool stored = cause == Cause::run && !not_written && second.empty();
    attempt([&] { write_summary("failed", message); });
    if (stored)
        throw std::runtime_error(fmt::format("{}\nthe state at the failure is the last snapshot in {}", message,
                                             options_.directory.string()));
    const std::string not_stored = cause == Cause::outside ? ""
                                   : not_written           ? "the state at the failure is not stored; "
                                                 : fmt::format("the state at the failure is not stored: {}; ", second);
    const std::string remedy =
        checkpoints_.last_step()
            ? fmt::format("--resume goes on from the checkpoint of step {}", *checkpoints_.last_step())
            : "there is no checkpoint yet to go on from; --resume starts from the beginning";
    throw std::runtime_error(fmt::format("{}\n{}{}", message, not_stored, remedy));
}

} // namespace periporo
