// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writing, extending and cutting back the result file.
#include "results_file.hpp"

#include "hdf5_objects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace periporo::output {

namespace {

/// Entries of the provenance become datasets, whose names cannot hold a slash.
std::string dataset_name(std::string entry)
{
    std::replace(entry.begin(), entry.end(), '/', '_');
    return entry;
}

std::vector<std::string> members(const H5::Group& group)
{
    std::vector<std::string> names;
    for (hsize_t i = 0; i < group.getNumObjs(); ++i)
        names.push_back(group.getObjnameByIdx(i)); // in the order of their names
    return names;
}

StoredSnapshot describe(const H5::Group& group, std::string path)
{
    StoredSnapshot stored{std::move(path), read_real_attribute(group, "time"), 0, {}};
    for (const std::string& name : members(group)) {
        const H5::DataSet dataset = group.openDataSet(name);
        const H5::DataSpace space = dataset.getSpace();
        std::array<hsize_t, 2> extent{0, 1};
        space.getSimpleExtentDims(extent.data());
        if (name == "position")
            stored.points = extent[0];
        else
            stored.fields.push_back({name, extent[1], dataset.getTypeClass() == H5T_INTEGER});
    }
    return stored;
}

/// The snapshots up to a step; those after it are removed.
std::vector<StoredSnapshot> keep_snapshots(const H5::Group& snapshots, std::int64_t last_step)
{
    std::vector<StoredSnapshot> kept;
    for (const std::string& name : members(snapshots)) {
        const H5::Group group = snapshots.openGroup(name);
        if (read_integer_attribute(group, "step") <= last_step)
            kept.push_back(describe(group, "/snapshots/" + name));
        else
            snapshots.unlink(name);
    }
    return kept;
}

/// Cuts every column after the last row of a step not later than `last_step`.
void keep_history(const H5::Group& history, const std::vector<std::string>& columns, std::int64_t last_step)
{
    std::vector<std::int64_t> steps(column_length(history, "step"));
    if (!steps.empty())
        history.openDataSet("step").read(steps.data(), H5::PredType::NATIVE_INT64);
    hsize_t length = static_cast<hsize_t>(
        std::find_if(steps.begin(), steps.end(), [&](std::int64_t step) { return step > last_step; }) - steps.begin());
    // Rows that a kill left in some columns only are no rows.
    for (const std::string& column : columns)
        length = std::min(length, column_length(history, column));
    cut_column(history, "step", length);
    for (const std::string& column : columns)
        cut_column(history, column, length);
}

void require_same_columns(const H5::Group& history, const std::vector<std::string>& columns,
                          const std::filesystem::path& file)
{
    std::vector<std::string> wanted = columns;
    wanted.emplace_back("step");
    std::sort(wanted.begin(), wanted.end());
    std::vector<std::string> found = members(history);
    std::sort(found.begin(), found.end());
    if (found != wanted)
        throw std::runtime_error(fmt::format("cannot resume {}: its history is {}, and this run's is {}", file.string(),
                                             fmt::join(found, ", "), fmt::join(wanted, ", ")));
}

void write_vertices(const H5::H5File& file, std::size_t points, int compression)
{
    if (file.nameExists(vertex_list(points)))
        return;
    std::vector<std::int64_t> numbers(points);
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    write_array(file, vertex_list(points), std::span<const std::int64_t>(numbers), 1, "-",
                "Numbers of the points, in order", compression);
}

void write_field(const H5::Group& group, const FieldView& field, std::size_t points, int compression)
{
    const std::size_t size = field.integers.empty() ? field.values.size() : field.integers.size();
    if (field.components == 0 || size != field.components * points)
        throw std::logic_error(fmt::format("field \"{}\" has {} values for {} points of {} components", field.name,
                                           size, points, field.components));
    if (field.integers.empty())
        write_array(group, field.name, field.values, field.components, field.unit, field.description, compression);
    else
        write_array(group, field.name, field.integers, field.components, field.unit, field.description, compression);
}

} // namespace

std::string vertex_list(std::size_t points)
{
    return fmt::format("/vertices/{}", points);
}

ResultsFile::ResultsFile(std::filesystem::path file, const RunDescription& run, int compression)
    : file_(std::move(file)), compression_(compression)
{
    for (const HistoryColumn& column : run.history)
        columns_.push_back(column.name);
}

ResultsFile ResultsFile::create(std::filesystem::path path, const RunDescription& run, int compression)
{
    ResultsFile results(std::move(path), run, compression);
    guarded("cannot write", results.file_, [&] {
        H5::H5File file = open_unlocked(results.file_, H5F_ACC_TRUNC);
        const H5::Group root = file.openGroup("/");
        write_attribute(root, "format", std::string(results_format));
        write_attribute(root, "format_version", results_format_version);
        write_attribute(root, "title", run.title);
        write_attribute(root, "complete", std::int64_t{0});
        root.createGroup("snapshots");
        root.createGroup("vertices");
        const H5::Group history = root.createGroup("history");
        create_column(history, "step", H5::PredType::NATIVE_INT64, "-", "Steps since the start of the run");
        for (const HistoryColumn& column : run.history)
            create_column(history, column.name, H5::PredType::NATIVE_DOUBLE, column.unit, column.description);
        const H5::Group provenance = root.createGroup("provenance");
        write_text(provenance, "resolved_case", run.resolved_case);
        for (const auto& [entry, text] : run.provenance)
            if (entry != "resolved_case")
                write_text(provenance, dataset_name(entry), text);
        file.close();
    });
    return results;
}

ResultsFile ResultsFile::resume(std::filesystem::path path, const RunDescription& run, int compression)
{
    ResultsFile results(std::move(path), run, compression);
    guarded("cannot resume", results.file_, [&] {
        H5::H5File file = open_unlocked(results.file_, H5F_ACC_RDWR);
        const H5::Group root = file.openGroup("/");
        if (!root.attrExists("format") || read_text_attribute(root, "format") != results_format ||
            read_integer_attribute(root, "format_version") != results_format_version)
            throw std::runtime_error(fmt::format("cannot resume {}: it is no result file of format version {}",
                                                 results.file_.string(), results_format_version));
        const H5::Group history = root.openGroup("history");
        require_same_columns(history, results.columns_, results.file_);
        const auto last_step = static_cast<std::int64_t>(run.resumed_step);
        keep_history(history, results.columns_, last_step);
        results.snapshots_ = keep_snapshots(root.openGroup("snapshots"), last_step);
        write_attribute(root, "complete", std::int64_t{0});
        file.close();
    });
    return results;
}

void ResultsFile::append(const Snapshot& snapshot, const std::vector<FieldView>& fields)
{
    const std::size_t points = snapshot.positions.size() / 3;
    StoredSnapshot stored{fmt::format("/snapshots/{:06}", snapshots_.size()), snapshot.time, points, {}};
    guarded("cannot write a snapshot to", file_, [&] {
        H5::H5File file = open_unlocked(file_, H5F_ACC_RDWR);
        write_vertices(file, points, compression_);
        const H5::Group group = file.createGroup(stored.group);
        write_attribute(group, "step", static_cast<std::int64_t>(snapshot.step));
        write_attribute(group, "time", snapshot.time);
        write_attribute(group, "stage", snapshot.stage);
        write_array(group, "position", snapshot.positions, 3, "m", "Position of the point, x y z", compression_);
        for (const FieldView& field : fields) {
            write_field(group, field, points, compression_);
            stored.fields.push_back({field.name, field.components, !field.integers.empty()});
        }
        file.close();
    });
    // The order in which a resumed run finds them again.
    std::sort(stored.fields.begin(), stored.fields.end(),
              [](const StoredField& a, const StoredField& b) { return a.name < b.name; });
    snapshots_.push_back(std::move(stored));
}

void ResultsFile::append(const HistoryRows& rows)
{
    guarded("cannot write history to", file_, [&] {
        H5::H5File file = open_unlocked(file_, H5F_ACC_RDWR);
        const H5::Group history = file.openGroup("history");
        append_to_column(history, "step", std::span<const std::int64_t>(rows.steps));
        std::vector<double> column(rows.steps.size());
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            for (std::size_t r = 0; r < column.size(); ++r)
                column[r] = rows.values[r * columns_.size() + c];
            append_to_column(history, columns_[c], std::span<const double>(column));
        }
        file.close();
    });
}

void ResultsFile::set_complete(bool complete)
{
    guarded("cannot write", file_, [&] {
        H5::H5File file = open_unlocked(file_, H5F_ACC_RDWR);
        write_attribute(file.openGroup("/"), "complete", std::int64_t{complete});
        file.close();
    });
}

} // namespace periporo::output
