// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Archives as HDF5 files: one dataset per name, slashes in names make groups.
#include "io/archive.hpp"

#include <H5Cpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace periporo {

namespace {

using std::filesystem::path;

/// Runs `action` and turns what HDF5 throws, which is no std::exception, into an error with `what` and the file.
template <class Action>
auto guarded(const std::string& what, const path& file, Action&& action)
{
    try {
        H5::Exception::dontPrint();
        return action();
    } catch (const H5::Exception& error) {
        throw std::runtime_error(
            fmt::format("{} {}: HDF5: {} ({})", what, file.string(), error.getDetailMsg(), error.getFuncName()));
    }
}

[[noreturn]] void throw_errno(const std::string& what, const path& file)
{
    throw std::runtime_error(fmt::format("{} {}: {}", what, file.string(), std::strerror(errno)));
}

/// Opens and closes the file as the system does, because HDF5 does not pass on why it could not.
void probe(const std::string& what, const path& file, int flags)
{
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0)
        throw_errno(what, file);
    ::close(descriptor);
}

/// Returns when the contents of the file or the entries of the folder are on the disk.
void synchronize(const path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        throw_errno("cannot flush", file);
    const int status = ::fsync(descriptor);
    const int error = errno;
    ::close(descriptor);
    if (status != 0 && error != EINVAL && error != EROFS) { // some file systems cannot flush a folder
        errno = error;
        throw_errno("cannot flush", file);
    }
}

template <class Value>
const H5::PredType& stored_type();
template <>
const H5::PredType& stored_type<double>()
{
    return H5::PredType::NATIVE_DOUBLE;
}
template <>
const H5::PredType& stored_type<std::int64_t>()
{
    return H5::PredType::NATIVE_INT64;
}
template <>
const H5::PredType& stored_type<std::uint8_t>()
{
    return H5::PredType::NATIVE_UINT8;
}

template <class Parts>
hsize_t length(const Parts& parts)
{
    hsize_t size = 0;
    for (const auto& part : parts)
        size += part.size();
    return size;
}

/// Calls visit(part, its place in the dataset, its place by itself) for all parts that are not empty.
template <class Parts, class Visit>
void for_slices(const H5::DataSet& dataset, const Parts& parts, Visit&& visit)
{
    H5::DataSpace there = dataset.getSpace();
    hsize_t first = 0;
    for (const auto& part : parts) {
        const hsize_t size = part.size();
        if (size == 0)
            continue;
        there.selectHyperslab(H5S_SELECT_SET, &size, &first);
        visit(part, there, H5::DataSpace(1, &size));
        first += size;
    }
}

} // namespace

struct ArchiveWriter::Implementation {
    path target;
    path part;
    H5::H5File file;
    bool committed = false;

    /// Makes a dataset and calls fill(dataset).
    template <class Fill>
    void write(const std::string& name, const H5::DataType& type, const H5::DataSpace& space, Fill&& fill)
    {
        guarded(fmt::format("cannot write \"{}\" to", name), part, [&] {
            H5::LinkCreatPropList links;
            links.setCreateIntermediateGroup(true);
            H5::DataSet dataset = file.createDataSet(name, type, space, H5::DSetCreatPropList::DEFAULT,
                                                     H5::DSetAccPropList::DEFAULT, links);
            fill(dataset);
            dataset.close(); // here and not in its destructor, which could not report a full disk
        });
    }

    template <class Value>
    void put_parts(const std::string& name, std::span<const std::span<const Value>> parts)
    {
        const hsize_t size = length(parts);
        const H5::PredType& type = stored_type<Value>();
        write(name, type, H5::DataSpace(1, &size), [&](H5::DataSet& dataset) {
            for_slices(dataset, parts, [&](auto part, const H5::DataSpace& there, const H5::DataSpace& here) {
                dataset.write(part.data(), type, here, there);
            });
        });
    }

    template <class Value>
    void put(const std::string& name, std::span<const Value> values)
    {
        put_parts<Value>(name, {&values, 1});
    }
};

ArchiveWriter::ArchiveWriter(path target) : implementation_(std::make_unique<Implementation>())
{
    implementation_->part = target;
    implementation_->part += ".part";
    implementation_->target = std::move(target);
    const path& part = implementation_->part;
    probe("cannot write", part, O_WRONLY | O_CREAT);
    guarded("cannot write", part, [&] { implementation_->file = H5::H5File(part.string(), H5F_ACC_TRUNC); });
}

ArchiveWriter::~ArchiveWriter()
{
    if (implementation_->committed)
        return;
    try {
        implementation_->file.close();
    } catch (const H5::Exception&) { // it is thrown away in any case
    }
    std::error_code ignored;
    std::filesystem::remove(implementation_->part, ignored);
}

void ArchiveWriter::put(const std::string& name, std::span<const double> values)
{
    implementation_->put(name, values);
}

void ArchiveWriter::put(const std::string& name, std::span<const std::int64_t> values)
{
    implementation_->put(name, values);
}

void ArchiveWriter::put(const std::string& name, std::span<const std::uint8_t> values)
{
    implementation_->put(name, values);
}

void ArchiveWriter::put(const std::string& name, const std::string& text)
{
    // A fixed-length string keeps every character, a null one too; it cannot be empty, an empty dataspace can.
    H5::StrType type(H5::PredType::C_S1, text.empty() ? 1 : text.size());
    type.setStrpad(H5T_STR_NULLPAD);
    type.setCset(H5T_CSET_UTF8);
    if (text.empty())
        implementation_->write(name, type, H5::DataSpace(H5S_NULL), [](H5::DataSet&) {});
    else
        implementation_->write(name, type, H5::DataSpace(H5S_SCALAR),
                               [&](H5::DataSet& dataset) { dataset.write(text.data(), type); });
}

void ArchiveWriter::put_parts(const std::string& name, std::span<const std::span<const double>> parts)
{
    implementation_->put_parts(name, parts);
}

void ArchiveWriter::commit()
{
    const path& part = implementation_->part;
    const path& target = implementation_->target;
    guarded("cannot write", part, [&] { implementation_->file.close(); });
    synchronize(part);
    std::error_code error;
    std::filesystem::rename(part, target, error);
    if (error)
        throw std::runtime_error(
            fmt::format("cannot rename {} to {}: {}", part.string(), target.string(), error.message()));
    implementation_->committed = true;
    const path folder = target.parent_path();
    synchronize(folder.empty() ? path(".") : folder);
}

struct ArchiveReader::Implementation {
    path source;
    H5::H5File file;

    bool has(const std::string& name) const
    {
        // HDF5 answers for the last member of a path only when those before it exist.
        return guarded("cannot read", source, [&] {
            std::size_t end = 0;
            do {
                end = name.find('/', end + 1);
                if (!file.nameExists(name.substr(0, end)))
                    return false;
            } while (end != std::string::npos);
            return file.childObjType(name) == H5O_TYPE_DATASET;
        });
    }

    H5::DataSet open(const std::string& name, H5T_class_t expected, const char* what) const
    {
        if (name.empty() || !has(name))
            throw std::runtime_error(fmt::format("{} holds no \"{}\"", source.string(), name));
        H5::DataSet dataset = guarded("cannot read", source, [&] { return file.openDataSet(name); });
        if (dataset.getTypeClass() != expected)
            throw std::runtime_error(fmt::format("\"{}\" in {} is not {}", name, source.string(), what));
        return dataset;
    }

    /// The dataset of an array of `value_size` bytes a value.
    H5::DataSet open_array(const std::string& name, H5T_class_t expected, std::size_t value_size,
                           const char* what) const
    {
        H5::DataSet dataset = open(name, expected, what);
        const std::size_t size = guarded("cannot read", source, [&] { return dataset.getDataType().getSize(); });
        if (size != value_size)
            throw std::runtime_error(fmt::format("\"{}\" in {} is not {}", name, source.string(), what));
        return dataset;
    }

    template <class Value>
    std::vector<Value> get(const std::string& name, H5T_class_t expected, const char* what) const
    {
        const H5::DataSet dataset = open_array(name, expected, sizeof(Value), what);
        return guarded(fmt::format("cannot read \"{}\" from", name), source, [&] {
            std::vector<Value> values(static_cast<std::size_t>(dataset.getSpace().getSimpleExtentNpoints()));
            if (!values.empty())
                dataset.read(values.data(), stored_type<Value>());
            return values;
        });
    }
};

ArchiveReader::ArchiveReader(path source) : implementation_(std::make_unique<Implementation>())
{
    implementation_->source = std::move(source);
    const path& file = implementation_->source;
    probe("cannot read", file, O_RDONLY);
    guarded("cannot read", file, [&] { implementation_->file = H5::H5File(file.string(), H5F_ACC_RDONLY); });
}

ArchiveReader::~ArchiveReader() = default;

bool ArchiveReader::has(const std::string& name) const
{
    return !name.empty() && implementation_->has(name);
}

std::vector<double> ArchiveReader::reals(const std::string& name) const
{
    return implementation_->get<double>(name, H5T_FLOAT, "an array of reals");
}

std::vector<std::int64_t> ArchiveReader::integers(const std::string& name) const
{
    return implementation_->get<std::int64_t>(name, H5T_INTEGER, "an array of integers");
}

std::vector<std::uint8_t> ArchiveReader::bytes(const std::string& name) const
{
    return implementation_->get<std::uint8_t>(name, H5T_INTEGER, "an array of bytes");
}

void ArchiveReader::read_parts(const std::string& name, std::span<const std::span<double>> parts) const
{
    const H5::DataSet dataset = implementation_->open_array(name, H5T_FLOAT, sizeof(double), "an array of reals");
    const path& source = implementation_->source;
    guarded(fmt::format("cannot read \"{}\" from", name), source, [&] {
        const auto stored = static_cast<hsize_t>(dataset.getSpace().getSimpleExtentNpoints());
        if (stored != length(parts))
            throw std::runtime_error(
                fmt::format("\"{}\" in {} has {} values instead of {}", name, source.string(), stored, length(parts)));
        for_slices(dataset, parts, [&](auto part, const H5::DataSpace& there, const H5::DataSpace& here) {
            dataset.read(part.data(), stored_type<double>(), here, there);
        });
    });
}

std::string ArchiveReader::text(const std::string& name) const
{
    const H5::DataSet dataset = implementation_->open(name, H5T_STRING, "a text");
    return guarded(fmt::format("cannot read \"{}\" from", name), implementation_->source, [&] {
        if (dataset.getSpace().getSimpleExtentType() == H5S_NULL)
            return std::string();
        const H5::StrType type = dataset.getStrType();
        std::string text(type.getSize(), '\0');
        dataset.read(text.data(), type);
        return text;
    });
}

} // namespace periporo
