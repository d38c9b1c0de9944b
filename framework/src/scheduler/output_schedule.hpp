// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The writers of a run and when each is due.
#pragma once

#include "case/description.hpp"
#include "io/checkpoint.hpp"
#include "model/model.hpp"
#include "plugins/registry.hpp"
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
    void write_due(const Model& model, const ForceState& force_state, const Dynamics& dynamics, RunPosition& at,
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

private:
    struct Output {
        std::unique_ptr<OutputWriter> writer;
        std::vector<double> times; ///< sorted, within the run
        std::uint64_t written_step;
        bool failed = false; ///< it threw: it is not called again

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
    std::uint64_t history_step_; ///< of the last history row
    SnapshotFields fields_;
};

} // namespace periporo
