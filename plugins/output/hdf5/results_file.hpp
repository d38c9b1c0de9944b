// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The layout of a result file:
//
//     /                    format = "periporo results", format_version = 1, title, complete (0 or 1)
//     /snapshots/000000    step, time [s], stage; position (points x 3 [m]) and one dataset for each field, points x
//                          components, each with unit and description
//     /history/<column>    one growing column for each, with unit and description; /history/step beside them
//     /vertices/<n>        the numbers 0 to n-1 for each number of points n: what XDMF needs to show n points
//     /provenance/<entry>  one text for each, resolved_case among them
//
//     with h5py.File("results.h5") as results:
//         last = results["snapshots"][max(results["snapshots"])]
//         x, time = last["position"][:], last.attrs["time"]
#pragma once

#include "periporo/output.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace periporo::output {

inline constexpr const char* results_format = "periporo results";
inline constexpr std::int64_t results_format_version = 1;

/// What is known of a field in the file, enough to point at it from elsewhere.
struct StoredField {
    std::string name;
    std::size_t components = 1;
    bool integers = false;
};

struct StoredSnapshot {
    std::string group; ///< "/snapshots/000000"
    double time = 0.0; ///< [s]
    std::size_t points = 0;
    std::vector<StoredField> fields; ///< without the position
};

/// The dataset that lists the vertices of a cloud of points.
std::string vertex_list(std::size_t points);

/// Rows of the history that wait to be appended together.
struct HistoryRows {
    std::vector<std::int64_t> steps;
    std::vector<double> values; ///< rows x columns
};

/// A result file that is opened, changed and closed again by every call, so that it is whole between two calls, and a
/// kill then leaves a readable file. Every call throws std::runtime_error with the path when the file system fails.
class ResultsFile {
public:
    /// Begins an empty file, in place of any that is there.
    static ResultsFile create(std::filesystem::path file, const RunDescription& run, int compression);
    /// Goes on with an earlier file: drops the snapshots and the history after `run.resumed_step`.
    static ResultsFile resume(std::filesystem::path file, const RunDescription& run, int compression);

    /// Appends positions and fields; a group is made for them.
    void append(const Snapshot& snapshot, const std::vector<FieldView>& fields);
    void append(const HistoryRows& rows);
    void set_complete(bool complete);

    const std::vector<StoredSnapshot>& snapshots() const { return snapshots_; }

private:
    ResultsFile(std::filesystem::path file, const RunDescription& run, int compression);

    std::filesystem::path file_;
    std::vector<std::string> columns_;
    int compression_;
    std::vector<StoredSnapshot> snapshots_;
};

} // namespace periporo::output
