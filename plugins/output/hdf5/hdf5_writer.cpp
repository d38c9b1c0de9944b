// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "hdf5": snapshots, history and provenance in `results.h5` (layout: results_file.hpp), and
// `results.xdmf` beside it.
#include "results_parts.hpp"

#include "periporo/output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace periporo::output {

namespace {

class Hdf5Writer : public OutputWriter, public EarlierOutputReader {
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

    std::vector<std::string> files() const override { return {results_name, xdmf_name, parts_name}; }

    void begin(const RunDescription& run) override
    {
        columns_ = run.history.size();
        results_ =
            run.resumed ? ResultsParts::resume(run, compression_, expected_) : ResultsParts::create(run, compression_);
    }

    EarlierOutput earlier_output(const std::filesystem::path& directory) const override
    {
        return ResultsParts::look_at(directory);
    }

    void expect(std::vector<SnapshotMoment> snapshots) override { expected_ = std::move(snapshots); }

    void snapshot(const Snapshot& snapshot) override { results_.value().add(snapshot, selected(snapshot)); }

    void history(std::uint64_t step, std::span<const double> values) override
    {
        if (values.size() != columns_)
            throw std::logic_error(
                fmt::format("{}: a row of {} values for {} columns", results_name, values.size(), columns_));
        results_.value().add(step, values);
    }

    void flush(std::uint64_t step) override { results_.value().flush(step); }

    void finish(bool complete) override
    {
        if (!results_)
            return;
        if (complete)
            results_->merge();
        else
            results_->show();
    }

    void clean_up() override
    {
        if (results_)
            results_->clean_up();
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
                throw std::runtime_error(fmt::format("output \"hdf5\": there is no field \"{}\"; the fields are {}",
                                                     name, fmt::join(names, ", ")));
            }
            fields.push_back(*field);
        }
        return fields;
    }

    int compression_;
    std::optional<std::vector<std::string>> chosen_fields_;
    std::size_t columns_ = 0;
    std::vector<SnapshotMoment> expected_; ///< of a resumed run
    std::optional<ResultsParts> results_;  ///< from begin on
};

} // namespace

} // namespace periporo::output

PERIPORO_PLUGIN(periporo::PluginKind::output, periporo::output::Hdf5Writer, "hdf5",
                "Snapshots, history and provenance in one HDF5 file, with an XDMF description for ParaView")
