// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the headers of an ELF file and holds what they promise against the size of the file.
#include "periporo/library_file.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

namespace periporo {
namespace {

/// Does a part of a file end within it? Written so that no sum overflows.
bool lies_within(std::uint64_t offset, std::uint64_t length, std::uint64_t size)
{
    return offset <= size && length <= size - offset;
}

std::string truncated(std::uint64_t size)
{
    return fmt::format("the file is cut off: its headers tell of more than its {} bytes; build or copy it again", size);
}

} // namespace

std::string library_objection(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return "it is no regular file";
    const std::uint64_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream)
        return "it cannot be read";
    Elf64_Ehdr header;
    if (!stream.read(reinterpret_cast<char*>(&header), sizeof header) ||
        std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
        return "it is no shared library (ELF)";
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_type != ET_DYN || header.e_phentsize != sizeof(Elf64_Phdr))
        return "it is no shared library of 64 bits";
    if (!lies_within(header.e_phoff, std::uint64_t{header.e_phnum} * sizeof(Elf64_Phdr), size) ||
        !lies_within(header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize, size))
        return truncated(size);
    std::vector<Elf64_Phdr> segments(header.e_phnum);
    stream.seekg(static_cast<std::streamoff>(header.e_phoff));
    if (!stream.read(reinterpret_cast<char*>(segments.data()),
                     static_cast<std::streamsize>(segments.size() * sizeof(Elf64_Phdr))))
        return "it cannot be read";
    for (const Elf64_Phdr& segment : segments)
        if (!lies_within(segment.p_offset, segment.p_filesz, size))
            return truncated(size);
    return {};
}

} // namespace periporo
