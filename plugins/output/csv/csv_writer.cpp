// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "csv": the history of the run as `history.csv`, one row each time. Snapshots are not stored.
#include "history_table.hpp"

#include "periporo/output.hpp"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <stdexcept>

namespace periporo::output {

namespace {

class CsvWriter : public OutputWriter, public EarlierOutputReader {
public:
    static std::vector<Parameter> parameters() { return {}; }

    explicit CsvWriter(const Parameters&) {}

    std::vector<std::string> files() const override { return {csv_name, csv_journal_name}; }

    void begin(const RunDescription& run) override
    {
        columns_ = run.history.size();
        table_ = run.resumed ? HistoryTable::resume(run) : HistoryTable::create(run);
    }

    EarlierOutput earlier_output(const std::filesystem::path& directory) const override
    {
        return HistoryTable::look_at(directory);
    }

    void expect(std::vector<SnapshotMoment>) override {} // it stores none

    void snapshot(const Snapshot&) override {}

    void history(std::uint64_t step, std::span<const double> values) override
    {
        if (values.size() != columns_)
            throw std::logic_error(
                fmt::format("{}: a row of {} values for {} columns", csv_name, values.size(), columns_));
        row_.clear();
        auto append = std::back_inserter(row_);
        fmt::format_to(append, "{}", step);
        for (const double value : values)
            fmt::format_to(append, ",{}", value); // the shortest text that reads back as the same double
        row_.push_back('\n');
        table_.value().add(step, row_);
    }

    void flush(std::uint64_t step) override { table_.value().flush(step); }

    void finish(bool) override
    {
        if (table_)
            table_->synchronize();
    }

    void clean_up() override
    {
        if (table_)
            table_->remove_journal();
    }

private:
    std::optional<HistoryTable> table_; ///< from begin on
    std::string row_;
    std::size_t columns_ = 0;
};

} // namespace

} // namespace periporo::output

PERIPORO_PLUGIN(periporo::PluginKind::output, periporo::output::CsvWriter, "csv",
                "The history of the run as comma-separated values; snapshots are not stored")
