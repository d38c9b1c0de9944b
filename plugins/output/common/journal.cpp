// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Records and their checksums: how a journal is written, read, cut and mended.
//
// A record is a checksum of the rest, its kind (4 bytes each), its number, its step (8 bytes each) and its values, in
// the byte order of the machine.
#include "common/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>

namespace periporo::output {
namespace {

constexpr std::size_t header_size = 64;
constexpr std::size_t fixed_size = 24;           ///< of a record without its values
constexpr std::uint64_t most_lost = 100'000'000; ///< records; a larger number is none of a journal

std::size_t record_size(std::size_t values)
{
    return fixed_size + values * sizeof(double);
}

template <class Value>
void append_bytes(std::string& bytes, const Value& value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
Value value_at(std::string_view bytes, std::size_t place)
{
    Value value;
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
}

std::string header_of(std::size_t values, std::string_view meaning)
{
    std::string header = fmt::format("periporo journal 1, {} values a record, {:08x}", values, crc32(meaning));
    header.resize(header_size - 1, ' ');
    return header + '\n';
}

void encode(std::string& bytes, RecordKind kind, std::uint64_t number, std::uint64_t step,
            std::span<const double> given, std::size_t values)
{
    bytes.assign(sizeof(std::uint32_t), '\0'); // room for the checksum
    append_bytes(bytes, static_cast<std::uint32_t>(kind));
    append_bytes(bytes, number);
    append_bytes(bytes, step);
    for (std::size_t v = 0; v < values; ++v)
        append_bytes(bytes, v < given.size() ? given[v] : 0.0);
    const std::uint32_t sum = crc32(std::string_view(bytes).substr(sizeof(std::uint32_t)));
    std::memcpy(bytes.data(), &sum, sizeof sum);
}

/// Number of a sound record, or nothing.
/// @param most numbers that a journal of this length can have
std::optional<std::uint64_t> number_of(std::string_view record, std::uint64_t most)
{
    const auto kind = value_at<std::uint32_t>(record, 4);
    const auto number = value_at<std::uint64_t>(record, 8);
    const bool plausible = kind >= static_cast<std::uint32_t>(RecordKind::row) &&
                           kind <= static_cast<std::uint32_t>(RecordKind::loss) && number < most;
    if (!plausible || value_at<std::uint32_t>(record, 0) != crc32(record.substr(sizeof(std::uint32_t))))
        return std::nullopt;
    return number;
}

/// Adds a record behind the others. `values` of the content has room for it: the views must stay.
std::span<double> add_record(JournalContent& content, RecordKind kind, std::uint64_t step, std::size_t values)
{
    const auto place = std::span(content.values).subspan(content.records.size() * values, values);
    content.records.push_back({kind, step, place});
    return place;
}

void add_loss(JournalContent& content, std::uint64_t step, std::size_t values)
{
    const double before = content.records.empty() ? -1.0 : static_cast<double>(content.records.back().step);
    add_record(content, RecordKind::loss, step, values)[0] = before;
    content.damaged = true;
}

/// The sound records up to the first one with a step later than `last_step`, wherever they lie: each has its number, so
/// that bytes that are lost, doubled or put in cost no record behind them.
JournalContent parse(std::string_view text, const std::string& header, std::size_t values, std::uint64_t last_step)
{
    JournalContent content;
    const bool known = text.substr(0, header_size) == header;
    const std::size_t size = record_size(values);
    const std::size_t count = known ? (text.size() - header_size) / size : 0;
    content.values.resize((2 * count + 2) * values); // a loss before each record, and two for what resume() adds
    content.bytes = header_size;
    content.damaged = !known;
    const std::uint64_t most = 2 * count + most_lost;
    std::uint64_t next = 0; // number of the record to come
    bool foreign = false;   // are there bytes before the record that are none of a record to come?
    for (std::size_t place = header_size; known && place + size <= text.size();) {
        const std::string_view record = text.substr(place, size);
        const std::optional<std::uint64_t> number = number_of(record, most);
        if (!number || *number < next) { // damaged, or doubled
            foreign = true;
            place += number ? size : 1;
            continue;
        }
        const auto step = value_at<std::uint64_t>(record, 16);
        if (step > last_step)
            break;
        if (*number > next)
            add_loss(content, step, values);
        content.damaged = content.damaged || foreign;
        foreign = false;
        next = *number + 1;
        const auto kind = static_cast<RecordKind>(value_at<std::uint32_t>(record, 4));
        std::memcpy(add_record(content, kind, step, values).data(), record.data() + fixed_size, size - fixed_size);
        place += size;
        content.bytes = place;
    }
    return content;
}

} // namespace

std::vector<std::string> JournalContent::losses() const
{
    std::vector<std::string> texts;
    for (const JournalRecord& record : records)
        if (record.kind == RecordKind::loss)
            texts.push_back(record.values[0] < 0.0
                                ? fmt::format("up to step {}", record.step)
                                : fmt::format("between steps {:.0f} and {}", record.values[0], record.step));
    return texts;
}

std::optional<std::uint64_t> JournalContent::last_step(RecordKind kind) const
{
    for (auto record = records.rbegin(); record != records.rend(); ++record)
        if (record->kind == kind)
            return record->step;
    return std::nullopt;
}

Journal::Journal(std::filesystem::path path, std::size_t values, std::string_view meaning)
    : path_(std::move(path)), header_(header_of(values, meaning)), values_(values)
{
}

Journal Journal::create(const std::filesystem::path& file, std::size_t values, std::string_view meaning)
{
    Journal journal(file, values, meaning);
    write_whole(file, journal.header_);
    journal.file_ = AppendedFile(file);
    return journal;
}

Journal Journal::resume(const std::filesystem::path& file, std::size_t values, std::string_view meaning,
                        std::uint64_t last_step, JournalContent& content)
{
    Journal journal(file, values, meaning);
    std::string text;
    try {
        text = read_whole(file);
    } catch (const FileError& error) {
        if (error.error() != ENOENT)
            throw;
    }
    content = parse(text, journal.header_, values, last_step);
    if (content.last_step(RecordKind::flush) != last_step) {
        // The records before the checkpoint are not all there. The flush keeps the next resume from finding this loss
        // once more.
        add_loss(content, last_step, values);
        add_record(content, RecordKind::flush, last_step, values);
    }
    journal.next_ = content.records.size();
    if (!content.damaged) {
        journal.file_ = AppendedFile(file);
        journal.file_.cut(content.bytes);
        return journal;
    }
    if (!text.empty()) // a copy, so that a journal has its name at every moment
        write_whole(name_when_damaged(file), text);
    std::string mended = journal.header_;
    for (std::size_t r = 0; r < content.records.size(); ++r) {
        const JournalRecord& record = content.records[r];
        encode(journal.record_, record.kind, r, record.step, record.values, values);
        mended += journal.record_;
    }
    write_whole(file, mended);
    journal.file_ = AppendedFile(file);
    return journal;
}

void Journal::add(RecordKind kind, std::uint64_t step, std::span<const double> values)
{
    encode(record_, kind, next_, step, values, values_);
    file_.append(record_);
    ++next_;
}

bool Journal::has_records(const std::filesystem::path& file)
{
    const std::string text = read_whole(file);
    std::size_t values = 0;
    const bool known =
        std::sscanf(text.c_str(), "periporo journal 1, %zu values", &values) == 1 && values < text.size();
    if (!known)
        return text.size() > header_size;
    const JournalContent content =
        parse(text, text.substr(0, header_size), values, std::numeric_limits<std::uint64_t>::max());
    return content.damaged || std::ranges::any_of(content.records, [](const JournalRecord& record) {
               return record.kind == RecordKind::row || record.kind == RecordKind::snapshot;
           });
}

JournalContent Journal::read() const
{
    return parse(read_whole(path_), header_, values_, std::numeric_limits<std::uint64_t>::max());
}

} // namespace periporo::output
