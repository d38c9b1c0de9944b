// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Named arrays in one file, written aside and renamed when complete: what a checkpoint is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace periporo {

/// Collects arrays in `<path>.part`; nothing is seen under `path` before commit().
/// Every call throws std::runtime_error with the path when the file system fails.
class ArchiveWriter {
public:
    explicit ArchiveWriter(std::filesystem::path path);
    ~ArchiveWriter(); ///< an archive that was not committed is removed
    ArchiveWriter(const ArchiveWriter&) = delete;
    ArchiveWriter& operator=(const ArchiveWriter&) = delete;

    void put(const std::string& name, std::span<const double> values);
    void put(const std::string& name, std::span<const std::int64_t> values);
    void put(const std::string& name, std::span<const std::uint8_t> values);
    void put(const std::string& name, const std::string& text);
    /// An array whose parts lie apart.
    void put_parts(const std::string& name, std::span<const std::span<const double>> parts);
    /// Flushes to the disk and renames over `path`.
    void commit();

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Reads back what an ArchiveWriter wrote, bit by bit. A missing name throws std::runtime_error naming it and the file.
class ArchiveReader {
public:
    explicit ArchiveReader(std::filesystem::path path);
    ~ArchiveReader();
    ArchiveReader(const ArchiveReader&) = delete;
    ArchiveReader& operator=(const ArchiveReader&) = delete;

    bool has(const std::string& name) const;
    std::vector<double> reals(const std::string& name) const;
    std::vector<std::int64_t> integers(const std::string& name) const;
    std::vector<std::uint8_t> bytes(const std::string& name) const;
    std::string text(const std::string& name) const;
    /// Fills parts with an array, one after the other.
    /// @throws std::runtime_error when it has another length than all parts together.
    void read_parts(const std::string& name, std::span<const std::span<double>> parts) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace periporo
