// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One snapshot as an HDF5 file of its own, that shows by a checksum whether it is what was written.
#pragma once

#include "periporo/output.hpp"

#include <H5Cpp.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace periporo::output {

/// The group of a snapshot in its file, and the dataset of the file of vertices.
inline constexpr const char* part_snapshot = "/snapshot";
inline constexpr const char* part_vertices = "/vertices";

/// What is known of a field of a snapshot, enough to point at it from elsewhere.
struct StoredField {
    std::string name;
    std::size_t components = 1;
    bool integers = false;
};

struct StoredSnapshot {
    std::uint64_t number = 0;
    std::uint64_t step = 0;
    double time = 0.0; ///< [s]
    std::size_t points = 0;
    std::vector<StoredField> fields = {}; ///< by name, without the position
    std::uint32_t sum = 0;                ///< checksum of the part

    std::string name() const;      ///< "000012"
    std::string part_name() const; ///< "000012-2400.h5": number and step
};

/// Number and step of a part by its name, nothing for another file.
std::optional<std::pair<std::uint64_t, std::uint64_t>> number_and_step(const std::string& part_name);
/// "vertices-1200.h5"
std::string vertices_part_name(std::size_t points);

/// Writes a snapshot into `folder`: complete or absent. @throws FileError
StoredSnapshot write_snapshot_part(const std::filesystem::path& folder, std::uint64_t number, const Snapshot& snapshot,
                                   const std::vector<FieldView>& fields, int compression);

/// Looks at a part that was written earlier; nothing when it is damaged, or holds the snapshot of another step than its
/// name says. Bytes whose checksum is wrong never reach HDF5.
std::optional<StoredSnapshot> read_snapshot_part(const std::filesystem::path& part);

/// Is the file the part that was written for this snapshot? @throws FileError when it cannot be read
bool is_sound_part(const std::filesystem::path& folder, const StoredSnapshot& snapshot);

/// The numbers 0 to points-1.
void write_vertices(const H5::Group& group, const std::string& name, std::size_t points, int compression);
void write_vertices_part(const std::filesystem::path& folder, std::size_t points, int compression);

} // namespace periporo::output
