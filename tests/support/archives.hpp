// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Archives of tests: a part that is saved and restored, and files with another content but a right checksum.
#pragma once

#include "io/archive.hpp"
#include "support/temporary_folder.hpp"

#include <boost/crc.hpp>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace periporo::test {

/// Gives a part what another one saved.
template <class Part, class... Known>
void save_and_restore(const Part& from, Part& to, const Known&... known)
{
    const TemporaryFolder folder;
    {
        ArchiveWriter writer(folder / "part");
        writer.part("part", from, known...);
        writer.commit();
    }
    ArchiveReader(folder / "part").part("part", to, known...);
}

inline std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

/// Bytes of the mark that an archive begins with, and of the checksum that it ends with.
inline constexpr std::size_t mark_size = 23, checksum_size = 4;

/// Writes the bytes of an archive with the checksum that belongs to them behind.
inline void write_with_checksum(const std::filesystem::path& file, std::string bytes)
{
    boost::crc_32_type checksum;
    checksum.process_bytes(bytes.data(), bytes.size());
    const std::uint32_t value = checksum.checksum();
    bytes.append(reinterpret_cast<const char*>(&value), checksum_size);
    write_bytes(file, bytes);
}

/// The content of an archive as a list of entries, in the order of the file.
struct ArchiveContent {
    struct Entry {
        StoredKind kind;
        std::uint64_t count;
        std::string name;
        std::string numbers;
    };
    std::string mark;
    std::vector<Entry> entries;

    explicit ArchiveContent(const std::filesystem::path& file)
    {
        const std::string bytes = bytes_of(file);
        mark = bytes.substr(0, mark_size);
        for (std::size_t at = mark_size; at < bytes.size() - checksum_size;) {
            Entry entry = {static_cast<StoredKind>(bytes[at]), 0, "", ""};
            std::uint32_t length = 0;
            std::memcpy(&length, &bytes[at + 1], 4);
            std::memcpy(&entry.count, &bytes[at + 5], 8);
            entry.name = bytes.substr(at + 13, length);
            entry.numbers = bytes.substr(at + 13 + length, entry.count * size_of(entry.kind));
            at += 13 + length + entry.numbers.size();
            entries.push_back(std::move(entry));
        }
    }

    /// Writes it with the checksum that it has now.
    void write(const std::filesystem::path& file) const
    {
        std::string bytes = mark;
        for (const Entry& entry : entries) {
            const auto length = static_cast<std::uint32_t>(entry.name.size());
            bytes += static_cast<char>(entry.kind);
            bytes.append(reinterpret_cast<const char*>(&length), 4);
            bytes.append(reinterpret_cast<const char*>(&entry.count), 8);
            bytes += entry.name + entry.numbers;
        }
        write_with_checksum(file, std::move(bytes));
    }
};

} // namespace periporo::test
