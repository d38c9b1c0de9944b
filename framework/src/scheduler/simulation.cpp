// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/simulation.hpp"

#include "assembly/build_model.hpp"
#include "assembly/duration_checks.hpp"
#include "assembly/held_points.hpp"
#include "assembly/model_checks.hpp"
#include "assembly/size_estimate.hpp"
#include "assembly/stiffness_checks.hpp"
#include "case/refusal.hpp"
#include "diagnostics/summary.hpp"
#include "diagnostics/vertical_stress.hpp"
#include "io/checkpoint.hpp"
#include "io/provenance.hpp"
#include "io/run_folder.hpp"
#include "operator/refresh.hpp"
#include "periporo/file.hpp"
#include "scheduler/guards.hpp"
#include "scheduler/output_checks.hpp"
#include "scheduler/rest.hpp"
#include "time/next_step.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace periporo {
namespace {

constexpr std::uint64_t steps_per_check = 50;
constexpr double resolved_enough = 1.05; // volumes, and with them contacts, change a little between two estimates
constexpr std::int64_t most_crossings_told = 10; // of a contact; summary.json has the number of all
constexpr double far_overlap = 2.0; // over the reach of a contact: a point lies as deep inside as it should lie outside

/// A failure that says stage, step and time already.
class RunFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

DynamicsSettings settings_of(const CaseDescription& description)
{
    return {description.discretization.skin(), description.discretization.refresh == RefreshRule::every_step};
}

bool is_quasi_static(const StageDescription& stage)
{
    return stage.kind == StageType::quasi_static;
}

/// Reports of the stages that are done, as a checkpoint has them.
nlohmann::json parse_reports(const std::string& text, const std::filesystem::path& file)
{
    constexpr int deepest = 16; // of a report; a text without end of depth is not written out again
    bool deep = false;
    const auto look = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        deep = deep || depth > deepest;
        return !deep;
    };
    nlohmann::json reports = nlohmann::json::parse(text, look, false);
    if (deep || !reports.is_array())
        throw ArchiveError(fmt::format("\"stage_reports\" in {} is no list of reports", file.string()));
    return reports;
}

} // namespace

Simulation::Simulation(const CaseDescription& description, const PluginRegistry& registry, const RunOptions& options,
                       InterruptionGuard& interruption, std::shared_ptr<spdlog::logger> log, Geometries* geometries)
    : description_(description), registry_(registry), options_(options), interruption_(interruption),
      log_(std::move(log)),
      force_state_(
          make_force_state(description.operators.force_state,
                           Influence::by_name(description.operators.influence, description.discretization.horizon()))),
      contact_(std::vector<ContactAssignment>{}), dynamics_(model_, *force_state_, contact_, settings_of(description)),
      outputs_(description, registry), progress_(options.quiet), started_(std::chrono::steady_clock::now()),
      last_checkpoint_(started_)
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
    inputs_ = InputHashes::of(description, registry); // after all plugins have loaded what they need
    set_obstacles(built.model, description, description.stages.front());
    if (!options.stand_in)
        check(built, known);
    model_ = std::move(built.model);
    contact_ = ContactForces(std::move(built.contacts));
    water_ = std::move(built.water);
    held_regions_ = std::move(built.held_regions);
    remarks_ = std::move(built.remarks);
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
        restore(*checkpoint);
    refuse_failures(description_, "stage.0", [this] {
        if (!resumed_)
            begin_stage();
        check_fields(description_, registry_, model_, *force_state_);
    });
    progress_.clear();
    if (resumed_ || options_.stand_in)
        return;
    for (const std::string& warning : check_stiffness(model_, description_))
        log_->warn(warning);
    for (const std::string& warning : check_durations(description_, step_of_dynamic_stages()))
        log_->warn(warning);
}

RunOutcome Simulation::run()
{
    interruption_.end_set_up();
    const bool stages_left = at_.stage < description_.stages.size();
    if (resumed_ && stages_left && options_.stop_after && at_.step >= *options_.stop_after) {
        log_->warn("the run has done {} steps already; --stop-after {} stops it here", at_.step, *options_.stop_after);
        return RunOutcome::interrupted;
    }
    last_checkpoint_ = std::chrono::steady_clock::now();
    as_fault_of_folder([this] {
        note_names(options_.directory, outputs_.files(), !resumed_);
        outputs_.begin(model_, describe_run());
    });
    writes_ = true;
    try {
        if (!resumed_)
            checkpoint(); // what fails later for a reason from outside costs no stage that has ended
        while (at_.stage < description_.stages.size()) {
            const StageDescription& stage = description_.stages[at_.stage];
            if (!at_.begun)
                begin_stage();
            open_history();
            if (!(is_quasi_static(stage) ? quasi_static(stage) : dynamic(stage)))
                return stop();
            end_stage();
            at_.begun = false;
            ++at_.stage;
            if (at_.stage < description_.stages.size() && !reason_to_stop().empty())
                return stop();
            checkpoint_if_possible(); // behind the last stage for the results, which need room to be merged
        }
        progress_.clear();
        outputs_.finish(true);
    } catch (const MaterialFailure& failure) {
        fail(fmt::format("{} at position ({:.5g}, {:.5g}, {:.5g}) m", failure.what(),
                         model_.state.points.position[failure.point()].x(),
                         model_.state.points.position[failure.point()].y(),
                         model_.state.points.position[failure.point()].z()));
    } catch (const RunFailure&) {
        throw;
    } catch (const std::bad_alloc&) {
        fail("out of memory; a larger discretization.spacing or a smaller discretization.horizon needs less",
             Cause::outside);
    } catch (const std::exception& error) {
        const bool of_system = outputs_.failed() || dynamic_cast<const FileError*>(&error) != nullptr;
        fail(error.what(), of_system ? Cause::outside : Cause::run);
    }
    write_summary("complete", outputs_.losses().empty() ? "" : "parts of the results are lost, see \"losses\"");
    remove_checkpoints(options_.directory);
    outputs_.clean_up();
    return RunOutcome::complete;
}

double Simulation::step_of_dynamic_stages() const
{
    const StageDescription& stage = description_.stages[at_.stage];
    const double damping = is_quasi_static(stage) ? local_damping_factor(stage.damping) : 1.0;
    return description_.time.step.value_or(at_.time_step / damping);
}

StableStep Simulation::step_of_motion()
{
    return stable_step(model_, *force_state_, contact_, frequency_, description_.time.safety, 0.0, true,
                       contact_resolution(true));
}

double Simulation::seconds_of_a_step(double budget)
{
    constexpr int cold_steps = 2;
    constexpr int least_steps = 3;
    constexpr int most_steps = static_cast<int>(steps_per_check) - cold_steps - 1; // time and ledger stand still
    const StageDescription& stage = description_.stages[at_.stage];
    StepOptions options;
    if (is_quasi_static(stage)) {
        options.local_damping = stage.damping;
        options.response =
            stage.response == SettlingResponse::elastic ? MaterialResponse::elastic : MaterialResponse::full;
    }
    for (int n = 0; n < cold_steps; ++n)
        take_step(options);
    const double began = wall_seconds();
    int steps = 0;
    while (steps < least_steps || (steps < most_steps && wall_seconds() - began < budget)) {
        take_step(options);
        ++steps;
    }
    return (wall_seconds() - began) / steps;
}

RunOutcome Simulation::stop()
{
    progress_.clear();
    checkpoint();
    outputs_.finish(false);
    write_summary("interrupted", "");
    log_->warn("{} interrupted the run {} stage '{}' after {} steps, time {:.6g} s; --resume goes on from here",
               reason_to_stop(), at_.begun ? "in" : "before", description_.stages[at_.stage].name, at_.step, at_.time);
    return RunOutcome::interrupted;
}

RunDescription Simulation::describe_run()
{
    RunDescription run;
    run.directory = options_.directory;
    run.title = description_.title;
    run.resolved_case = description_.resolved;
    run.provenance = provenance(inputs_, options_.threads);
    run.resumed = resumed_;
    run.resumed_step = at_.step;
    run.warn = [this](const std::string& text) { log_->warn(text); };
    run.note_loss = [this](const std::string& text) { outputs_.note_loss(text); };
    return run;
}

RunState Simulation::state(RunPosition& position)
{
    return {model_, *force_state_, contact_, dynamics_, frequency_, water_, outputs_, position};
}

void Simulation::restore(ArchiveReader& checkpoint)
{
    constexpr std::size_t longest_inputs = std::size_t{64} << 20; // [bytes]
    std::string inputs;
    checkpoint("inputs", at_most(inputs, longest_inputs));
    const InputHashes before = InputHashes::from_text(inputs);
    if (before.text() != inputs)
        throw ArchiveError(fmt::format("\"inputs\" in {} is no list of hashes", checkpoint.file().string()));
    if (const std::string difference = inputs_.difference_from(before); !difference.empty())
        throw ForeignCheckpoint(fmt::format("{} cannot go on: {}; bring back the file as it was, or start anew with "
                                            "--overwrite",
                                            checkpoint.file().string(), difference));
    restore_run(checkpoint, state(at_), description_.stages, settings_of(description_).skin,
                [this](std::uint64_t stage) { enter_stage(description_.stages.at(stage)); });
    const StageDescription& stage = description_.stages.at(at_.stage_of_model());
    water_.resume(model_, stage);
    dynamics_.hold(held_directions(model_, description_, held_regions_, stage));
    reports_ = parse_reports(at_.stage_reports, checkpoint.file());
    outputs_.expect_earlier(options_.directory, options_.without_lost);
    checkpoint_step_ = at_.step;
    log_->info("resumed {} stage '{}' at step {}, time {:.6g} s",
               at_.stage == description_.stages.size() ? "behind"
               : at_.begun                             ? "in"
                                                       : "before",
               description_.stages[std::min(at_.stage, description_.stages.size() - 1)].name, at_.step, at_.time);
}

void Simulation::enter_stage(const StageDescription& stage)
{
    model_.neighbourhood.isometries.set_generators(image_generators(description_, stage));
    set_obstacles(model_, description_, stage);
}

void Simulation::begin_stage()
{
    const StageDescription& stage = description_.stages[at_.stage];
    at_.begun = true;
    at_.stage_step = 0;
    at_.rest = {};
    at_.stage_start = at_.time;
    check_rollers(model_, stage);
    enter_stage(stage);
    if (at_.stage == 0) {
        progress_.announce([&] { return fmt::format("finding the families of {} points", model_.size()); });
        find_first_families(model_, *force_state_);
        progress_.clear();
        set_initial_stress(model_, *force_state_, description_);
        log_->info("{} points, {} bonds ({:.1f} a point), {:.1f} MB ({:.1f} kB a point)", model_.size(),
                   model_.neighbourhood.families.bonds(),
                   static_cast<double>(model_.neighbourhood.families.bonds()) / static_cast<double>(model_.size()),
                   1e-6 * static_cast<double>(model_.memory()),
                   1e-3 * static_cast<double>(model_.memory()) / static_cast<double>(model_.size()));
    } else {
        dynamics_.refresh();
    }
    dynamics_.hold(held_directions(model_, description_, held_regions_, stage));
    water_.begin_stage(model_, stage);
    dynamics_.book(water_.follow(model_, 0.0));
    dynamics_.start();
    progress_.announce([] { return std::string("estimating the stable step"); });
    renew_step();
}

void Simulation::open_history()
{
    const StageDescription& stage = description_.stages[at_.stage];
    if (is_quasi_static(stage) || at_.ledger_open)
        return;
    dynamics_.open_ledger();
    at_.ledger_open = true;
    outputs_.write_due(model_, *force_state_, dynamics_, at_, stage.name);
    outputs_.write_now(model_, *force_state_, at_, stage.name);
}

void Simulation::end_stage()
{
    const StageDescription& stage = description_.stages[at_.stage];
    check_motion();
    nlohmann::json report{{"name", stage.name},
                          {"type", name_of(stage.kind)},
                          {"steps", at_.stage_step},
                          {"time_step", at_.time_step},
                          {"end_time", at_.time},
                          {"ended", stage_end_},
                          {"residual", dynamics_.residual()},
                          {"mean_speed", dynamics_.mean_speed()}};
    if (is_quasi_static(stage)) {
        const auto settled = std::ranges::find_if(description_.bodies, [](const BodyDescription& body) {
            return body.initial_stress.kind == InitialStressKind::geostatic;
        });
        const auto body = settled == description_.bodies.end()
                              ? 0u
                              : static_cast<std::uint32_t>(settled - description_.bodies.begin());
        if (const std::optional<VerticalStress> profile = vertical_stress(model_, *force_state_, body)) {
            report["vertical_stress"] = to_json(*profile);
            log_->info("body '{}', vertical stress against the weight less buoyancy above: largest deviation of a "
                       "layer {:.1f} per cent of "
                       "the stress at the bottom, {:.1f} per cent more than a horizon away from the ends",
                       description_.bodies[body].name, 100.0 * profile->largest_deviation,
                       100.0 * profile->inner_deviation);
        }
        if (stage.response == SettlingResponse::elastic)
            initialize_materials(model_, *force_state_);
    } else {
        outputs_.write_history(model_, dynamics_, at_);
        outputs_.write_now(model_, *force_state_, at_, stage.name);
    }
    reports_.push_back(report);
    report_contacts();
    log_->info("stage '{}' ended, {}: {} steps, residual {:.2e}, mean speed {:.2e} m/s", stage.name, stage_end_,
               at_.stage_step, dynamics_.residual(), dynamics_.mean_speed());
    if (is_quasi_static(stage)) {
        std::fill(model_.state.points.velocity.begin(), model_.state.points.velocity.end(), Vector3::Zero());
        at_.error_before = at_.ledger_open ? dynamics_.ledger().error() - dynamics_.ledger().kinetic : 0.0;
    }
}

void Simulation::report_contacts()
{
    const std::vector<double>& deepest = contact_.deepest_overlap();
    for (std::size_t c = 0; c < deepest.size(); ++c)
        if (deepest[c] > far_overlap)
            log_->warn("contact {} between {}: a point lay {:.1f} times the reach of the law too deep; a stiffer law "
                       "would hold it at the surface",
                       c, fmt::join(description_.contacts[c].between, " and "), deepest[c]);
}

void Simulation::renew_step()
{
    const StageDescription& stage = description_.stages[at_.stage];
    const std::optional<double>& given = description_.time.step;
    const bool damped = !is_quasi_static(stage);
    StableStep stable = stable_step(model_, *force_state_, contact_, frequency_, description_.time.safety,
                                    given.value_or(at_.time_step), damped, contact_resolution(damped));
    if (is_quasi_static(stage)) {
        stable.step *= local_damping_factor(stage.damping);
        stable.limit *= local_damping_factor(stage.damping);
    }
    ++at_.estimates;
    if (given && *given > stable.limit)
        fail(fmt::format("the [time] step of {:.4g} s is not stable, the largest stable one is {:.4g} s; leave [time] "
                         "step out, then the step is computed ({:.4g} s here) and follows what the bodies do, or give "
                         "a smaller one",
                         *given, stable.limit, stable.step));
    const double step = given.value_or(stable.step);
    const bool news = std::abs(step - at_.time_step) > 0.1 * at_.time_step;
    at_.time_step = step;
    if (news)
        progress_.clear();
    if (news && given)
        log_->info("step {:.4g} s as given; the computed one is {:.4g} s", step, stable.step);
    else if (news)
        log_->info("stable step {:.4g} s: 2/omega = {:.4g} s, dashpots of contacts {:.3g} 1/s, wave rule {:.4g} s, "
                   "sharpest contact {:.4g} 1/s",
                   stable.step, 2.0 / stable.frequency, stable.damping_rate, stable.wave_limit, stable.sharpest);
}

bool Simulation::contact_asks_for_shorter_step()
{
    const bool damped = !is_quasi_static(description_.stages[at_.stage]);
    const double allowed = description_.time.step ? 2.0 : resolved_enough * contact_resolution(damped);
    return contact_.is_sharper(model_, allowed / at_.time_step);
}

void Simulation::take_step(const StepOptions& options, std::optional<double> end)
{
    const bool check_due = at_.stage_step > 0 && at_.stage_step % steps_per_check == 0;
    dynamics_.times().time(Phase::step_estimate, [&] {
        if (check_due || contact_asks_for_shorter_step())
            renew_step();
    });
    const NextStep next = end ? next_step(at_.time, *end, at_.time_step) : NextStep{at_.time_step, false};
    StepOptions with_step = options;
    with_step.time_step = next.length;
    dynamics_.book(water_.follow(model_, at_.time + next.length - at_.stage_start, next.length));
    dynamics_.step(with_step);
    if (end)
        at_.time = next.last ? *end : at_.time + next.length;
    ++at_.stage_step;
    ++at_.step;
    ++steps_here_;
    check_crossings();
    if (!std::isfinite(dynamics_.ledger().kinetic) || at_.stage_step % steps_per_check == 0)
        check_motion();
}

bool Simulation::quasi_static(const StageDescription& stage)
{
    StepOptions options;
    options.local_damping = stage.damping;
    options.response = stage.response == SettlingResponse::elastic ? MaterialResponse::elastic : MaterialResponse::full;
    // At rest means slower than one would become by falling over one spacing, by the tolerance of the residual. Without
    // gravity the unbalanced force at the start sets the acceleration.
    const auto rest = [&] { return stage.residual * std::sqrt(dynamics_.acceleration_scale() * model_.state.spacing); };
    for (bool settled = false; !settled;) {
        if (at_.stage_step >= static_cast<std::uint64_t>(stage.maximum_steps))
            fail(fmt::format("no equilibrium after {} steps: residual {:.2e} (wanted {:.2e}), mean speed {:.2e} m/s "
                             "(wanted {:.2e}); raise maximum_steps, or until.residual, or look for a body that nothing "
                             "holds",
                             at_.stage_step, dynamics_.residual(), stage.residual, dynamics_.mean_speed(), rest()));
        take_step(options);
        progress_.update([&] {
            return fmt::format("{}: step {}, residual {:.2e} of {:.2e}", stage.name, at_.stage_step,
                               dynamics_.residual(), stage.residual);
        });
        settled = dynamics_.residual() <= stage.residual && dynamics_.mean_speed() <= rest();
        if (!settled && stop_here())
            return false;
    }
    stage_end_ = "in equilibrium";
    return true;
}

bool Simulation::dynamic(const StageDescription& stage)
{
    const double end = at_.stage_start + stage.duration;
    std::optional<RestCriterion> rest;
    if (stage.rest_speed)
        rest.emplace(rest_rule(model_, description_, stage, at_.stage_start + water_.last_change()), at_.rest);
    stage_end_ = "duration over";
    while (at_.time < end) {
        take_step({}, end);
        dynamics_.times().time(Phase::output,
                               [&] { outputs_.write_due(model_, *force_state_, dynamics_, at_, stage.name); });
        progress_.update([&] { return stage_line((at_.time - at_.stage_start) / stage.duration); });
        if (rest && rest->follow(model_, at_.time, dynamics_.acceleration_scale())) {
            stage_end_ = "at rest";
            return true;
        }
        // A stage that is over is not interrupted but ended: what is written at its end is written once.
        if (at_.time < end && stop_here())
            return false;
    }
    if (rest)
        stage_end_ += fmt::format(", still moving at {:.3g} mm/s", 1e3 * dynamics_.mean_speed());
    return true;
}

std::string Simulation::stage_line(double fraction) const
{
    const double elapsed = wall_seconds() - at_.wall_seconds;
    const double rate = static_cast<double>(steps_here_) / std::max(elapsed, 1e-9);
    const double left = (description_.stages[at_.stage].duration * (1.0 - fraction)) / (rate * at_.time_step);
    std::size_t inactive = 0, free_grains = 0;
    for (std::size_t i = 0; i < model_.size(); ++i) {
        inactive += model_.result.inactive_bonds[i];
        free_grains += model_.result.detached[i];
    }
    return fmt::format(
        "{}: {:.4f} s ({:.0f} %), {:.3g} point-steps/s, {} left, E_kin {:.3g} J, {} inactive bonds, {} free "
        "grains",
        description_.stages[at_.stage].name, at_.time, 100.0 * fraction, rate * static_cast<double>(model_.size()),
        duration_text(left), dynamics_.ledger().kinetic, inactive, free_grains);
}

void Simulation::check_motion()
{
    const StageDescription& stage = description_.stages[at_.stage];
    const EnergyLedger& ledger = dynamics_.ledger();
    std::string wrong = lost_point(model_);
    if (wrong.empty() && is_quasi_static(stage))
        wrong = faster_than_driven(model_, description_, dynamics_.acceleration_scale());
    if (wrong.empty() && !is_quasi_static(stage))
        wrong = energy_of_motion_from_nowhere(model_, description_, ledger, at_.error_before);
    if (wrong.empty() && !is_quasi_static(stage))
        wrong = energy_error_beyond_limit(model_, description_, ledger, at_.error_before);
    if (!wrong.empty())
        fail(wrong);
}

void Simulation::check_crossings()
{
    for (const Crossing& crossing : contact_.crossings()) {
        const ContactDescription& contact = description_.contacts[crossing.assignment];
        const std::size_t i = crossing.point;
        const Vector3& x = model_.state.points.position[i];
        const std::string what = fmt::format(
            "point {} of body '{}' went through obstacle '{}' and is behind it at position ({:.5g}, {:.5g}, {:.5g}) m",
            model_.state.points.id[i], model_.body_of(i).name,
            model_.state.obstacles[*contact_.assignment(crossing.assignment).obstacle].name, x.x(), x.y(), x.z());
        if (contact.crossing_stops)
            fail(fmt::format("{}; a stiffer law, a thicker obstacle or a smaller step would hold it, and crossing = "
                             "\"warn\" in contact {} lets such points go",
                             what, crossing.assignment));
        if (contact_.crossed_points()[crossing.assignment] > most_crossings_told)
            continue;
        progress_.clear();
        log_->warn("stage '{}', step {}, time {:.6g} s: {}", description_.stages[at_.stage].name, at_.step, at_.time,
                   what);
    }
}

bool Simulation::stop_here()
{
    const std::chrono::duration<double> every(std::max(description_.checkpoint_every, 20.0 * checkpoint_took_.count()));
    if (description_.checkpoint_every == 0.0 || std::chrono::steady_clock::now() - last_checkpoint_ > every)
        dynamics_.times().time(Phase::output, [&] { checkpoint(); });
    return !reason_to_stop().empty();
}

std::string Simulation::reason_to_stop() const
{
    if (const char* signal = interruption_.signal())
        return signal;
    if (options_.stop_after && at_.step >= *options_.stop_after)
        return fmt::format("--stop-after {}", *options_.stop_after);
    return {};
}

void Simulation::checkpoint()
{
    const auto began = std::chrono::steady_clock::now();
    // A state that no run can go on from must not take the place of an earlier one.
    if (const std::string lost = lost_point(model_); !lost.empty())
        fail(lost);
    outputs_.flush(at_.step);
    store_state();
    last_checkpoint_ = std::chrono::steady_clock::now();
    checkpoint_took_ = last_checkpoint_ - began;
}

void Simulation::checkpoint_if_possible()
{
    outputs_.flush(at_.step);
    try {
        store_state();
    } catch (const FileError& error) {
        progress_.clear();
        log_->warn("{}; the run goes on, and the last checkpoint stays", error.what());
    }
}

void Simulation::store_state()
{
    RunPosition position = at_;
    position.wall_seconds = wall_seconds();
    position.stage_reports = reports_.dump();
    write_checkpoint(
        options_.directory, description_.resolved,
        [&](ArchiveWriter& archive) {
            archive("inputs", inputs_.text());
            save_run(archive, state(position));
        },
        [this] { checkpoint_step_ = at_.step; });
}

double Simulation::wall_seconds() const
{
    return at_.wall_seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

void Simulation::write_summary(const std::string& outcome, const std::string& message)
{
    const double here = wall_seconds() - at_.wall_seconds;
    const double steps_per_second = static_cast<double>(steps_here_) / std::max(here, 1e-9);
    const double point_rate = static_cast<double>(model_.size()) * steps_per_second;
    nlohmann::json summary = summary_of(description_, model_, dynamics_);
    for (std::size_t c = 0; c < description_.contacts.size(); ++c)
        summary["contacts"].push_back({{"law", description_.contacts[c].law.name},
                                       {"between", description_.contacts[c].between},
                                       {"deepest_overlap", contact_.deepest_overlap().at(c)},
                                       {"crossed_points", contact_.crossed_points().at(c)}});
    summary["outcome"] = outcome;
    summary["message"] = message;
    if (!outputs_.losses().empty())
        summary["losses"] = outputs_.losses();
    summary["steps"] = at_.step;
    summary["step_estimates"] = at_.estimates;
    summary["time"] = at_.time;
    summary["stages"] = reports_;
    summary["wall_seconds"] = wall_seconds();
    summary["point_steps_per_second"] = point_rate;
    summary["provenance"] = provenance(inputs_, options_.threads);
    write_json(summary, options_.directory / "summary.json");
    const char* lost = outputs_.losses().empty() ? "" : ", but parts of the results are lost";
    log_->info("{}{}: {} steps, {} wall, {:.3g} point-steps/s, {:.3g} bond-steps/s", outcome, lost, at_.step,
               duration_text(wall_seconds()), point_rate,
               static_cast<double>(model_.neighbourhood.families.bonds()) * steps_per_second);
}

void Simulation::fail(const std::string& what, Cause cause)
{
    const std::string& stage = description_.stages[std::min(at_.stage, description_.stages.size() - 1)].name;
    const std::string message = fmt::format("stage '{}', step {}, time {:.6g} s: {}", stage, at_.step, at_.time, what);
    if (!writes_)
        throw refusal(description_, fmt::format("stage.{}", at_.stage), message);
    progress_.clear();
    const bool not_written = outputs_.failed();
    std::string second; // an error while failing does not hide the first
    const auto attempt = [&](auto&& action) {
        try {
            action();
        } catch (const std::exception& error) {
            if (second.empty())
                second = error.what();
        }
    };
    if (cause == Cause::run) // a state that is sound is computed again
        attempt([&] { outputs_.write_now(model_, *force_state_, at_, stage); });
    attempt([&] { outputs_.finish(false); });
    const bool stored = cause == Cause::run && !not_written && second.empty();
    attempt([&] { write_summary("failed", message); });
    if (stored)
        throw RunFailure(fmt::format("{}\nthe state at the failure is the last snapshot in {}", message,
                                     options_.directory.string()));
    throw RunFailure(fmt::format("{}\n{}{}", message,
                                 cause == Cause::outside ? ""
                                 : not_written           ? "the state at the failure is not stored; "
                                               : fmt::format("the state at the failure is not stored: {}; ", second),
                                 checkpoint_step_
                                     ? fmt::format("--resume goes on from the checkpoint of step {}", *checkpoint_step_)
                                     : "there is no checkpoint yet to go on from; --resume starts from the beginning"));
}

} // namespace periporo
