// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The journal of a writer: records of equal length, each with its number and checksum, in a file that only grows.
#pragma once

#include "periporo/file.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace periporo::output {

enum class RecordKind : std::uint32_t {
    row = 1,  ///< of the history
    snapshot, ///< one was stored
    flush,    ///< everything before it is on the disk; a checkpoint of this step follows
    loss      ///< records were lost here, after the step that is its first value; -1 for from the beginning
};

struct JournalRecord {
    RecordKind kind;
    std::uint64_t step;
    std::span<const double> values;
};

/// What stands in a journal up to a step.
struct JournalContent {
    JournalContent() = default;
    JournalContent(JournalContent&&) = default;
    JournalContent& operator=(JournalContent&&) = default;

    std::vector<JournalRecord> records; ///< the sound ones, and a `loss` for each gap between them; they view `values`
    bool damaged = false;               ///< a record is damaged or missing, or the file as a whole
    std::uint64_t bytes = 0;            ///< length of the file up to the end of the last record
    std::vector<double> values;

    /// "between steps 10 and 20", one for each loss.
    std::vector<std::string> losses() const;
    /// Step of the last record of a kind.
    std::optional<std::uint64_t> last_step(RecordKind kind) const;
};

/// A kill leaves the journal with its last record cut or without it. Damaged bytes cost the records that they are in;
/// lost and doubled ones cost no record behind them.
class Journal {
public:
    Journal() = default;
    /// Begins an empty journal, in place of any that is there.
    /// @param values in each record, at least one
    /// @param meaning of the values: a journal of another meaning is no earlier part of this one
    static Journal create(const std::filesystem::path& file, std::size_t values, std::string_view meaning);
    /// Goes on with an earlier journal: drops the records after `last_step`. A journal that is damaged, or ends before
    /// the flush of this step, is kept as `<file>.damaged`; another one with the sound records and a `loss` for each
    /// gap takes its place.
    /// @param content is filled with what was kept
    static Journal resume(const std::filesystem::path& file, std::size_t values, std::string_view meaning,
                          std::uint64_t last_step, JournalContent& content);

    /// Fewer values than a record has are filled up with zeros.
    void add(RecordKind kind, std::uint64_t step, std::span<const double> values = {});
    void synchronize() { file_.synchronize(); }
    bool is_open() const { return file_.is_open(); }
    /// Everything so far.
    JournalContent read() const;
    /// Does a file hold rows or snapshots, or bytes that may be some? @throws FileError
    static bool has_records(const std::filesystem::path& file);

private:
    Journal(std::filesystem::path path, std::size_t values, std::string_view meaning);

    std::filesystem::path path_;
    std::string header_;
    std::size_t values_ = 1;
    std::uint64_t next_ = 0; ///< number of the next record
    AppendedFile file_;
    std::string record_; ///< the bytes of a record
};

} // namespace periporo::output
