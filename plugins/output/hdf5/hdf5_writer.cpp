// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "hdf5": snapshots, history and provenance in `results.h5` (layout: results_file.hpp), and
// `results.xdmf` beside it.
#include "results_file.hpp"
#include "xdmf.hpp"

#include "common/part_file.hpp"

#include "periporo/output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace periporo::output {

namespace {

/// Rows of the history kept in memory at most.
constexpr std::size_t rows_between_writes = 256;

class Hdf5Writer : public OutputWriter {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        records.push_back(Parameter::integer("compression", "Deflate level of the snapshots, 0 for none")
                              .at_least(0)
                              .at_most(9)
                              .by_default(1));
        records.push_back(Parameter::fields("fields", "Names of the fields to store; all when left out").optional());
        return records;
    }

    explicit Hdf5Writer(const Parameters& parameters)
        : compression_(static_cast<int>(parameters.integer("compression")))
    {
        if (parameters.has("fields"))
            chosen_fields_ = parameters.text_list("fields");
    }

    ~Hdf5Writer() override
    {
        try {
            write_history();              // the rows of a run that ended by an error
        } catch (const std::exception&) { // a destructor has nobody to tell
        }
    }

    void begin(const RunDescription& run) override
    {
        file_ = run.directory / "results.h5";
        part_ = part_of(file_);
        xdmf_ = run.directory / "results.xdmf";
        columns_ = run.history.size();
        if (run.resumed) {
            if (const std::filesystem::path earlier = earlier_output(file_); earlier != part_)
                std::filesystem::rename(earlier, part_);
            results_ = ResultsFile::resume(part_, run, compression_);
        } else {
            require_writable(part_);
            results_ = ResultsFile::create(part_, run, compression_);
        }
    }

    void snapshot(const Snapshot& snapshot) override
    {
        write_history();
        results_.value().append(snapshot, selected(snapshot));
        write_xdmf(part_);
    }

    void history(std::uint64_t step, std::span<const double> values) override
    {
        if (values.size() != columns_)
            throw std::logic_error(
                fmt::format("{}: a row of {} values for {} columns", part_.string(), values.size(), columns_));
        rows_.steps.push_back(static_cast<std::int64_t>(step));
        rows_.values.insert(rows_.values.end(), values.begin(), values.end());
        if (rows_.steps.size() >= rows_between_writes)
            write_history();
    }

    void flush() override
    {
        write_history();
        synchronize(part_);
    }

    void finish(bool complete) override
    {
        if (!results_)
            return;
        write_history();
        results_->set_complete(complete);
        publish(part_, file_);
        write_xdmf(file_);
        results_.reset();
    }

private:
    /// The fields of a snapshot that the user asked for.
    std::vector<FieldView> selected(const Snapshot& snapshot) const
    {
        if (!chosen_fields_)
            return snapshot.fields;
        std::vector<FieldView> fields;
        for (const std::string& name : *chosen_fields_) {
            const auto field = std::find_if(snapshot.fields.begin(), snapshot.fields.end(),
                                            [&](const FieldView& candidate) { return candidate.name == name; });
            if (field == snapshot.fields.end()) {
                std::vector<std::string> names;
                for (const FieldView& known : snapshot.fields)
                    names.push_back(known.name);
                throw std::runtime_error(
                    fmt::format("output \"hdf5\" for {}: there is no field \"{}\"; the fields are {}", file_.string(),
                                name, fmt::join(names, ", ")));
            }
            fields.push_back(*field);
        }
        return fields;
    }

    void write_history()
    {
        if (!results_ || rows_.steps.empty())
            return;
        results_->append(rows_);
        rows_ = {};
    }

    void write_xdmf(const std::filesystem::path& data_file) const
    {
        const std::filesystem::path part = part_of(xdmf_);
        require_writable(part);
        std::ofstream stream(part, std::ios::binary | std::ios::trunc);
        stream << xdmf_text(results_->snapshots(), data_file.filename().string());
        stream.close();
        if (!stream)
            throw_file_error("cannot write", part, EIO);
        std::filesystem::rename(part, xdmf_);
    }

    int compression_;
    std::optional<std::vector<std::string>> chosen_fields_;
    std::filesystem::path file_;
    std::filesystem::path part_;
    std::filesystem::path xdmf_;
    std::size_t columns_ = 0;
    std::optional<ResultsFile> results_; ///< between begin and finish
    HistoryRows rows_;
};

} // namespace

} // namespace periporo::output

PERIPORO_PLUGIN(periporo::PluginKind::output, periporo::output::Hdf5Writer, "hdf5",
                "Snapshots, history and provenance in one HDF5 file, with an XDMF description for ParaView")
