// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Storing parts, showing them, finding them again and merging them.
#include "results_parts.hpp"

#include "xdmf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace periporo::output {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_losses_told = 6; ///< on the terminal; the result file names all

/// A journal of other columns is of another run.
std::string meaning_of_rows(const RunDescription& run)
{
    std::string names;
    for (const HistoryColumn& column : run.history)
        names += column.name + '\n';
    return names;
}

std::size_t values_of_record(const RunDescription& run)
{
    return std::max<std::size_t>(run.history.size(), 2); // number and checksum of a snapshot
}

/// What the journal records of a snapshot.
struct RecordedSnapshot {
    std::uint64_t step;
    std::uint32_t sum;
};

std::array<double, 2> values_of(const StoredSnapshot& snapshot)
{
    return {static_cast<double>(snapshot.number), static_cast<double>(snapshot.sum)};
}

/// Is a part the one that the run wrote under this number? Journal and checkpoint may each lack it.
/// @param last_step of the checkpoint, whose snapshot may have been given after it
bool is_the_one_given(const StoredSnapshot& stored, const std::map<std::uint64_t, RecordedSnapshot>& recorded,
                      const std::vector<SnapshotMoment>& expected, std::uint64_t last_step)
{
    const auto record = recorded.find(stored.number);
    if (record != recorded.end() && (record->second.step != stored.step || record->second.sum != stored.sum))
        return false;
    if (stored.number < expected.size())
        return expected[stored.number].step == stored.step;
    return expected.empty() || stored.step == last_step;
}

bool is_of_parts(const std::string& name)
{
    return number_and_step(name) || name == journal_name || (name.starts_with("vertices-") && name.ends_with(".h5"));
}

/// Makes the folder of the parts. Something else of this name, a link to another folder too, gets another name.
void provide_folder(const fs::path& folder, const RunDescription& run)
{
    const fs::file_status status = fs::symlink_status(folder);
    if (fs::exists(status) && !fs::is_directory(status))
        run.warn(fmt::format("{} is no folder of results; it is kept as {}", folder.string(),
                             set_aside(folder).filename().string()));
    std::error_code error;
    fs::create_directory(folder, error);
    if (error)
        throw FileError("cannot make the folder", folder, error.value());
}

} // namespace

ResultsParts::ResultsParts(const RunDescription& run, int compression)
    : run_(run), compression_(compression), file_(run.directory / results_name), parts_(run.directory / parts_name)
{
}

ResultsParts ResultsParts::create(const RunDescription& run, int compression)
{
    ResultsParts results(run, compression);
    provide_folder(results.parts_, run);
    results.remove_parts(true);
    results.journal_ = Journal::create(results.parts_ / journal_name, values_of_record(run), meaning_of_rows(run));
    results.show();
    return results;
}

ResultsParts ResultsParts::resume(const RunDescription& run, int compression,
                                  const std::vector<SnapshotMoment>& expected)
{
    ResultsParts results(run, compression);
    if (fs::exists(results.file_) && !fs::exists(results.parts_))
        run.warn(fmt::format("{} is not there; {} is kept as {}", results.parts_.string(), results_name,
                             set_aside(results.file_).filename().string()));
    provide_folder(results.parts_, run);
    results.remove_parts(false);
    JournalContent journal;
    results.journal_ = Journal::resume(results.parts_ / journal_name, values_of_record(run), meaning_of_rows(run),
                                       run.resumed_step, journal);
    results.last_row_ = journal.last_step(RecordKind::row);
    const std::vector<std::string> later = results.look_at_parts(journal, expected);
    for (const std::string& steps : journal.losses())
        results.add_loss(fmt::format("rows of the history {}", steps));
    if (!results.missing_.empty()) {
        const std::size_t told = std::min(results.missing_.size(), most_losses_told);
        run.warn(fmt::format(
            "the results in {} are not whole; lost: {}{}", run.directory.string(),
            fmt::join(results.missing_.begin(), results.missing_.begin() + static_cast<std::ptrdiff_t>(told), "; "),
            told < results.missing_.size() ? fmt::format("; and {} more", results.missing_.size() - told) : ""));
    }
    if (journal.damaged && journal.losses().empty())
        run.warn(fmt::format("{} was damaged and is mended; no row is lost, and the damaged file is kept beside it",
                             (results.parts_ / journal_name).string()));
    // The result file stops showing what is later than the checkpoint before that is deleted.
    results.show();
    for (const std::string& name : later)
        remove_file(results.parts_ / name);
    return results;
}

EarlierOutput ResultsParts::look_at(const fs::path& directory)
{
    EarlierOutput found;
    found.snapshots.emplace();
    const fs::path parts = directory / parts_name;
    if (fs::is_directory(fs::symlink_status(parts)))
        for (const std::string& name : names_in(parts)) // a damaged part was named when it was set aside
            if (const auto known = number_and_step(name.substr(0, name.find(".damaged"))))
                found.snapshots->push_back(known->second);
    if (!found.snapshots->empty())
        found.holds.push_back(fmt::format("{} snapshots in {}", found.snapshots->size(), parts_name));
    if (fs::exists(fs::symlink_status(parts / journal_name))) {
        require_regular(parts / journal_name);
        if (Journal::has_records(parts / journal_name))
            found.holds.push_back(fmt::format("a history in {}/{}", parts_name, journal_name));
    } else {
        found.missing_record = fmt::format("{}/{}, the rows of the history", parts_name, journal_name);
    }
    const StoredResults stored = look_at_results(directory / results_name);
    found.complete = stored.complete;
    if (!stored.complete)
        found.missing_result = results_name;
    if (!stored.readable)
        found.holds.push_back(fmt::format("{}, damaged", results_name));
    else if (stored.snapshots + stored.rows > 0)
        found.holds.push_back(
            fmt::format("{} snapshots and {} rows in {}", stored.snapshots, stored.rows, results_name));
    return found;
}

std::vector<std::string> ResultsParts::look_at_parts(const JournalContent& journal,
                                                     const std::vector<SnapshotMoment>& expected)
{
    std::vector<std::string> later;
    std::map<std::uint64_t, std::string> lost;    // by number, in the same words at every resume
    std::map<std::uint64_t, std::string> damaged; // by number, how the part is kept
    for (std::size_t number = 0; number < expected.size(); ++number)
        lost[number] = fmt::format("snapshot {:06} of step {}, time {:.6g} s", number, expected[number].step,
                                   expected[number].time);
    std::map<std::uint64_t, RecordedSnapshot> recorded; // by number
    for (const JournalRecord& record : journal.records)
        if (record.kind == RecordKind::snapshot) {
            const auto number = static_cast<std::uint64_t>(record.values[0]);
            recorded[number] = {record.step, static_cast<std::uint32_t>(record.values[1])};
            lost.try_emplace(number, fmt::format("snapshot {:06} of step {}", number, record.step));
        }
    for (const std::string& name : names_in(parts_)) {
        const auto known = number_and_step(name);
        if (!known)
            continue;
        const auto [number, step] = *known;
        if (step > run_.resumed_step) {
            later.push_back(name);
            continue;
        }
        std::optional<StoredSnapshot> stored = read_snapshot_part(parts_ / name);
        if (!stored || !is_the_one_given(*stored, recorded, expected, run_.resumed_step)) {
            damaged[number] =
                fmt::format(", damaged, kept as {}/{}", parts_name, set_aside(parts_ / name).filename().string());
            if (expected.empty() && !recorded.contains(number) &&
                (snapshots_.empty() || snapshots_.back().number < number))
                lost.try_emplace(number, fmt::format("snapshot {:06} of step {}", number, step));
            continue;
        }
        lost.erase(number);
        if (!recorded.contains(number))
            journal_.add(RecordKind::snapshot, step, values_of(*stored));
        snapshots_.push_back(std::move(*stored));
    }
    next_number_ = std::max<std::uint64_t>(expected.size(), snapshots_.empty() ? 0 : snapshots_.back().number + 1);
    if (!lost.empty())
        next_number_ = std::max(next_number_, lost.rbegin()->first + 1);
    std::uint64_t next = 0;
    for (const StoredSnapshot& snapshot : snapshots_) {
        for (; next < snapshot.number; ++next)
            lost.try_emplace(next, fmt::format("snapshot {:06}", next));
        next = snapshot.number + 1;
        provide_vertices(snapshot.points);
    }
    for (const auto& [number, words] : damaged)
        if (!lost.contains(number)) // the run has this number elsewhere, or never had it
            run_.warn(fmt::format("a part of {} is no snapshot of this run{}", parts_.string(), words));
    for (const auto& [number, words] : lost)
        add_loss(words, damaged[number]);
    return later;
}

void ResultsParts::add_loss(const std::string& words, const std::string& more)
{
    missing_.push_back(words + more);
    run_.note_loss(words);
}

void ResultsParts::provide_vertices(std::size_t points)
{
    if (vertices_.contains(points))
        return;
    write_vertices_part(parts_, points, compression_);
    vertices_.insert(points);
}

void ResultsParts::add(const Snapshot& snapshot, const std::vector<FieldView>& fields)
{
    if (!snapshots_.empty() && snapshots_.back().step == snapshot.step)
        return;
    provide_vertices(snapshot.positions.size() / 3);
    snapshots_.push_back(write_snapshot_part(parts_, next_number_, snapshot, fields, compression_));
    journal_.add(RecordKind::snapshot, snapshot.step, values_of(snapshots_.back()));
    ++next_number_;
    // Result file and XDMF grow with the number of snapshots. They are written again when the snapshots that wait are
    // as large as they are, so that a run never writes more of them than of snapshots.
    unshown_bytes_ += size_of_file(parts_ / snapshots_.back().part_name());
    if (unshown_bytes_ >= shown_bytes_)
        show();
}

void ResultsParts::add(std::uint64_t step, std::span<const double> row)
{
    if (last_row_ == step)
        return;
    journal_.add(RecordKind::row, step, row);
    last_row_ = step;
}

void ResultsParts::flush(std::uint64_t step)
{
    journal_.add(RecordKind::flush, step);
    journal_.synchronize();
    show();
}

void ResultsParts::show()
{
    write_linked_results(file_, {run_, snapshots_, journal_.read(), missing_, false}, parts_name);
    write_xdmf();
    unshown_bytes_ = 0;
    shown_bytes_ = size_of_file(file_) + size_of_file(run_.directory / xdmf_name);
}

void ResultsParts::merge()
{
    journal_.synchronize();
    for (std::size_t s = 0; s < snapshots_.size();) {
        if (is_sound_part(parts_, snapshots_[s])) {
            ++s;
            continue;
        }
        add_loss(fmt::format("snapshot {} of step {}, time {:.6g} s", snapshots_[s].name(), snapshots_[s].step,
                             snapshots_[s].time));
        run_.warn(fmt::format("{} was damaged or deleted while the run went on; the results are without it",
                              (parts_ / snapshots_[s].part_name()).string()));
        snapshots_.erase(snapshots_.begin() + static_cast<std::ptrdiff_t>(s));
    }
    write_merged_results(file_, {run_, snapshots_, journal_.read(), missing_, true}, parts_, compression_);
    write_xdmf();
}

void ResultsParts::write_xdmf() const
{
    write_whole(run_.directory / xdmf_name, xdmf_text(snapshots_, results_name));
}

void ResultsParts::remove_parts(bool all)
{
    for (const std::string& name : names_in(parts_)) {
        const bool aside = name.ends_with(".part") && is_of_parts(name.substr(0, name.size() - 5));
        if (aside || (all && is_of_parts(name)))
            remove_file(parts_ / name);
    }
}

void ResultsParts::clean_up()
{
    journal_ = {};
    for (const StoredSnapshot& snapshot : snapshots_)
        remove_file(parts_ / snapshot.part_name());
    remove_parts(true);
    std::error_code not_empty; // damaged parts are kept
    fs::remove(parts_, not_empty);
}

} // namespace periporo::output
