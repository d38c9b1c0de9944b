// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The writers of a run and when each is due.
#pragma once

#include "case/description.hpp"
#include "diagnostics/snapshot_fields.hpp"
#include "model/model.hpp"
#include "plugins/registry.hpp"
#include "scheduler/run_position.hpp"
#include "time/dynamics.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace periporo {

/// A writer that throws is not called again, so that what is written at a failure does not make it fail once more.
class OutputSchedule {
public:
    /// @throws PluginError
    OutputSchedule(const CaseDescription& description, const PluginRegistry& registry);

    /// Names that the writers make in the folder of the run.
    std::vector<std::string> files() const;
    /// Compares what a checkpoint has restored with what is in the folder, and tells the writers which snapshots they
    /// have been given. Called before begin() of a resumed run; changes nothing in the folder.
    /// @param without_lost go on although something is gone
    /// @throws FolderError naming the snapshots, with their times, and the files that are gone
    void expect_earlier(const std::filesystem::path& folder, bool without_lost);
    /// Notes in words that a part of the results is lost; the checkpoints keep it.
    void note_loss(const std::string& text);
    std::vector<std::string> losses() const;
    void begin(const Model& model, RunDescription run);
    /// Snapshots and history rows that are due at the present time of a dynamic stage.
    void write_due(const Model& model, const ForceState& force_state, const Dynamics& dynamics, const RunPosition& at,
                   const std::string& stage);
    /// A history row by every writer now, whatever the schedule; not twice for one step.
    void write_history(const Model& model, const Dynamics& dynamics, const RunPosition& at);
    /// A snapshot by every writer now, whatever the schedule; not twice for one step.
    void write_now(const Model& model, const ForceState& force_state, const RunPosition& at, const std::string& stage);
    /// Everything so far to the disk, before the checkpoint of a step claims it.
    void flush(std::uint64_t step);
    void finish(bool complete);
    /// Has a writer thrown?
    bool failed() const;
    /// After a complete run: deletes what only a resumed run would need.
    void clean_up();

    /// What has been written.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("next_history", self.next_history_);
        visit("history_step", self.history_step_);
        visit("losses", at_most(self.losses_, longest_losses));
        for (std::size_t o = 0; o < self.outputs_.size(); ++o) {
            visit(std::to_string(o) + "/next", self.outputs_[o].next);
            visit(std::to_string(o) + "/written_step", self.outputs_[o].written_step);
            visit(std::to_string(o) + "/steps", at_most(self.outputs_[o].steps, most_snapshots));
            visit(std::to_string(o) + "/moments", at_most(self.outputs_[o].moments, most_snapshots));
        }
    }

    /// @param step of the run, after a checkpoint has restored the members
    /// @throws std::runtime_error when no run has written such snapshots
    void check(std::uint64_t step) const;

private:
    static constexpr std::size_t most_snapshots = std::size_t{1} << 24;
    static constexpr std::size_t longest_losses = std::size_t{1} << 20; ///< [bytes]

    struct Output {
        std::unique_ptr<OutputWriter> writer;
        std::vector<double> times;             ///< sorted, within the run
        std::uint64_t written_step;            ///< of the last snapshot
        std::uint64_t next = 0;                ///< index of the time of the next one
        bool failed = false;                   ///< it threw: it is not called again
        std::vector<std::uint64_t> steps = {}; ///< of the snapshots that it was given
        std::vector<double> moments = {};      ///< times of these [s]

        /// Calls `action` with the writer, unless it has failed.
        template <class Action>
        void use(Action&& action)
        {
            if (std::exchange(failed, true))
                return;
            action(*writer);
            failed = false;
        }
        void take(const Snapshot& snapshot);
    };
    Snapshot snapshot(const Model& model, const ForceState& force_state, const RunPosition& at,
                      const std::string& stage);

    std::vector<Output> outputs_;
    double history_every_;
    std::uint64_t next_history_ = 0; ///< the next row is due at so many intervals
    std::uint64_t history_step_;     ///< of the last history row
    SnapshotFields fields_;
    std::string losses_; ///< a line for each
};

} // namespace periporo
