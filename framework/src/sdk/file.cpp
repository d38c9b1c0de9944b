// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writing aside, renaming and appending with the calls of POSIX, whose reasons reach the user.
#include "periporo/file.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

namespace periporo {
namespace {

using std::filesystem::path;

/// What helps when the system denies access to a file.
const char* way_in(std::string_view deed, const path& file)
{
    if (deed.starts_with("cannot read"))
        return "; make it readable";
    struct stat status;
    if (::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(file.c_str(), W_OK) != 0)
        return ::access(file.c_str(), R_OK) == 0 ? "; make the file writable" : "; make the file readable and writable";
    return "; make the folder writable or choose another one";
}

/// What helps against an error of the system.
const char* way_out(std::string_view deed, const path& file, int error)
{
    if (deed.starts_with("cannot make") && (error == ENOENT || error == ENOTDIR))
        return "; choose another one";
    switch (error) {
    case ENOSPC:
        return "; make room there";
    case EDQUOT:
        return "; make room within the quota";
    case EROFS:
        return "; make the folder writable or choose another one";
    case EACCES:
    case EPERM:
        return way_in(deed, file);
    case ENOENT:
    case ENOTDIR:
    case ESTALE:
        return "; has somebody taken the folder away?";
    case EMFILE:
    case ENFILE:
        return "; allow more open files, as with ulimit -n";
    case ENOMEM:
        return "; allow more memory, as with ulimit -v, or make the case smaller";
    case EFBIG:
        return "; allow larger files, as with ulimit -f";
    case ELOOP:
        return "; symbolic links are not followed here, put a file in place of the link";
    case EIO:
        return "; the disk is at fault";
    default:
        return "";
    }
}

/// Opens a regular file without waiting for the other end of a pipe.
int open_regular(const path& file, int flags, const char* deed)
{
    require_regular(file);
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor < 0)
        throw FileError(deed, file, errno);
    return descriptor;
}

/// Closes a descriptor at the end of its block.
class Descriptor {
public:
    Descriptor(const path& file, int flags, const char* deed) : value_(open_regular(file, flags, deed)) {}
    ~Descriptor()
    {
        if (value_ >= 0)
            ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int operator*() const { return value_; }
    /// Closes it now: some file systems report a full disk only here.
    int close() { return ::close(std::exchange(value_, -1)); }

private:
    int value_;
};

/// 0, or the error.
int write_all(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return errno;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

/// 0, or the error. Some file systems cannot flush a folder, and say so by EINVAL.
int flush_descriptor(int descriptor)
{
    if (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS)
        return 0;
    return errno;
}

/// The bits in the opposite order.
std::uint32_t mirrored(std::uint32_t bits)
{
    std::uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit)
        result |= (bits >> bit & 1u) << (31 - bit);
    return result;
}

path folder_of(const path& file)
{
    return file.has_parent_path() ? file.parent_path() : path(".");
}

} // namespace

FileError::FileError(std::string_view deed, const path& file, int error)
    : std::runtime_error(
          fmt::format("{} {}: {}{}", deed, file.string(), std::strerror(error), way_out(deed, file, error))),
      error_(error)
{
}

path part_of(path file)
{
    return file += ".part";
}

void require_regular(const path& file)
{
    struct stat status;
    if (::lstat(file.c_str(), &status) != 0 || S_ISREG(status.st_mode) || S_ISLNK(status.st_mode))
        return; // whoever opens the file reports what is wrong with it, and follows no link
    const char* kind = S_ISDIR(status.st_mode)    ? "a folder"
                       : S_ISFIFO(status.st_mode) ? "a pipe"
                       : S_ISSOCK(status.st_mode) ? "a socket"
                                                  : "a device";
    throw std::runtime_error(fmt::format("{} is {} and not a regular file; move it away", file.string(), kind));
}

void synchronize(const path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        throw FileError("cannot bring to the disk", file, errno);
    const int error = flush_descriptor(descriptor);
    ::close(descriptor);
    if (error != 0)
        throw FileError("cannot bring to the disk", file, error);
}

void rename_file(const path& from, const path& to)
{
    if (std::rename(from.c_str(), to.c_str()) != 0)
        throw FileError(fmt::format("cannot rename {} to", from.string()), to, errno);
    synchronize(folder_of(to));
}

void publish(const path& part, const path& file)
{
    synchronize(part);
    rename_file(part, file);
}

void write_whole(const path& file, std::string_view content)
{
    const path part = part_of(file);
    Descriptor stream(part, O_WRONLY | O_CREAT | O_TRUNC, "cannot write");
    int error = write_all(*stream, content);
    if (error == 0)
        error = flush_descriptor(*stream);
    if (stream.close() != 0 && error == 0)
        error = errno;
    if (error == 0 && std::rename(part.c_str(), file.c_str()) != 0)
        error = errno;
    if (error != 0) {
        ::unlink(part.c_str()); // as far as possible: the room may be needed
        throw FileError("cannot write", file, error);
    }
    synchronize(folder_of(file));
}

std::string read_whole(const path& file)
{
    const Descriptor stream(file, O_RDONLY, "cannot read");
    std::string content;
    std::array<char, 65536> block;
    for (;;) {
        const ssize_t count = ::read(*stream, block.data(), block.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            throw FileError("cannot read", file, errno);
        if (count == 0)
            return content;
        content.append(block.data(), static_cast<std::size_t>(count));
    }
}

std::vector<std::string> names_in(const path& folder)
{
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        names.push_back(entry->path().filename().string());
    if (error)
        throw FileError("cannot read", folder, error.value());
    std::sort(names.begin(), names.end());
    return names;
}

std::uint64_t size_of_file(const path& file)
{
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (error)
        throw FileError("cannot read", file, error.value());
    return size;
}

void remove_file(const path& file)
{
    if (::unlink(file.c_str()) != 0 && errno != ENOENT)
        throw FileError("cannot delete", file, errno);
}

path name_when_damaged(const path& file)
{
    path name = file.string() + ".damaged";
    struct stat ignored;
    for (int number = 2; ::lstat(name.c_str(), &ignored) == 0; ++number)
        name = fmt::format("{}.damaged.{}", file.string(), number);
    return name;
}

path set_aside(const path& file)
{
    path name = name_when_damaged(file);
    rename_file(file, name);
    return name;
}

std::uint32_t crc32(std::string_view bytes, std::uint32_t before)
{
    boost::crc_32_type sum(mirrored(~before)); // goes on from the remainder that the checksum before stands for
    sum.process_bytes(bytes.data(), bytes.size());
    return sum.checksum();
}

AppendedFile::AppendedFile(path file) : file_(std::move(file))
{
    descriptor_ = open_regular(file_, O_WRONLY | O_APPEND, "cannot write");
}

AppendedFile::~AppendedFile()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

AppendedFile::AppendedFile(AppendedFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1))
{
}

AppendedFile& AppendedFile::operator=(AppendedFile&& other) noexcept
{
    std::swap(file_, other.file_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

void AppendedFile::append(std::string_view bytes)
{
    if (const int error = write_all(descriptor_, bytes); error != 0)
        throw FileError("cannot write", file_, error);
}

void AppendedFile::cut(std::uint64_t length)
{
    if (::ftruncate(descriptor_, static_cast<off_t>(length)) != 0)
        throw FileError("cannot cut", file_, errno);
}

void AppendedFile::synchronize()
{
    struct stat mine, there;
    if (::fstat(descriptor_, &mine) != 0 || ::lstat(file_.c_str(), &there) != 0)
        throw FileError("cannot write", file_, errno);
    if (mine.st_ino != there.st_ino || mine.st_dev != there.st_dev)
        throw FileError("cannot write", file_, ENOENT);
    if (const int error = flush_descriptor(descriptor_); error != 0)
        throw FileError("cannot bring to the disk", file_, error);
}

} // namespace periporo
