// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Appending rows, and finding out which of them still hold when a run is resumed.
#include "history_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <set>
#include <utility>
#include <vector>

namespace periporo::output {

namespace {

/// What the values of the journal are.
constexpr std::string_view journal_meaning = "crc32 of a row of history.csv";

/// A text as one cell, in quotes where it needs them (RFC 4180).
std::string cell(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted.append(c == '"' ? 2 : 1, c);
    return quoted + '"';
}

std::string header(const std::vector<HistoryColumn>& columns)
{
    std::string line = "step";
    for (const HistoryColumn& column : columns)
        line += ',' + cell(fmt::format("{} [{}]", column.name, column.unit));
    return line + '\n';
}

/// The step of a row, or nothing when it is not a step and so many numbers.
std::optional<std::uint64_t> step_of(std::string_view row, std::size_t numbers)
{
    std::uint64_t step = 0;
    const char* const end = row.data() + row.size();
    auto [next, error] = std::from_chars(row.data(), end, step);
    if (error != std::errc())
        return std::nullopt;
    for (; next != end && *next == ',' && numbers > 0; --numbers) {
        double number = 0.0;
        const auto read = std::from_chars(next + 1, end, number);
        if (read.ec != std::errc() && read.ec != std::errc::result_out_of_range)
            return std::nullopt;
        next = read.ptr;
    }
    if (numbers > 0 || next + 1 != end || *next != '\n')
        return std::nullopt;
    return step;
}

/// The rows of an earlier table that hold, with their ends of line.
struct KeptRows {
    std::string_view head; ///< the header, or nothing
    std::vector<std::pair<std::uint64_t, std::string_view>> rows;
    std::size_t passed_over = 0; ///< lines before the last row kept that are none
};

/// @param sums checksums of the rows that were written, with their steps
/// @param trusting also a row of which no checksum is there, when it has the form of one
KeptRows kept_rows(std::string_view text, const std::set<std::pair<std::uint64_t, std::uint32_t>>& sums,
                   std::size_t columns, std::uint64_t last_step, bool trusting)
{
    KeptRows kept;
    std::size_t since_last = 0;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        const std::string_view line = text.substr(0, end + 1);
        text.remove_prefix(end + 1);
        if (kept.head.empty()) {
            kept.head = line;
            continue;
        }
        const std::optional<std::uint64_t> step = step_of(line, columns);
        const bool known = step && sums.contains({*step, crc32(line)});
        const bool later = !kept.rows.empty() && step && *step <= kept.rows.back().first;
        if (step && !later && *step <= last_step && (known || trusting)) {
            kept.rows.emplace_back(*step, line);
            kept.passed_over += std::exchange(since_last, 0);
        } else {
            ++since_last;
        }
    }
    return kept;
}

std::string earlier_text(const std::filesystem::path& file)
{
    try {
        return read_whole(file);
    } catch (const FileError& error) {
        if (error.error() == ENOENT)
            return {};
        throw;
    }
}

} // namespace

HistoryTable HistoryTable::create(const RunDescription& run)
{
    HistoryTable table;
    table.folder_ = run.directory;
    write_whole(run.directory / csv_name, header(run.history));
    table.rows_ = AppendedFile(run.directory / csv_name);
    table.journal_ = Journal::create(run.directory / csv_journal_name, 1, journal_meaning);
    return table;
}

HistoryTable HistoryTable::resume(const RunDescription& run)
{
    HistoryTable table;
    table.folder_ = run.directory;
    const std::filesystem::path file = run.directory / csv_name;
    const std::filesystem::path journal_file = run.directory / csv_journal_name;
    JournalContent content;
    table.journal_ = Journal::resume(journal_file, 1, journal_meaning, run.resumed_step, content);
    std::set<std::pair<std::uint64_t, std::uint32_t>> sums;
    for (const JournalRecord& record : content.records)
        if (record.kind == RecordKind::row)
            sums.emplace(record.step, static_cast<std::uint32_t>(record.values[0]));

    const std::string head = header(run.history);
    const std::string text = earlier_text(file);
    const KeptRows kept = kept_rows(text, sums, run.history.size(), run.resumed_step, content.damaged);
    if (!kept.rows.empty())
        table.last_step_ = kept.rows.back().first;
    const bool sound = kept.head == head && kept.passed_over == 0 && kept.rows.size() == sums.size();
    std::uint64_t length = kept.head.size();
    for (const auto& [step, row] : kept.rows)
        length += row.size();
    if (sound && !content.damaged) {
        table.rows_ = AppendedFile(file);
        table.rows_.cut(length);
        return table;
    }
    std::string mended = head;
    for (const auto& [step, row] : kept.rows)
        mended += row;
    std::string said =
        fmt::format("{} up to step {}: {} rows are sound", file.string(), run.resumed_step, kept.rows.size());
    if (sums.size() > kept.rows.size()) {
        said += fmt::format(", {} are lost", sums.size() - kept.rows.size());
        run.note_loss(
            fmt::format("{} rows of {} up to step {}", sums.size() - kept.rows.size(), csv_name, run.resumed_step));
    }
    if (content.damaged && content.losses().empty())
        said += fmt::format("; {} was damaged and is mended", csv_journal_name);
    else if (content.damaged) {
        for (const std::string& steps : content.losses())
            run.note_loss(fmt::format("perhaps rows of {} {}", csv_name, steps));
        said += fmt::format("; {} is damaged, so that rows may be wrong or lost {}", csv_journal_name,
                            fmt::join(content.losses(), " and "));
    }
    if (!text.empty() && !std::string_view(text).starts_with(mended)) {
        const std::filesystem::path damaged = name_when_damaged(file);
        write_whole(damaged, text);
        said += fmt::format("; the damaged file is kept as {}", damaged.filename().string());
    }
    run.warn(said);
    write_whole(file, mended);
    table.rows_ = AppendedFile(file);
    // A kill before the last of these leaves a journal without the flush of this step, and the next resume comes here.
    table.journal_ = Journal::create(journal_file, 1, journal_meaning);
    for (const auto& [step, row] : kept.rows)
        table.journal_.add(RecordKind::row, step, std::vector{static_cast<double>(crc32(row))});
    table.flush(run.resumed_step);
    return table;
}

EarlierOutput HistoryTable::look_at(const std::filesystem::path& directory)
{
    const std::filesystem::path file = directory / csv_name;
    EarlierOutput found;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file))) {
        found.missing_record = fmt::format("{}, the rows of the history", csv_name);
        found.missing_result = csv_name;
        return found;
    }
    const std::string text = read_whole(file);
    const auto lines = std::count(text.begin(), text.end(), '\n');
    if (lines > 1)
        found.holds.push_back(fmt::format("{} rows in {}", lines - 1, csv_name));
    if (lines < 1) // not even the header
        found.missing_result = csv_name;
    return found;
}

void HistoryTable::add(std::uint64_t step, std::string_view row)
{
    if (last_step_ == step)
        return;
    rows_.append(row);
    journal_.add(RecordKind::row, step, std::vector{static_cast<double>(crc32(row))});
    last_step_ = step;
}

void HistoryTable::flush(std::uint64_t step)
{
    rows_.synchronize();
    journal_.add(RecordKind::flush, step);
    journal_.synchronize();
}

void HistoryTable::synchronize()
{
    rows_.synchronize();
    journal_.synchronize();
}

void HistoryTable::remove_journal()
{
    remove_file(folder_ / csv_journal_name);
}

} // namespace periporo::output
