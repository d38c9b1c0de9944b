// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of output plugins: what a writer is shown and when.
#pragma once

#include "periporo/plugin.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace periporo {

/// A field at the material points, viewed and never copied. Values lie point by point.
struct FieldView {
    std::string name;               ///< "velocity", "effective_stress", ...
    std::string unit;               ///< SI; "-" for a pure number
    std::string description;        ///< meaning, sign convention and the order of the components
    std::size_t components = 1;     ///< 1 scalar, 3 vector, 6 symmetric tensor (xx, yy, zz, xy, yz, xz)
    std::span<const double> values; ///< components x points values, or empty when `integers` is used
    std::span<const std::int64_t> integers;
};

/// One named number of the history, [unit].
struct HistoryColumn {
    std::string name;
    std::string unit;
    std::string description;
};

/// All that is known about the points at one time. The views end with the call that they were given to.
struct Snapshot {
    std::uint64_t step = 0; ///< steps since the start of the run, all stages counted
    double time = 0.0;      ///< since the start of the first dynamic stage, 0 before it [s]
    std::string stage;
    std::span<const double> positions; ///< 3 x points [m]
    std::vector<FieldView> fields;
};

/// What a writer is told once about the run.
struct RunDescription {
    std::filesystem::path directory; ///< exists; everything is written in here
    std::string title;
    std::string resolved_case;                     ///< the case with all defaults, includes and overrides, as TOML
    std::map<std::string, std::string> provenance; ///< version, compiler, threads, plugins and their hashes, ...
    std::vector<HistoryColumn> history;            ///< columns of every history row
    bool resumed = false;                          ///< earlier output exists and goes on
    /// With `resumed`: the last step of the run that still holds. Rows and snapshots of later steps are dropped; those
    /// of this very step may be given once more, and are stored once.
    std::uint64_t resumed_step = 0;
    /// Says something aloud, on the terminal and in the log, that is no error: earlier output that is damaged, say.
    std::function<void(const std::string&)> warn = [](const std::string&) {};
    /// Notes one thing that is lost for good, as in "snapshot 000012 of step 2400", for summary.json. A loss that was
    /// noted already is noted once.
    std::function<void(const std::string&)> note_loss = [](const std::string&) {};
};

/// Called by the scheduler in this order: begin, then any mix of snapshot, history and flush, then finish, and clean_up
/// after a complete run. When a run is interrupted or fails `finish` is called too: what was written so far must be
/// readable after it.
///
/// Errors are exceptions derived from std::exception with the path and the system's reason in their message; FileError
/// of file.hpp has both. A writer that threw is not called again. A run may be killed between any two calls of the
/// system: a checkpoint resumes whatever state the output is in, so a writer that is resumed drops what is later than
/// the checkpoint, keeps what is sound, renames what is damaged and names it by RunDescription::warn, and notes what is
/// lost by RunDescription::note_loss.
class OutputWriter {
public:
    virtual ~OutputWriter() = default;

    /// Names of the files and folders that this writer makes in RunDescription::directory. `--overwrite` deletes these,
    /// also as `<name>.part` and `<name>.damaged`, and a folder with all that is in it; nothing else is deleted.
    virtual std::vector<std::string> files() const { return {}; }

    virtual void begin(const RunDescription& run) = 0;
    virtual void snapshot(const Snapshot& snapshot) = 0;
    /// One row of the history; `values` in the order of RunDescription::history.
    virtual void history(std::uint64_t step, std::span<const double> values) = 0;
    /// Puts everything given so far on the disk, so that it survives the end of the program by any cause. Called before
    /// the checkpoint of `step` is written: what came before it must be there when a run is resumed from it.
    virtual void flush(std::uint64_t step) { static_cast<void>(step); }
    /// @param complete false when the run was interrupted or failed and may be resumed.
    virtual void finish(bool complete) = 0;
    /// The run is complete, and its checkpoint deleted: deletes what only a resumed run would need.
    virtual void clean_up() {}
};

} // namespace periporo
