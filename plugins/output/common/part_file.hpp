// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are complete or absent: written as `<name>.part`, brought to the disk, then renamed.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace periporo::output {

/// Where a file is written while it is not complete.
inline std::filesystem::path part_of(std::filesystem::path file)
{
    return file += ".part";
}

[[noreturn]] inline void throw_file_error(const std::string& what, const std::filesystem::path& file, int error)
{
    throw std::runtime_error(what + " " + file.string() + ": " + std::strerror(error));
}

/// @throws std::runtime_error with path and reason when the file cannot be written. Makes an empty file where none is.
inline void require_writable(const std::filesystem::path& file)
{
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
        throw_file_error("cannot write", file, errno);
    ::close(descriptor);
}

/// Returns when the contents of a file, or the entries of a folder, are on the disk.
inline void synchronize(const std::filesystem::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        throw_file_error("cannot flush", file, errno);
    const int status = ::fsync(descriptor);
    const int error = errno;
    ::close(descriptor);
    if (status != 0 && error != EINVAL && error != EROFS) // some file systems cannot flush a folder
        throw_file_error("cannot flush", file, error);
}

/// Brings the part to the disk and gives it its name.
inline void publish(const std::filesystem::path& part, const std::filesystem::path& file)
{
    synchronize(part);
    std::filesystem::rename(part, file);
    synchronize(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
}

/// The output of the run that is resumed: the part of a run that was killed, which is the later one when both exist, or
/// the file of a run that was stopped in order.
/// @throws std::runtime_error when there is neither.
inline std::filesystem::path earlier_output(const std::filesystem::path& file)
{
    for (const std::filesystem::path& candidate : {part_of(file), file})
        if (std::filesystem::exists(candidate))
            return candidate;
    throw std::runtime_error("cannot resume: there is neither " + file.string() + " nor " + part_of(file).string());
}

} // namespace periporo::output
