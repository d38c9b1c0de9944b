// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The writers of a run and when each is due.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "plugins/registry.hpp"
#include "scheduler/run_position.hpp"
#include "scheduler/snapshot_fields.hpp"
#include "time/dynamics.hpp"

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
        for (std::size_t o = 0; o < self.outputs_.size(); ++o) {
            visit(std::to_string(o) + "/next", self.outputs_[o].next);
            visit(std::to_string(o) + "/written_step", self.outputs_[o].written_step);
        }
    }

private:
    struct Output {
        std::unique_ptr<OutputWriter> writer;
        std::vector<double> times;  ///< sorted, within the run
        std::uint64_t written_step; ///< of the last snapshot
        std::uint64_t next = 0;     ///< index of the time of the next one
        bool failed = false;        ///< it threw: it is not called again

        /// Calls `action` with the writer, unless it has failed.
        template <class Action>
        void use(Action&& action)
        {
            if (std::exchange(failed, true))
                return;
            action(*writer);
            failed = false;
        }
    };
    Snapshot snapshot(const Model& model, const ForceState& force_state, const RunPosition& at,
                      const std::string& stage);

    std::vector<Output> outputs_;
    double history_every_;
    std::uint64_t next_history_ = 0; ///< the next row is due at so many intervals
    std::uint64_t history_step_;     ///< of the last history row
    SnapshotFields fields_;
};

} // namespace periporo
