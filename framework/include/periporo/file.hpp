// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are complete or absent, and errors that say why: what program and writers use to store something.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace periporo {

/// The system refused something about a file. The message has the deed, the path, the system's reason and a way out:
/// "cannot write out/history.csv: No space left on device; make room there".
class FileError : public std::runtime_error {
public:
    /// @param deed "cannot write"
    /// @param error of errno
    FileError(std::string_view deed, const std::filesystem::path& file, int error);
    int error() const { return error_; }

private:
    int error_;
};

/// Where a file is written while it is not complete: `<file>.part`.
std::filesystem::path part_of(std::filesystem::path file);

/// Returns when the content of a file, or the entries of a folder, are on the disk. @throws FileError
void synchronize(const std::filesystem::path& file);

/// Gives `from` the name `to`, whatever had it before, and brings the folder to the disk. @throws FileError
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Brings a part to the disk and gives it the name of the file, so that the file is complete or absent at every moment.
/// A reader that has the earlier file open keeps it. @throws FileError
void publish(const std::filesystem::path& part, const std::filesystem::path& file);

/// Writes a small file aside and publishes it. After an error the earlier file stands and no part is left.
/// @throws FileError
void write_whole(const std::filesystem::path& file, std::string_view content);

/// Throws an error that names a folder, a pipe, a device or a socket where a regular file belongs: opening some of them
/// waits for ever, and others lose what is written. A file that is not there is no error. @throws std::runtime_error
void require_regular(const std::filesystem::path& file);

/// The content of a regular file; a symbolic link is not followed. @throws FileError, or as require_regular()
std::string read_whole(const std::filesystem::path& file);

/// Names of all there is in a folder, sorted. @throws FileError when the folder cannot be read, or is none
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Bytes of a file. @throws FileError
std::uint64_t size_of_file(const std::filesystem::path& file);

/// Deletes a file, or a symbolic link and not what it points to; a file that is not there is no error.
/// @throws FileError
void remove_file(const std::filesystem::path& file);

/// `<file>.damaged`, or `<file>.damaged.2` and so on where that name is taken.
std::filesystem::path name_when_damaged(const std::filesystem::path& file);

/// Renames a damaged file, since it may still be of use to somebody, and returns its new name. @throws FileError
std::filesystem::path set_aside(const std::filesystem::path& file);

/// CRC-32 (the one of zlib) of bytes that follow those that gave `before`.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// A file that only grows at its end. Every call hands its bytes to the system at once, so that they survive the end of
/// the program by any cause, and throws FileError with the system's reason. A symbolic link is not followed.
class AppendedFile {
public:
    AppendedFile() = default;
    /// Opens a file that exists.
    explicit AppendedFile(std::filesystem::path file);
    ~AppendedFile();
    AppendedFile(AppendedFile&& other) noexcept;
    AppendedFile& operator=(AppendedFile&& other) noexcept;

    void append(std::string_view bytes);
    /// Cuts the file after so many bytes.
    void cut(std::uint64_t length);
    /// Returns when all bytes are on the disk. A file that somebody has deleted or replaced meanwhile is an error.
    void synchronize();
    bool is_open() const { return descriptor_ >= 0; }

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

} // namespace periporo
