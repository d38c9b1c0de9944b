// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "csv": the history of the run as `history.csv`, one row each time. Snapshots are not stored.
#include "common/part_file.hpp"

#include "periporo/output.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace periporo::output {

namespace {

/// Rows between two flushes: a reader that follows the file, or a kill, misses no more than these.
constexpr int rows_between_flushes = 16;

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
    return line;
}

/// The step at the beginning of a row, or nothing when the row has none.
std::optional<std::uint64_t> step_of(std::string_view row)
{
    std::uint64_t step = 0;
    const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), step);
    if (error != std::errc() || (end != row.data() + row.size() && *end != ','))
        return std::nullopt;
    return step;
}

/// The rows of an earlier run that still hold. A last line without its end is what a kill left of a row.
std::string kept_rows(const std::filesystem::path& file, const std::string& expected_header, std::uint64_t last_step)
{
    std::ifstream input(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
    if (!input.is_open() || input.bad())
        throw std::runtime_error(fmt::format("cannot read {}", file.string()));
    std::string kept;
    std::string_view rest = text;
    bool first = true;
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (std::exchange(first, false)) {
            if (line != expected_header)
                throw std::runtime_error(fmt::format("cannot resume {}: its columns are\n  {}\nand this run's\n  {}",
                                                     file.string(), line, expected_header));
        } else if (const auto step = step_of(line); !step) {
            throw std::runtime_error(fmt::format("cannot resume {}: not a row: {}", file.string(), line));
        } else if (*step > last_step) {
            break;
        }
        kept.append(line).push_back('\n');
    }
    return first ? expected_header + '\n' : kept;
}

class CsvWriter : public OutputWriter {
public:
    static std::vector<Parameter> parameters() { return {}; }

    explicit CsvWriter(const Parameters&) {}

    void begin(const RunDescription& run) override
    {
        file_ = run.directory / "history.csv";
        part_ = part_of(file_);
        columns_ = run.history.size();
        const std::string head = header(run.history);
        const std::string text = run.resumed ? kept_rows(earlier_output(file_), head, run.resumed_step) : head + '\n';
        // The rows kept are complete under another name before the earlier part is given up.
        const std::filesystem::path fresh = file_.string() + ".new";
        require_writable(fresh);
        stream_.open(fresh, std::ios::binary | std::ios::trunc);
        stream_ << text;
        hand_over();
        std::filesystem::rename(fresh, part_);
    }

    void snapshot(const Snapshot&) override {}

    void history(std::uint64_t step, std::span<const double> values) override
    {
        if (values.size() != columns_)
            throw std::logic_error(
                fmt::format("{}: a row of {} values for {} columns", part_.string(), values.size(), columns_));
        row_.clear();
        auto append = std::back_inserter(row_);
        fmt::format_to(append, "{}", step);
        for (const double value : values)
            fmt::format_to(append, ",{}", value); // the shortest text that reads back as the same double
        row_.push_back('\n');
        stream_ << row_;
        if (++rows_unflushed_ >= rows_between_flushes)
            hand_over();
    }

    void flush() override
    {
        hand_over();
        synchronize(part_);
    }

    void finish(bool) override
    {
        if (!stream_.is_open())
            return;
        hand_over();
        stream_.close();
        publish(part_, file_);
    }

private:
    /// Gives all rows to the system: they survive the end of the program, though not of the machine.
    void hand_over()
    {
        rows_unflushed_ = 0;
        errno = 0;
        if (!stream_.flush())
            throw_file_error("cannot write", part_, errno != 0 ? errno : EIO);
    }

    std::filesystem::path file_;
    std::filesystem::path part_;
    std::ofstream stream_;
    std::string row_;
    std::size_t columns_ = 0;
    int rows_unflushed_ = 0;
};

} // namespace

} // namespace periporo::output

PERIPORO_PLUGIN(periporo::PluginKind::output, periporo::output::CsvWriter, "csv",
                "The history of the run as comma-separated values; snapshots are not stored")
