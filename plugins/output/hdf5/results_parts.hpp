// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The results of a run that goes on: the folder results.parts, and results.h5 and results.xdmf that show what is in it.
//
//     results.h5, results.xdmf        written aside and renamed, at checkpoints and when enough snapshots are new
//     results.parts/000012-2400.h5    snapshot 12, of step 2400, with a checksum; never changed
//     results.parts/vertices-1200.h5  see /vertices in results_file.hpp
//     results.parts/journal           the rows of the history, and what was stored when; only appended to
//
// Nothing is changed in place, so that a kill at any moment leaves a result file that opens and parts that are complete
// or absent. When the run is complete, all of it is merged into one result file, and then the parts are deleted.
#pragma once

#include "results_file.hpp"

#include "common/journal.hpp"

#include "periporo/earlier_output.hpp"
#include "periporo/output.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace periporo::output {

inline constexpr const char* results_name = "results.h5";
inline constexpr const char* xdmf_name = "results.xdmf";
inline constexpr const char* parts_name = "results.parts";
inline constexpr const char* journal_name = "journal"; ///< in the folder of parts

/// Every call throws std::runtime_error, mostly FileError, with path and reason when the file system fails.
class ResultsParts {
public:
    static ResultsParts create(const RunDescription& run, int compression);
    /// Goes on with earlier parts: drops what is later than `run.resumed_step`. Damaged parts get another name, and
    /// what is lost is named by `run.warn` and in the result file.
    /// @param expected snapshots that the run had stored, each with its place in the list as its number; also fewer
    static ResultsParts resume(const RunDescription& run, int compression,
                               const std::vector<SnapshotMoment>& expected = {});
    /// What a folder holds of an earlier run. Changes nothing.
    static EarlierOutput look_at(const std::filesystem::path& directory);

    /// The snapshot or row of a step that has one already is left out.
    void add(const Snapshot& snapshot, const std::vector<FieldView>& fields);
    void add(std::uint64_t step, std::span<const double> row);
    void flush(std::uint64_t step);
    /// The result file shows everything.
    void show();
    /// The result file holds everything; the parts stay until clean_up().
    void merge();
    void clean_up();

private:
    ResultsParts(const RunDescription& run, int compression);
    /// Reads the parts up to the step that is resumed; @return names of those after it.
    std::vector<std::string> look_at_parts(const JournalContent& journal, const std::vector<SnapshotMoment>& expected);
    /// @param words the same at every resume, so that the run notes the loss once
    /// @param more what is told beside them
    void add_loss(const std::string& words, const std::string& more = "");
    void provide_vertices(std::size_t points);
    void write_xdmf() const;
    /// Deletes the files of this class in the folder of parts, all or those of writing aside.
    void remove_parts(bool all);

    RunDescription run_;
    int compression_;
    std::filesystem::path file_;
    std::filesystem::path parts_;
    Journal journal_;
    std::vector<StoredSnapshot> snapshots_;
    std::vector<std::string> missing_;
    std::set<std::size_t> vertices_; ///< numbers of points that have their file
    std::uint64_t next_number_ = 0;
    std::optional<std::uint64_t> last_row_;
    std::uint64_t unshown_bytes_ = 0; ///< of snapshots that the result file does not show
    std::uint64_t shown_bytes_ = 0;   ///< of the result file and the XDMF file
};

} // namespace periporo::output
