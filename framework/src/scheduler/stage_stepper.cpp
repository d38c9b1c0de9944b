// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Steps of a stage, with the estimates and checks that are due between them.
#include "scheduler/stage_stepper.hpp"

#include "scheduler/guards.hpp"
#include "time/next_step.hpp"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace periporo {
namespace {

constexpr double resolved_enough = 1.05; // volumes, and with them contacts, change a little between two estimates
constexpr std::int64_t most_crossings_told = 10; // of a contact; summary.json has the number of all

} // namespace

StepOptions StageStepper::options() const
{
    const StageDescription& stage = run_.current_stage();
    StepOptions options;
    if (is_quasi_static(stage)) {
        options.local_damping = stage.damping;
        options.response = stage.response;
    }
    return options;
}

void StageStepper::take(const StepOptions& options, std::optional<double> end)
{
    RunPosition& at = run_.position;
    const bool check_due = at.stage_step > 0 && at.stage_step % steps_per_check == 0;
    run_.dynamics.times().time(Phase::step_estimate, [&] {
        if (check_due || contact_needs_shorter_step())
            renew_step();
    });
    const NextStep next = end ? next_step(at.time, *end, at.time_step) : NextStep{at.time_step, false};
    StepOptions with_step = options;
    with_step.time_step = next.length;
    run_.dynamics.book(run_.water.follow(run_.model, at.time + next.length - at.stage_start, next.length));
    run_.dynamics.step(with_step);
    if (end)
        at.time = next.last ? *end : at.time + next.length;
    ++at.stage_step;
    ++at.step;
    check_crossings();
    if (!std::isfinite(run_.dynamics.ledger().kinetic) || at.stage_step % steps_per_check == 0)
        check_motion();
}

void StageStepper::renew_step()
{
    RunPosition& at = run_.position;
    const StageDescription& stage = run_.current_stage();
    const TimeDescription& time = run_.description.time;
    const bool damped = !is_quasi_static(stage);
    StableStep stable = stable_step(run_.model, *run_.force_state, run_.contact, run_.frequency, time.safety,
                                    time.step.value_or(at.time_step), damped, contact_resolution(damped));
    if (is_quasi_static(stage)) {
        stable.step *= local_damping_factor(stage.damping);
        stable.limit *= local_damping_factor(stage.damping);
    }
    ++at.estimates;
    if (time.step && *time.step > stable.limit)
        throw std::runtime_error(
            fmt::format("the [time] step of {:.4g} s is not stable, the largest stable one is {:.4g} s; leave [time] "
                        "step out, then the step is computed ({:.4g} s here) and follows what the bodies do, or give "
                        "a smaller one",
                        *time.step, stable.limit, stable.step));
    const double step = time.step.value_or(stable.step);
    const bool changed = std::abs(step - at.time_step) > 0.1 * at.time_step;
    at.time_step = step;
    if (!changed)
        return;
    progress_.clear();
    if (time.step)
        log_.info("step {:.4g} s as given; the computed one is {:.4g} s", step, stable.step);
    else
        log_.info("stable step {:.4g} s: 2/omega = {:.4g} s, dashpots of contacts {:.3g} 1/s, wave rule {:.4g} s, "
                  "sharpest contact {:.4g} 1/s",
                  stable.step, 2.0 / stable.frequency, stable.damping_rate, stable.wave_limit, stable.sharpest);
}

bool StageStepper::contact_needs_shorter_step() const
{
    const bool damped = !is_quasi_static(run_.current_stage());
    const double allowed = run_.description.time.step ? 2.0 : resolved_enough * contact_resolution(damped);
    return run_.contact.is_sharper(run_.model, allowed / run_.position.time_step);
}

void StageStepper::check_motion() const
{
    const EnergyLedger& ledger = run_.dynamics.ledger();
    const double error_before = run_.position.error_before;
    std::string wrong = lost_point(run_.model);
    if (wrong.empty() && is_quasi_static(run_.current_stage()))
        wrong = faster_than_driven(run_.model, run_.description, run_.dynamics.acceleration_scale());
    else if (wrong.empty())
        wrong = energy_of_motion_from_nowhere(run_.model, run_.description, ledger, error_before);
    if (wrong.empty() && !is_quasi_static(run_.current_stage()))
        wrong = energy_error_beyond_limit(run_.model, run_.description, ledger, error_before);
    if (!wrong.empty())
        throw std::runtime_error(wrong);
}

void StageStepper::check_crossings() const
{
    for (const Crossing& crossing : run_.contact.crossings()) {
        const ContactDescription& contact = run_.description.contacts[crossing.assignment];
        const std::size_t i = crossing.point;
        const Vector3& x = run_.model.state.points.position[i];
        const std::string what = fmt::format(
            "point {} of body '{}' went through obstacle '{}' and is behind it at position ({:.5g}, {:.5g}, {:.5g}) m",
            run_.model.state.points.id[i], run_.model.body_of(i).name,
            run_.model.state.obstacles[*run_.contact.assignment(crossing.assignment).obstacle].name, x.x(), x.y(),
            x.z());
        if (contact.crossing_stops)
            throw std::runtime_error(
                fmt::format("{}; a stiffer law, a thicker obstacle or a smaller step would hold it, and crossing = "
                            "\"warn\" in contact {} lets such points go",
                            what, crossing.assignment));
        if (run_.contact.crossed_points()[crossing.assignment] > most_crossings_told)
            continue;
        progress_.clear();
        log_.warn("stage '{}', step {}, time {:.6g} s: {}", run_.current_stage().name, run_.position.step,
                  run_.position.time, what);
    }
}

StableStep StageStepper::step_of_motion() const
{
    return stable_step(run_.model, *run_.force_state, run_.contact, run_.frequency, run_.description.time.safety, 0.0,
                       true, contact_resolution(true));
}

double StageStepper::step_of_dynamic_stages() const
{
    const StageDescription& stage = run_.current_stage();
    const double damping = is_quasi_static(stage) ? local_damping_factor(stage.damping) : 1.0;
    return run_.description.time.step.value_or(run_.position.time_step / damping);
}

} // namespace periporo
