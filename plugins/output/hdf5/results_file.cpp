// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writing a result file, with links to its snapshots or with the snapshots themselves.
#include "results_file.hpp"

#include "hdf5_driver.hpp"
#include "hdf5_objects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace periporo::output {

namespace {

/// Entries of the provenance become datasets, whose names cannot hold a slash.
std::string dataset_name(std::string entry)
{
    std::replace(entry.begin(), entry.end(), '/', '_');
    return entry;
}

void write_history(const H5::Group& group, const ResultsContent& content)
{
    std::vector<std::int64_t> steps;
    for (const JournalRecord& record : content.history.records)
        if (record.kind == RecordKind::row)
            steps.push_back(static_cast<std::int64_t>(record.step));
    write_array(group, "step", std::span<const std::int64_t>(steps), 1, "-", "Steps since the start of the run", 0);
    std::vector<double> values(steps.size());
    for (std::size_t c = 0; c < content.run.history.size(); ++c) {
        std::size_t row = 0;
        for (const JournalRecord& record : content.history.records)
            if (record.kind == RecordKind::row)
                values[row++] = record.values[c];
        const HistoryColumn& column = content.run.history[c];
        write_array(group, column.name, std::span<const double>(values), 1, column.unit, column.description, 0);
    }
}

void write_provenance(const H5::Group& group, const RunDescription& run)
{
    write_text(group, "resolved_case", run.resolved_case);
    for (const auto& [entry, text] : run.provenance)
        if (entry != "resolved_case")
            write_text(group, dataset_name(entry), text);
}

/// All but snapshots and vertices.
void write_frame(const H5::H5File& file, const ResultsContent& content)
{
    const H5::Group root = file.openGroup("/");
    write_attribute(root, "format", std::string(results_format));
    write_attribute(root, "format_version", results_format_version);
    write_attribute(root, "title", content.run.title);
    write_attribute(root, "complete", std::int64_t{content.complete});
    if (!content.missing.empty())
        write_attribute(root, "missing", fmt::format("{}", fmt::join(content.missing, "\n")));
    write_history(root.createGroup("history"), content);
    write_provenance(root.createGroup("provenance"), content.run);
}

std::set<std::size_t> point_counts(const std::vector<StoredSnapshot>& snapshots)
{
    std::set<std::size_t> counts;
    for (const StoredSnapshot& snapshot : snapshots)
        counts.insert(snapshot.points);
    return counts;
}

} // namespace

std::string vertex_list(std::size_t points)
{
    return fmt::format("/vertices/{}", points);
}

StoredResults look_at_results(const std::filesystem::path& file)
{
    StoredResults stored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file)))
        return stored;
    require_regular(file);
    try {
        H5::Exception::dontPrint();
        const H5::H5File results = open_unlocked(file);
        stored.snapshots = results.openGroup("/snapshots").getNumObjs();
        stored.rows =
            static_cast<std::uint64_t>(results.openDataSet("/history/step").getSpace().getSimpleExtentNpoints());
        stored.complete = read_whole_attribute(results.openGroup("/"), "complete") == 1;
    } catch (const H5::Exception&) {
        stored = {.readable = false};
    }
    return stored;
}

void write_linked_results(const std::filesystem::path& file, const ResultsContent& content, const std::string& parts)
{
    const std::filesystem::path aside = part_of(file);
    guarded("cannot write", file, [&] {
        write_hdf5_file(aside, [&](H5::H5File& results) {
            write_frame(results, content);
            write_attribute(
                results.openGroup("/"), "parts",
                fmt::format("The snapshots are files in the folder {0} until the run is complete; copy this "
                            "file and {0} together",
                            parts));
            const H5::Group snapshots = results.createGroup("snapshots");
            for (const StoredSnapshot& snapshot : content.snapshots)
                link_to_file(snapshots, snapshot.name(), parts + "/" + snapshot.part_name(), part_snapshot);
            const H5::Group vertices = results.createGroup("vertices");
            for (const std::size_t points : point_counts(content.snapshots))
                link_to_file(vertices, std::to_string(points), parts + "/" + vertices_part_name(points), part_vertices);
        });
    });
    publish(aside, file);
}

void write_merged_results(const std::filesystem::path& file, const ResultsContent& content,
                          const std::filesystem::path& parts, int compression)
{
    const std::filesystem::path aside = part_of(file);
    guarded("cannot write", file, [&] {
        write_hdf5_file(aside, [&](H5::H5File& results) {
            write_frame(results, content);
            const H5::Group snapshots = results.createGroup("snapshots");
            for (const StoredSnapshot& snapshot : content.snapshots)
                copy_object(open_unlocked(parts / snapshot.part_name()), part_snapshot, snapshots, snapshot.name());
            const H5::Group vertices = results.createGroup("vertices");
            for (const std::size_t points : point_counts(content.snapshots))
                write_vertices(vertices, std::to_string(points), points, compression);
        });
    });
    publish(aside, file);
}

} // namespace periporo::output
