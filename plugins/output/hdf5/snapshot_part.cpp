// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writing, sealing and checking the file of a snapshot.
//
// A seal of fixed length stands behind the end of the HDF5 data, where HDF5 does not look: size and checksum of all
// bytes before it.
#include "snapshot_part.hpp"

#include "hdf5_driver.hpp"
#include "hdf5_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace periporo::output {

namespace {

std::string seal_of(std::uint64_t size, std::uint32_t sum)
{
    return fmt::format("\nperiporo part of {:20} bytes, crc32 {:08x}\n", size, sum);
}

/// Size and checksum of a file, the last `without` bytes left out, and these bytes.
struct Contents {
    std::uint64_t size = 0;
    std::uint32_t sum = 0;
    std::string rest;
};

Contents contents_of(const std::filesystem::path& file, std::size_t without)
{
    errno = 0;
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream)
        throw FileError("cannot read", file, errno);
    const auto length = static_cast<std::uint64_t>(stream.tellg());
    Contents contents;
    contents.size = length - std::min<std::uint64_t>(length, without);
    stream.seekg(0);
    std::vector<char> block(1 << 20);
    for (std::uint64_t left = contents.size; left > 0;) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, block.size()));
        if (!stream.read(block.data(), static_cast<std::streamsize>(count)))
            throw FileError("cannot read", file, errno != 0 ? errno : EIO);
        contents.sum = crc32({block.data(), count}, contents.sum);
        left -= count;
    }
    contents.rest.resize(static_cast<std::size_t>(length - contents.size));
    stream.read(contents.rest.data(), static_cast<std::streamsize>(contents.rest.size()));
    return contents;
}

/// Checksum of a part, or nothing when it is not the one of its seal.
std::optional<std::uint32_t> sum_of_part(const std::filesystem::path& part)
{
    const Contents contents = contents_of(part, seal_of(0, 0).size());
    if (contents.rest != seal_of(contents.size, contents.sum))
        return std::nullopt;
    return contents.sum;
}

/// Writes an HDF5 file by fill(H5::H5File&), seals it and gives it its name. @return its checksum
template <class Fill>
std::uint32_t write_part(const std::filesystem::path& file, Fill&& fill)
{
    const std::filesystem::path aside = part_of(file);
    guarded("cannot write", file, [&] { write_hdf5_file(aside, fill); });
    try {
        const Contents contents = contents_of(aside, 0);
        AppendedFile(aside).append(seal_of(contents.size, contents.sum));
        publish(aside, file);
        return contents.sum;
    } catch (...) {
        std::error_code ignored; // the room may be needed
        std::filesystem::remove(aside, ignored);
        throw;
    }
}

StoredField write_field(const H5::Group& group, const FieldView& field, std::size_t points, int compression)
{
    const std::size_t size = field.integers.empty() ? field.values.size() : field.integers.size();
    if (field.components == 0 || size != field.components * points)
        throw std::logic_error(fmt::format("field \"{}\" has {} values for {} points of {} components", field.name,
                                           size, points, field.components));
    if (field.integers.empty())
        write_array(group, field.name, field.values, field.components, field.unit, field.description, compression);
    else
        write_array(group, field.name, field.integers, field.components, field.unit, field.description, compression);
    return {field.name, field.components, !field.integers.empty()};
}

template <class Number>
bool read_number(std::string_view& text, Number& number)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc();
}

StoredSnapshot describe(const H5::Group& group)
{
    StoredSnapshot stored;
    stored.step = static_cast<std::uint64_t>(read_whole_attribute(group, "step"));
    stored.time = read_real_attribute(group, "time");
    for (hsize_t i = 0; i < group.getNumObjs(); ++i) { // in the order of their names
        const std::string name = group.getObjnameByIdx(i);
        const H5::DataSet dataset = group.openDataSet(name);
        std::array<hsize_t, H5S_MAX_RANK> extent{0, 1};
        dataset.getSpace().getSimpleExtentDims(extent.data());
        if (name == "position")
            stored.points = extent[0];
        else
            stored.fields.push_back({name, extent[1], dataset.getTypeClass() == H5T_INTEGER});
    }
    return stored;
}

} // namespace

std::string StoredSnapshot::name() const
{
    return fmt::format("{:06}", number);
}

std::string StoredSnapshot::part_name() const
{
    return fmt::format("{:06}-{}.h5", number, step);
}

std::optional<std::pair<std::uint64_t, std::uint64_t>> number_and_step(const std::string& part_name)
{
    StoredSnapshot snapshot;
    std::string_view text = part_name;
    if (!read_number(text, snapshot.number) || !text.starts_with('-'))
        return std::nullopt;
    text.remove_prefix(1);
    if (!read_number(text, snapshot.step) || snapshot.part_name() != part_name)
        return std::nullopt;
    return std::pair(snapshot.number, snapshot.step);
}

std::string vertices_part_name(std::size_t points)
{
    return fmt::format("vertices-{}.h5", points);
}

StoredSnapshot write_snapshot_part(const std::filesystem::path& folder, std::uint64_t number, const Snapshot& snapshot,
                                   const std::vector<FieldView>& fields, int compression)
{
    StoredSnapshot stored{number, snapshot.step, snapshot.time, snapshot.positions.size() / 3};
    stored.sum = write_part(folder / stored.part_name(), [&](H5::H5File& file) {
        const H5::Group group = file.createGroup(part_snapshot);
        write_attribute(group, "step", static_cast<std::int64_t>(snapshot.step));
        write_attribute(group, "time", snapshot.time);
        write_attribute(group, "stage", snapshot.stage);
        write_array(group, "position", snapshot.positions, 3, "m", "Position of the point, x y z", compression);
        for (const FieldView& field : fields)
            stored.fields.push_back(write_field(group, field, stored.points, compression));
    });
    // The order in which a resumed run finds them again.
    std::sort(stored.fields.begin(), stored.fields.end(),
              [](const StoredField& a, const StoredField& b) { return a.name < b.name; });
    return stored;
}

bool is_sound_part(const std::filesystem::path& folder, const StoredSnapshot& snapshot)
{
    const std::filesystem::path part = folder / snapshot.part_name();
    return std::filesystem::is_regular_file(std::filesystem::symlink_status(part)) && sum_of_part(part) == snapshot.sum;
}

std::optional<StoredSnapshot> read_snapshot_part(const std::filesystem::path& part)
{
    const auto known = number_and_step(part.filename().string());
    if (!known || !std::filesystem::is_regular_file(std::filesystem::symlink_status(part)))
        return std::nullopt;
    const std::optional<std::uint32_t> sum = sum_of_part(part);
    if (!sum)
        return std::nullopt;
    return guarded("cannot read", part, [&]() -> std::optional<StoredSnapshot> {
        StoredSnapshot stored = describe(open_unlocked(part).openGroup(part_snapshot));
        if (stored.step != known->second) // somebody has copied another part over it
            return std::nullopt;
        stored.number = known->first;
        stored.sum = *sum;
        return stored;
    });
}

void write_vertices(const H5::Group& group, const std::string& name, std::size_t points, int compression)
{
    std::vector<std::int64_t> numbers(points);
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    write_array(group, name, std::span<const std::int64_t>(numbers), 1, "-", "Numbers of the points, in order",
                compression);
}

void write_vertices_part(const std::filesystem::path& folder, std::size_t points, int compression)
{
    write_part(folder / vertices_part_name(points),
               [&](H5::H5File& file) { write_vertices(file.openGroup("/"), part_vertices + 1, points, compression); });
}

} // namespace periporo::output
