// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Collects what a run reports of itself: stages, speed, contacts that are too soft.
#include "scheduler/run_report.hpp"

#include "diagnostics/summary.hpp"
#include "diagnostics/vertical_stress.hpp"
#include "io/provenance.hpp"
#include "scheduler/progress.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace periporo {
namespace {

/// Overlap, over the reach of a contact, above which its law is called too soft: a contact holds points at its reach.
constexpr double far_overlap = 2.0;

/// The part of a report that a checkpoint stores.
struct Stored {
    double wall_seconds = 0.0;
    std::string stages; ///< JSON

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        constexpr std::size_t longest = std::size_t{64} << 20; // [bytes]
        visit("wall_seconds", self.wall_seconds);
        visit("stages", at_most(self.stages, longest));
    }
};

/// @throws ArchiveError naming the file when the text is no list, or nested deeper than a report is
nlohmann::json parse_stages(const std::string& text, const std::filesystem::path& file)
{
    constexpr int deepest = 16;
    bool deep = false;
    const auto look = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        deep = deep || depth > deepest;
        return !deep;
    };
    nlohmann::json stages = nlohmann::json::parse(text, look, false);
    if (deep || !stages.is_array())
        throw ArchiveError(fmt::format("\"report/stages\" in {} is no list of reports", file.string()));
    return stages;
}

/// The vertical stress of the first geostatic body, or of the first body, against the weight above, at the end of a
/// quasi-static stage. Null without gravity.
nlohmann::json report_vertical_stress(const RunState& run, spdlog::logger& log)
{
    const std::vector<BodyDescription>& bodies = run.description.bodies;
    const auto geostatic = std::ranges::find_if(
        bodies, [](const BodyDescription& body) { return body.initial_stress.kind == InitialStressKind::geostatic; });
    const std::size_t body = geostatic == bodies.end() ? 0 : static_cast<std::size_t>(geostatic - bodies.begin());
    const std::optional<VerticalStress> profile =
        vertical_stress(run.model, *run.force_state, static_cast<std::uint32_t>(body));
    if (!profile)
        return nullptr;
    log.info("body '{}', vertical stress against the weight less buoyancy above: largest deviation of a layer {:.1f} "
             "per cent of the stress at the bottom, {:.1f} per cent more than a horizon away from the ends",
             bodies[body].name, 100.0 * profile->largest_deviation, 100.0 * profile->inner_deviation);
    return to_json(*profile);
}

} // namespace

RunReport::RunReport(const RunState& run) : run_(run), started_(std::chrono::steady_clock::now()) {}

double RunReport::wall_seconds() const
{
    return wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

double RunReport::steps_per_second() const
{
    const double here = wall_seconds() - wall_before_;
    return static_cast<double>(run_.position.step - first_step_) / std::max(here, 1e-9);
}

std::string RunReport::progress_line(double fraction) const
{
    const RunPosition& at = run_.position;
    const StageDescription& stage = run_.current_stage();
    const double rate = steps_per_second();
    const double left = stage.duration * (1.0 - fraction) / (rate * at.time_step);
    std::size_t inactive = 0, detached = 0;
    for (std::size_t i = 0; i < run_.model.size(); ++i) {
        inactive += run_.model.result.inactive_bonds[i];
        detached += run_.model.result.detached[i];
    }
    return fmt::format("{}: {:.4f} s ({:.0f} %), {:.3g} point-steps/s, {} left, E_kin {:.3g} J, {} inactive bonds, "
                       "{} detached points",
                       stage.name, at.time, 100.0 * fraction, rate * static_cast<double>(run_.model.size()),
                       duration_text(left), run_.dynamics.ledger().kinetic, inactive, detached);
}

void RunReport::add_stage(const std::string& end, spdlog::logger& log)
{
    const RunPosition& at = run_.position;
    const StageDescription& stage = run_.current_stage();
    nlohmann::json report{{"name", stage.name},
                          {"type", name_of(stage.kind)},
                          {"steps", at.stage_step},
                          {"time_step", at.time_step},
                          {"end_time", at.time},
                          {"ended", end},
                          {"residual", run_.dynamics.residual()},
                          {"mean_speed", run_.dynamics.mean_speed()}};
    if (is_quasi_static(stage))
        if (nlohmann::json profile = report_vertical_stress(run_, log); !profile.is_null())
            report["vertical_stress"] = std::move(profile);
    stages_.push_back(std::move(report));
    warn_of_overlaps(log);
    log.info("stage '{}' ended, {}: {} steps, residual {:.2e}, mean speed {:.2e} m/s", stage.name, end, at.stage_step,
             run_.dynamics.residual(), run_.dynamics.mean_speed());
}

void RunReport::warn_of_overlaps(spdlog::logger& log) const
{
    const std::vector<double>& deepest = run_.contact.deepest_overlap();
    for (std::size_t c = 0; c < deepest.size(); ++c)
        if (deepest[c] > far_overlap)
            log.warn("contact {} between {}: a point lay {:.1f} times the reach of the law too deep; a stiffer law "
                     "would hold it at the surface",
                     c, fmt::join(run_.description.contacts[c].between, " and "), deepest[c]);
}

void RunReport::save(ArchiveWriter& archive) const
{
    Stored stored{wall_seconds(), stages_.dump()};
    archive.part("report", stored);
}

void RunReport::restore(ArchiveReader& archive)
{
    Stored stored;
    archive.part("report", stored);
    if (!(stored.wall_seconds >= 0.0))
        throw ArchiveError(fmt::format("\"report\" in {} has a time below zero", archive.file().string()));
    wall_before_ = stored.wall_seconds;
    stages_ = parse_stages(stored.stages, archive.file());
    first_step_ = run_.position.step;
}

void RunReport::write_summary(const std::string& outcome, const std::string& message, const InputHashes& inputs,
                              int threads, const std::filesystem::path& folder, spdlog::logger& log) const
{
    const std::vector<std::string> losses = run_.outputs.losses();
    const double points = static_cast<double>(run_.model.size());
    nlohmann::json summary = summary_of(run_.description, run_.model, run_.dynamics);
    for (std::size_t c = 0; c < run_.description.contacts.size(); ++c)
        summary["contacts"].push_back({{"law", run_.description.contacts[c].law.name},
                                       {"between", run_.description.contacts[c].between},
                                       {"deepest_overlap", run_.contact.deepest_overlap().at(c)},
                                       {"crossed_points", run_.contact.crossed_points().at(c)}});
    summary["outcome"] = outcome;
    summary["message"] = message;
    if (!losses.empty())
        summary["losses"] = losses;
    summary["steps"] = run_.position.step;
    summary["step_estimates"] = run_.position.estimates;
    summary["time"] = run_.position.time;
    summary["stages"] = stages_;
    summary["wall_seconds"] = wall_seconds();
    summary["point_steps_per_second"] = points * steps_per_second();
    summary["provenance"] = provenance(inputs, threads);
    write_json(summary, folder / "summary.json");
    log.info("{}{}: {} steps, {} wall, {:.3g} point-steps/s, {:.3g} bond-steps/s", outcome,
             losses.empty() ? "" : ", but parts of the results are lost", run_.position.step,
             duration_text(wall_seconds()), points * steps_per_second(),
             static_cast<double>(run_.model.neighbourhood.families.bonds()) * steps_per_second());
}

} // namespace periporo
