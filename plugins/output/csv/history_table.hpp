// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The file history.csv: rows that are appended one by one, and a journal of their checksums while the run may be
// resumed.
#pragma once

#include "common/journal.hpp"

#include "periporo/earlier_output.hpp"
#include "periporo/output.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace periporo::output {

inline constexpr const char* csv_name = "history.csv";
inline constexpr const char* csv_journal_name = "history.csv.journal";

/// A reader finds whole rows at every moment; a kill leaves at most the last one cut. Errors are FileError.
class HistoryTable {
public:
    /// Begins a table without rows.
    static HistoryTable create(const RunDescription& run);
    /// Goes on with an earlier one: drops what is later than `run.resumed_step`. A damaged table is kept under another
    /// name, and what is lost is named by `run.warn`.
    static HistoryTable resume(const RunDescription& run);

    /// What a folder holds of an earlier run. Changes nothing.
    static EarlierOutput look_at(const std::filesystem::path& directory);

    /// @param row with its end of line. The row of a step that has one already is left out.
    void add(std::uint64_t step, std::string_view row);
    void flush(std::uint64_t step);
    void synchronize();
    void remove_journal();

private:
    std::filesystem::path folder_;
    AppendedFile rows_;
    Journal journal_; ///< the checksum of each row
    std::optional<std::uint64_t> last_step_;
};

} // namespace periporo::output
