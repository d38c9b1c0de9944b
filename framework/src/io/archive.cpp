// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The file of an archive: a mark, entries, and the CRC-32 of all bytes before it.
//
// An entry is its kind (1 byte), the length of its name (4), its count of numbers (8), the name and the numbers, as the
// machine has them. The mark tells the order of bytes.
#include "io/archive.hpp"

#include "periporo/file.hpp"

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

constexpr char mark[] = "periporo archive 1\n";
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::size_t mark_size = sizeof(mark) - 1 + sizeof(byte_order);
constexpr std::size_t checksum_size = 4;
constexpr std::size_t largest_name = 1024;
constexpr std::size_t buffer_size = std::size_t{1} << 20;

/// A file to be read, closed at the end.
class Descriptor {
public:
    explicit Descriptor(const path& file) : number_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
    ~Descriptor()
    {
        if (number_ >= 0)
            ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }

private:
    int number_;
};

template <class Number>
bool all_finite(const void* numbers, std::size_t count)
{
    const auto* first = static_cast<const Number*>(numbers);
    return std::all_of(first, first + count, [](Number number) { return std::isfinite(number); });
}

} // namespace

struct ArchiveWriter::Implementation {
    path target;
    path part;
    AppendedFile file;
    std::string buffer;
    std::set<std::string> names;
    std::uint32_t checksum = 0;
    bool completed = false;
    bool committed = false;

    explicit Implementation(path to) : target(std::move(to)), part(part_of(target))
    {
        write_whole(part, "");
        file = AppendedFile(part);
        buffer.reserve(buffer_size);
    }

    void write_out(std::string_view bytes)
    {
        checksum = crc32(bytes, checksum);
        file.append(bytes);
    }

    void flush()
    {
        write_out(buffer);
        buffer.clear();
    }

    void append(const void* data, std::size_t size)
    {
        const std::string_view bytes(static_cast<const char*>(data), size);
        if (buffer.size() + size > buffer_size)
            flush();
        if (size > buffer_size)
            write_out(bytes);
        else
            buffer += bytes;
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
    const std::uint32_t checksum = archive.checksum;
    archive.append(&checksum, sizeof(checksum));
    archive.flush();
    archive.file.synchronize();
}

void ArchiveWriter::commit(const path& previous)
{
    complete();
    Implementation& archive = *implementation_;
    if (!previous.empty() && std::filesystem::exists(archive.target))
        rename_file(archive.target, previous);
    try {
        rename_file(archive.part, archive.target);
        archive.committed = true;
    } catch (...) {
        std::error_code ignored;
        archive.committed = !std::filesystem::exists(archive.part, ignored); // but the folder is not on the disk yet
        throw;
    }
}

bool ArchiveWriter::is_in_place() const
{
    return implementation_->committed;
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

    explicit Implementation(path from) : source(std::move(from)), file(source)
    {
        if (file.number() < 0)
            throw ArchiveError(FileError("cannot read", source, errno).what());
        struct stat status = {};
        if (::fstat(file.number(), &status) != 0)
            throw ArchiveError(FileError("cannot read", source, errno).what());
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
                throw ArchiveError(FileError("cannot read", source, errno).what());
            if (got == 0)
                refuse("it ends too early");
            bytes += got;
            size -= static_cast<std::size_t>(got);
            offset += static_cast<std::uint64_t>(got);
        }
    }

    void verify() const
    {
        std::uint32_t checksum = 0;
        std::string buffer(std::min<std::uint64_t>(buffer_size, end), '\0');
        for (std::uint64_t at = 0; at < end; at += buffer.size()) {
            buffer.resize(std::min<std::uint64_t>(buffer.size(), end - at));
            read(buffer.data(), buffer.size(), at);
            if (at == 0 && std::memcmp(buffer.data(), mark, sizeof(mark) - 1) != 0)
                refuse("it does not begin as an archive of this program does");
            checksum = crc32(buffer, checksum);
        }
        std::uint32_t stored = 0, order = 0;
        read(&stored, sizeof(stored), end);
        read(&order, sizeof(order), sizeof(mark) - 1);
        if (checksum != stored)
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
