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

} // namespace

struct ArchiveWriter::Implementation {
    path target;
    path part;
    H5::H5File file;
    bool committed = false;

    void write(const std::string& name, const H5::DataType& type, const H5::DataSpace& space, const void* data)
    {
        guarded(fmt::format("cannot write \"{}\" to", name), part, [&] {
            H5::LinkCreatPropList links;
            links.setCreateIntermediateGroup(true);
            H5::DataSet dataset = file.createDataSet(name, type, space, H5::DSetCreatPropList::DEFAULT,
                                                     H5::DSetAccPropList::DEFAULT, links);
            if (data != nullptr)
                dataset.write(data, type);
            dataset.close(); // here and not in its destructor, which could not report a full disk
        });
    }

    template <class Value>
    void put(const std::string& name, std::span<const Value> values)
    {
        const hsize_t size = values.size();
        write(name, stored_type<Value>(), H5::DataSpace(1, &size), values.empty() ? nullptr : values.data());
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
        implementation_->write(name, type, H5::DataSpace(H5S_NULL), nullptr);
    else
        implementation_->write(name, type, H5::DataSpace(H5S_SCALAR), text.data());
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

    template <class Value>
    std::vector<Value> get(const std::string& name, H5T_class_t expected, const char* what) const
    {
        const H5::DataSet dataset = open(name, expected, what);
        return guarded(fmt::format("cannot read \"{}\" from", name), source, [&] {
            if (dataset.getDataType().getSize() != sizeof(Value))
                throw std::runtime_error(fmt::format("\"{}\" in {} is not {}", name, source.string(), what));
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
