// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Archives: named values in one file with a checksum. A checkpoint is one.
//
// Whoever has state lists its members once, with their names, and both a writer and a reader visit the list:
//
//     struct Ledger {
//         double kinetic = 0.0;
//         std::vector<double> work; // of each point, or empty
//
//         template <class Self, class Visit>
//         static void members(Self& self, Visit& visit, std::size_t points)
//         {
//             visit("kinetic", self.kinetic);
//             visit("work", empty_or(self.work, points));
//         }
//     };
//     writer.part("ledger", ledger, points); // and reader.part("ledger", ledger, points)
//
// Nothing in a file is believed: the checksum is verified before anything is read, a list keeps its length unless its
// owner says which others are sound, and reals are finite unless the owner says otherwise.
#pragma once

#include "periporo/tensor.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <ranges>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace periporo {

/// A file that is no archive, is damaged, or holds what its reader cannot use. The message names the file.
class ArchiveError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A list whose length may change when it is read: from `least` to `most` values, or none if it may be empty.
template <class List>
struct Resizable {
    List& list;
    std::size_t least;
    std::size_t most;
    bool may_be_empty;
};
template <class List>
Resizable<List> exactly(List& list, std::size_t size)
{
    return {list, size, size, size == 0};
}
template <class List>
Resizable<List> empty_or(List& list, std::size_t size)
{
    return {list, size, size, true};
}
template <class List>
Resizable<List> at_most(List& list, std::size_t most)
{
    return {list, 0, most, true};
}

/// Reals among which infinite ones, and what is not a number, are sound.
template <class Value>
struct AnyReals {
    Value value;
};
template <class Value>
AnyReals<Value&> any_reals(Value& value)
{
    return {value};
}
template <class List>
AnyReals<Resizable<List>> any_reals(Resizable<List> value)
{
    return {value};
}

/// How many reals a type consists of that has nothing else; 0 for other types.
template <class Type>
inline constexpr std::size_t reals_of = 0;
template <>
inline constexpr std::size_t reals_of<double> = 1;
template <>
inline constexpr std::size_t reals_of<Vector3> = 3;

/// What the numbers of an entry are. The values are those of the file.
enum class StoredKind : std::uint8_t { real = 1, signed_integer = 2, number = 3, short_number = 4, byte = 5, text = 6 };

/// Bytes of one number of a kind; 0 for a kind that does not exist.
constexpr std::size_t size_of(StoredKind kind)
{
    switch (kind) {
    case StoredKind::real:
    case StoredKind::signed_integer:
    case StoredKind::number:
        return 8;
    case StoredKind::short_number:
        return 4;
    case StoredKind::byte:
    case StoredKind::text:
        return 1;
    }
    return 0;
}

/// The kind that a value is stored as.
template <class Value>
constexpr StoredKind kind_of()
{
    if constexpr (reals_of < Value >> 0)
        return StoredKind::real;
    else if constexpr (std::same_as<Value, std::int64_t>)
        return StoredKind::signed_integer;
    else if constexpr (std::same_as<Value, std::uint64_t>)
        return StoredKind::number;
    else if constexpr (std::same_as<Value, std::uint32_t>)
        return StoredKind::short_number;
    else if constexpr (std::same_as<Value, char>)
        return StoredKind::text;
    else {
        static_assert(std::same_as<Value, std::uint8_t> || std::same_as<Value, bool>, "no kind for this type");
        return StoredKind::byte;
    }
}

/// Does a type have elements that are stored one by one?
template <class Value>
inline constexpr bool is_list = reals_of<Value> == 0 && std::ranges::contiguous_range<Value>;

/// How many numbers a value is stored as.
template <class Value>
inline constexpr std::size_t numbers_in = reals_of<Value> > 0 ? reals_of<Value> : 1;

/// Collects values in `<path>.part`; nothing is seen under `path` before commit().
/// Every call throws FileError with the path and the reason when the file system fails, ArchiveError when a name is
/// taken.
class ArchiveWriter {
public:
    explicit ArchiveWriter(std::filesystem::path path);
    ~ArchiveWriter(); ///< an archive that was not committed is removed
    ArchiveWriter(const ArchiveWriter&) = delete;
    ArchiveWriter& operator=(const ArchiveWriter&) = delete;

    template <class Value>
    void operator()(const std::string& name, const Value& value)
    {
        if constexpr (is_list<Value>) {
            using Element = std::ranges::range_value_t<Value>;
            static_assert(sizeof(Element) == numbers_in<Element> * size_of(kind_of<Element>()));
            put(name, kind_of<Element>(), std::ranges::data(value), std::ranges::size(value) * numbers_in<Element>);
        } else {
            put(name, kind_of<Value>(), &value, numbers_in<Value>);
        }
    }
    template <class List>
    void operator()(const std::string& name, const Resizable<List>& list)
    {
        (*this)(name, std::as_const(list.list));
    }
    template <class Value>
    void operator()(const std::string& name, const AnyReals<Value>& reals)
    {
        (*this)(name, reals.value);
    }
    /// The members of a part, under its name.
    template <class Part, class... Known>
    void part(const std::string& name, const Part& part, const Known&... known)
    {
        const std::string before = std::exchange(group_, group_ + name + '/');
        Part::members(part, *this, known...);
        group_ = before;
    }

    /// Ends the archive, brings it to the disk and renames it to `path`.
    /// @param previous new name of the archive that `path` was until now; empty: it is replaced. A kill between the two
    /// renames leaves `previous` alone.
    void commit(const std::filesystem::path& previous = {});
    /// Has `path` been given to this archive? Also after a commit() that threw later.
    bool is_in_place() const;

private:
    void complete();
    void put(const std::string& name, StoredKind kind, const void* numbers, std::size_t count);

    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
    std::string group_; ///< that names are in
};

/// Reads what an ArchiveWriter wrote, bit by bit. Everything that does not fit throws ArchiveError.
class ArchiveReader {
public:
    /// @throws ArchiveError when the file cannot be read, is no archive, or its checksum is wrong.
    explicit ArchiveReader(std::filesystem::path path);
    ~ArchiveReader();
    ArchiveReader(ArchiveReader&&) noexcept;
    ArchiveReader& operator=(ArchiveReader&&) noexcept;

    const std::filesystem::path& file() const;
    bool has(const std::string& name) const;

    /// A value, or a list of the length that it has.
    template <class Value>
    void operator()(const std::string& name, Value& value)
    {
        if constexpr (is_list<Value>)
            (*this)(name, exactly(value, std::ranges::size(value)));
        else if constexpr (std::same_as<Value, bool>) {
            std::uint8_t byte = 0;
            take(name, StoredKind::byte, &byte, 1);
            value = byte != 0;
        } else
            take(name, kind_of<Value>(), &value, numbers_in<Value>);
    }
    template <class List>
    void operator()(const std::string& name, Resizable<List> list)
    {
        using Element = std::ranges::range_value_t<List>;
        static_assert(sizeof(Element) == numbers_in<Element> * size_of(kind_of<Element>()));
        const std::size_t length = length_of(name, kind_of<Element>(), numbers_in<Element>);
        if ((length != 0 || !list.may_be_empty) && (length < list.least || length > list.most))
            refuse_length(name, length, list.least, list.most);
        if (list.list.size() != length)
            list.list.resize(length);
        take(name, kind_of<Element>(), list.list.data(), length * numbers_in<Element>);
    }
    template <class Value>
    void operator()(const std::string& name, AnyReals<Value> reals)
    {
        const bool before = std::exchange(any_reals_, true);
        (*this)(name, reals.value);
        any_reals_ = before;
    }
    template <class Part, class... Known>
    void part(const std::string& name, Part& part, const Known&... known)
    {
        const std::string before = std::exchange(group_, group_ + name + '/');
        Part::members(part, *this, known...);
        group_ = before;
    }

private:
    /// Number of elements of an entry.
    std::size_t length_of(const std::string& name, StoredKind kind, std::size_t numbers_per_element) const;
    /// Copies an entry of exactly `count` numbers.
    void take(const std::string& name, StoredKind kind, void* numbers, std::size_t count) const;
    [[noreturn]] void refuse_length(const std::string& name, std::size_t found, std::size_t least,
                                    std::size_t most) const;

    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
    std::string group_;
    bool any_reals_ = false;
};

} // namespace periporo
