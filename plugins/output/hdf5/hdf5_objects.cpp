// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Texts, numbers, arrays and links in HDF5.
#include "hdf5_objects.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <string_view>

namespace periporo::output {

namespace {

/// Rows of a chunk: large enough to compress well, small enough to read a part of a large snapshot.
constexpr hsize_t array_chunk = 16384;

H5::StrType text_type()
{
    H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
    type.setCset(H5T_CSET_UTF8);
    return type;
}

template <class Value>
void write_number(const H5::H5Object& object, const std::string& name, const H5::PredType& type, const Value& value)
{
    object.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, &value);
}

template <class Value>
Value read_number(const H5::H5Object& object, const std::string& name, const H5::PredType& type)
{
    Value value{};
    object.openAttribute(name).read(type, &value);
    return value;
}

template <class Value>
void write_values(const H5::Group& group, const std::string& name, const H5::PredType& type,
                  std::span<const Value> values, std::size_t components, const std::string& unit,
                  const std::string& description, int compression)
{
    const std::array<hsize_t, 2> extent{values.size() / components, components};
    const int rank = components == 1 ? 1 : 2;
    H5::DSetCreatPropList properties;
    if (compression > 0 && !values.empty()) {
        const std::array<hsize_t, 2> chunk{std::min(extent[0], array_chunk), components};
        properties.setChunk(rank, chunk.data());
        properties.setShuffle();
        properties.setDeflate(static_cast<unsigned>(compression));
    }
    H5::DataSet dataset = group.createDataSet(name, type, H5::DataSpace(rank, extent.data()), properties);
    if (!values.empty())
        dataset.write(values.data(), type);
    write_attribute(dataset, "unit", unit);
    write_attribute(dataset, "description", description);
    dataset.close(); // here and not in its destructor, which could not report a full disk
}

herr_t look_for_memory(unsigned, const H5E_error2_t* error, void* found)
{
    // Filters of HDF5 have no class of errors for it, but the word.
    const std::string_view words = error->desc != nullptr ? error->desc : "";
    if (error->maj_num == H5E_RESOURCE || words.find("memory") != std::string_view::npos)
        *static_cast<bool*>(found) = true;
    return 0;
}

} // namespace

Hdf5Errors::Hdf5Errors()
{
    H5Eset_auto2(
        H5E_DEFAULT,
        [](hid_t stack, void* found) { return H5Ewalk2(stack, H5E_WALK_DOWNWARD, look_for_memory, found); },
        &out_of_memory_);
}

Hdf5Errors::~Hdf5Errors()
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

H5::H5File open_unlocked(const std::filesystem::path& file)
{
    errno = 0;
    if (!std::ifstream(file)) // HDF5 does not pass on why it cannot open a file
        throw FileError("cannot read", file, errno);
    H5::FileAccPropList access;
    H5Pset_file_locking(access.getId(), false, true);
    return {file.string(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access};
}

void write_attribute(const H5::H5Object& object, const std::string& name, const std::string& text)
{
    object.createAttribute(name, text_type(), H5::DataSpace(H5S_SCALAR)).write(text_type(), text);
}

void write_attribute(const H5::H5Object& object, const std::string& name, std::int64_t value)
{
    write_number(object, name, H5::PredType::NATIVE_INT64, value);
}

void write_attribute(const H5::H5Object& object, const std::string& name, double value)
{
    write_number(object, name, H5::PredType::NATIVE_DOUBLE, value);
}

double read_real_attribute(const H5::H5Object& object, const std::string& name)
{
    return read_number<double>(object, name, H5::PredType::NATIVE_DOUBLE);
}

std::int64_t read_whole_attribute(const H5::H5Object& object, const std::string& name)
{
    return read_number<std::int64_t>(object, name, H5::PredType::NATIVE_INT64);
}

void write_text(const H5::Group& group, const std::string& name, const std::string& text)
{
    group.createDataSet(name, text_type(), H5::DataSpace(H5S_SCALAR)).write(text, text_type());
}

void write_array(const H5::Group& group, const std::string& name, std::span<const double> values,
                 std::size_t components, const std::string& unit, const std::string& description, int compression)
{
    write_values(group, name, H5::PredType::NATIVE_DOUBLE, values, components, unit, description, compression);
}

void write_array(const H5::Group& group, const std::string& name, std::span<const std::int64_t> values,
                 std::size_t components, const std::string& unit, const std::string& description, int compression)
{
    write_values(group, name, H5::PredType::NATIVE_INT64, values, components, unit, description, compression);
}

void link_to_file(const H5::Group& group, const std::string& name, const std::string& file, const std::string& object)
{
    if (H5Lcreate_external(file.c_str(), object.c_str(), group.getId(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
        throw H5::GroupIException("link_to_file", "cannot link " + name);
}

void copy_object(const H5::H5File& from, const std::string& object, const H5::Group& to, const std::string& name)
{
    if (H5Ocopy(from.getId(), object.c_str(), to.getId(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
        throw H5::GroupIException("copy_object", "cannot copy " + object);
}

} // namespace periporo::output
