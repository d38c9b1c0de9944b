// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The file of an archive: a mark, entries, and the CRC-32 of all bytes before it.
//
// An entry is its kind (1 byte), the length of its name (4), its count of numbers (8), the name and the numbers, as the
// machine has them. The mark tells the order of bytes.
#include "io/archive.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <span>
#include <system_error>

namespace periporo {

namespace {

using std::filesystem::path;
using Checksum = boost::crc_32_type;

constexpr char mark[] = "periporo archive 1\n";
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::size_t mark_size = sizeof(mark) - 1 + sizeof(byte_order);
constexpr std::size_t checksum_size = 4;
constexpr std::size_t largest_name = 1024;
constexpr std::size_t buffer_size = std::size_t{1} << 20;

[[noreturn]] void throw_errno(const std::string& what, const path& file, int error = errno)
{
    throw ArchiveError(fmt::format("cannot {} {}: {}", what, file.string(), std::strerror(error)));
}

/// A file of the system that is closed at the end.
class Descriptor {
public:
    Descriptor(const path& file, int flags) : number_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~Descriptor()
    {
        if (number_ >= 0)
            ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }
    /// @return 0, or errno
    int close() { return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

private:
    int number_;
};

/// Returns when the contents of a file or the entries of a folder are on the disk.
void synchronize(int descriptor, const path& file)
{
    if (::fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS) // some file systems cannot flush a folder
        throw_errno("write", file);
}

template <class Number>
bool all_finite(const void* numbers, std::size_t count)
{
    const auto* first = static_cast<const Number*>(numbers);
    return std::all_of(first, first + count, [](Number number) { return std::isfinite(number); });
}

/// Returns when the entries of the folder of a file are on the disk.
void synchronize_folder_of(const path& file)
{
    const path folder = file.has_parent_path() ? file.parent_path() : path(".");
    const Descriptor descriptor(folder, O_RDONLY);
    if (descriptor.number() < 0)
        throw_errno("write", folder);
    synchronize(descriptor.number(), folder);
}

void move_to(const path& from, const path& to)
{
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (error)
        throw_errno(fmt::format("rename {} to", from.string()), to, error.value());
}

} // namespace

struct ArchiveWriter::Implementation {
    path target;
    path part;
    Descriptor file;
    std::vector<char> buffer;
    std::set<std::string> names;
    Checksum checksum;
    bool completed = false;
    bool committed = false;

    explicit Implementation(path to)
        : target(std::move(to)), part(target.string() + ".part"), file(part, O_WRONLY | O_CREAT | O_TRUNC)
    {
        if (file.number() < 0)
            throw_errno("write", part);
        buffer.reserve(buffer_size);
    }

    void write_out(const char* bytes, std::size_t size)
    {
        checksum.process_bytes(bytes, size);
        while (size > 0) {
            const ssize_t written = ::write(file.number(), bytes, size);
            if (written < 0 && errno == EINTR)
                continue;
            if (written <= 0)
                throw_errno("write", part, written < 0 ? errno : ENOSPC);
            bytes += written;
            size -= static_cast<std::size_t>(written);
        }
    }

    void flush()
    {
        write_out(buffer.data(), buffer.size());
        buffer.clear();
    }

    void append(const void* data, std::size_t size)
    {
        const char* bytes = static_cast<const char*>(data);
        if (buffer.size() + size > buffer_size)
            flush();
        if (size > buffer_size)
            write_out(bytes, size);
        else
            buffer.insert(buffer.end(), bytes, bytes + size);
    }
};

ArchiveWriter::ArchiveWriter(path target) : implementation_(std::make_unique<Implementation>(std::move(target)))
{
    implementation_->append(mark, sizeof(mark) - 1);
    implementation_->append(&byte_order, sizeof(byte_order));
}

ArchiveWriter::~ArchiveWriter()
{
    if (implementation_->committed)
        return;
    std::error_code ignored;
    std::filesystem::remove(implementation_->part, ignored);
}

void ArchiveWriter::put(const std::string& name, StoredKind kind, const void* numbers, std::size_t count)
{
    const std::string full = group_ + name;
    if (full.empty() || full.size() > largest_name || !implementation_->names.insert(full).second)
        throw ArchiveError(fmt::format("cannot write \"{}\" to {}: an entry has a name of its own", full,
                                       implementation_->part.string()));
    const auto length = static_cast<std::uint32_t>(full.size());
    const auto stored = static_cast<std::uint64_t>(count);
    implementation_->append(&kind, sizeof(kind));
    implementation_->append(&length, sizeof(length));
    implementation_->append(&stored, sizeof(stored));
    implementation_->append(full.data(), full.size());
    if (count > 0)
        implementation_->append(numbers, count * size_of(kind));
}

void ArchiveWriter::complete()
{
    Implementation& archive = *implementation_;
    if (std::exchange(archive.completed, true))
        return;
    archive.flush();
    const std::uint32_t checksum = archive.checksum.checksum();
    archive.append(&checksum, sizeof(checksum));
    archive.flush();
    synchronize(archive.file.number(), archive.part);
    if (const int error = archive.file.close(); error != 0)
        throw_errno("write", archive.part, error);
}

void ArchiveWriter::commit(const path& previous)
{
    complete();
    Implementation& archive = *implementation_;
    if (!previous.empty() && std::filesystem::exists(archive.target))
        move_to(archive.target, previous);
    move_to(archive.part, archive.target);
    archive.committed = true;
    synchronize_folder_of(archive.target);
}

struct ArchiveReader::Implementation {
    struct Entry {
        StoredKind kind;
        std::uint64_t count;
        std::uint64_t offset;
    };

    path source;
    Descriptor file;
    std::uint64_t end = 0; ///< of the entries
    std::map<std::string, Entry> entries;

    explicit Implementation(path from) : source(std::move(from)), file(source, O_RDONLY | O_NONBLOCK)
    {
        if (file.number() < 0)
            throw_errno("read", source);
        struct stat status = {};
        if (::fstat(file.number(), &status) != 0)
            throw_errno("read", source);
        if (!S_ISREG(status.st_mode))
            throw ArchiveError(fmt::format("{} is no file", source.string()));
        const auto size = static_cast<std::uint64_t>(status.st_size);
        if (size < mark_size + checksum_size)
            refuse("it ends too early");
        end = size - checksum_size;
        verify();
        find_entries();
    }

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw ArchiveError(fmt::format("{} is damaged: {}", source.string(), why));
    }

    void read(void* data, std::size_t size, std::uint64_t offset) const
    {
        char* bytes = static_cast<char*>(data);
        while (size > 0) {
            const ssize_t got = ::pread(file.number(), bytes, size, static_cast<off_t>(offset));
            if (got < 0 && errno == EINTR)
                continue;
            if (got < 0)
                throw_errno("read", source);
            if (got == 0)
                refuse("it ends too early");
            bytes += got;
            size -= static_cast<std::size_t>(got);
            offset += static_cast<std::uint64_t>(got);
        }
    }

    void verify() const
    {
        Checksum checksum;
        std::vector<char> buffer(std::min<std::uint64_t>(buffer_size, end));
        for (std::uint64_t at = 0; at < end; at += buffer.size()) {
            buffer.resize(std::min<std::uint64_t>(buffer.size(), end - at));
            read(buffer.data(), buffer.size(), at);
            if (at == 0 && std::memcmp(buffer.data(), mark, sizeof(mark) - 1) != 0)
                refuse("it does not begin as an archive of this program does");
            checksum.process_bytes(buffer.data(), buffer.size());
        }
        std::uint32_t stored = 0, order = 0;
        read(&stored, sizeof(stored), end);
        read(&order, sizeof(order), sizeof(mark) - 1);
        if (checksum.checksum() != stored)
            refuse("its checksum does not agree with its content");
        if (order != byte_order)
            throw ArchiveError(fmt::format("{} was written by a machine of another kind", source.string()));
    }

    void find_entries()
    {
        for (std::uint64_t at = mark_size; at < end;) {
            Entry entry = {};
            std::uint32_t length = 0;
            constexpr std::size_t head = sizeof(entry.kind) + sizeof(length) + sizeof(entry.count);
            if (end - at < head)
                refuse("its last entry is not whole");
            read(&entry.kind, sizeof(entry.kind), at);
            read(&length, sizeof(length), at + sizeof(entry.kind));
            read(&entry.count, sizeof(entry.count), at + sizeof(entry.kind) + sizeof(length));
            const std::size_t size = size_of(entry.kind);
            if (size == 0 || length == 0 || length > largest_name || length > end - at - head)
                refuse("an entry has no kind or no name");
            std::string name(length, '\0');
            read(name.data(), length, at + head);
            entry.offset = at + head + length;
            if (entry.count > (end - entry.offset) / size)
                refuse(fmt::format("\"{}\" is longer than the file", name));
            at = entry.offset + entry.count * size;
            if (!entries.emplace(name, entry).second)
                refuse(fmt::format("it holds \"{}\" twice", name));
        }
    }

    const Entry& find(const std::string& name, StoredKind kind) const
    {
        const auto found = entries.find(name);
        if (found == entries.end())
            throw ArchiveError(fmt::format("{} holds no \"{}\"", source.string(), name));
        if (found->second.kind != kind)
            throw ArchiveError(fmt::format("\"{}\" in {} is of another kind", name, source.string()));
        return found->second;
    }
};

ArchiveReader::ArchiveReader(std::filesystem::path source)
    : implementation_(std::make_unique<Implementation>(std::move(source)))
{
}

ArchiveReader::~ArchiveReader() = default;
ArchiveReader::ArchiveReader(ArchiveReader&&) noexcept = default;
ArchiveReader& ArchiveReader::operator=(ArchiveReader&&) noexcept = default;

const path& ArchiveReader::file() const
{
    return implementation_->source;
}

bool ArchiveReader::has(const std::string& name) const
{
    return implementation_->entries.contains(group_ + name);
}

std::size_t ArchiveReader::length_of(const std::string& name, StoredKind kind, std::size_t numbers_per_element) const
{
    const std::uint64_t count = implementation_->find(group_ + name, kind).count;
    if (count % numbers_per_element != 0)
        throw ArchiveError(fmt::format("\"{}{}\" in {} has {} numbers, which are no list of {} each", group_, name,
                                       file().string(), count, numbers_per_element));
    return count / numbers_per_element;
}

void ArchiveReader::take(const std::string& name, StoredKind kind, void* numbers, std::size_t count) const
{
    const Implementation::Entry& entry = implementation_->find(group_ + name, kind);
    if (entry.count != count)
        refuse_length(name, entry.count, count, count);
    if (count == 0)
        return;
    implementation_->read(numbers, count * size_of(kind), entry.offset);
    if (kind == StoredKind::real && !any_reals_ && !all_finite<double>(numbers, count))
        throw ArchiveError(fmt::format("\"{}{}\" in {} has values that are not finite", group_, name, file().string()));
}

void ArchiveReader::refuse_length(const std::string& name, std::size_t found, std::size_t least, std::size_t most) const
{
    throw ArchiveError(fmt::format("\"{}{}\" in {} has {} values instead of {}", group_, name, file().string(), found,
                                   least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most)));
}

} // namespace periporo
