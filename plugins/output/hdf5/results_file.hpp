// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The layout of a result file:
//
//     /                    format = "periporo results", format_version = 1, title, complete (0 or 1); missing, a text,
//                          when something was lost; parts, a text, while the snapshots are links to other files
//     /snapshots/000000    step, time [s], stage; position (points x 3 [m]) and one dataset for each field, points x
//                          components, each with unit and description
//     /history/<column>    one array for each, with unit and description; /history/step beside them
//     /vertices/<n>        the numbers 0 to n-1 for each number of points n: what XDMF needs to show n points
//     /provenance/<entry>  one text for each, resolved_case among them
//
//     with h5py.File("results.h5") as results:
//         last = results["snapshots"][max(results["snapshots"])]
//         x, time = last["position"][:], last.attrs["time"]
//
// Until the run is complete, snapshots and vertices are links into the folder results.parts (results_parts.hpp); HDF5
// follows them by itself. Then the file holds everything.
#pragma once

#include "snapshot_part.hpp"

#include "common/journal.hpp"

#include "periporo/output.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace periporo::output {

inline constexpr const char* results_format = "periporo results";
inline constexpr std::int64_t results_format_version = 1;

/// The dataset that lists the vertices of a cloud of points.
std::string vertex_list(std::size_t points);

/// What a result file shows.
struct ResultsContent {
    const RunDescription& run;
    const std::vector<StoredSnapshot>& snapshots;
    const JournalContent& history;
    const std::vector<std::string>& missing; ///< in words
    bool complete = false;
};

/// What a result file says of itself.
struct StoredResults {
    bool readable = true; ///< or not there
    bool complete = false;
    std::uint64_t snapshots = 0;
    std::uint64_t rows = 0; ///< of the history
};
/// @throws FileError when the system does not let it be read
StoredResults look_at_results(const std::filesystem::path& file);

/// Writes a file whose snapshots are links into `parts`, a folder beside it. @throws FileError
void write_linked_results(const std::filesystem::path& file, const ResultsContent& content, const std::string& parts);

/// Writes a file that holds everything. @throws FileError
/// @param parts folder of the snapshots
void write_merged_results(const std::filesystem::path& file, const ResultsContent& content,
                          const std::filesystem::path& parts, int compression);

} // namespace periporo::output
