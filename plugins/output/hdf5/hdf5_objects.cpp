// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Texts, numbers, arrays and growing columns in HDF5.
#include "hdf5_objects.hpp"

#include <algorithm>
#include <array>

namespace periporo::output {

namespace {

/// Rows of a chunk: large enough to compress well, small enough to read a part of a large snapshot.
constexpr hsize_t array_chunk = 16384;
constexpr hsize_t column_chunk = 1024;

H5::StrType text_type()
{
    H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
    type.setCset(H5T_CSET_UTF8);
    return type;
}

template <class Value>
void write_number(const H5::H5Object& object, const std::string& name, const H5::PredType& type, const Value& value)
{
    if (object.attrExists(name))
        object.openAttribute(name).write(type, &value);
    else
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

template <class Value>
void append_values(const H5::Group& group, const std::string& name, const H5::PredType& type,
                   std::span<const Value> values)
{
    if (values.empty())
        return;
    H5::DataSet dataset = group.openDataSet(name);
    hsize_t start = 0;
    dataset.getSpace().getSimpleExtentDims(&start);
    const hsize_t count = values.size();
    const hsize_t length = start + count;
    dataset.extend(&length);
    H5::DataSpace space = dataset.getSpace();
    space.selectHyperslab(H5S_SELECT_SET, &count, &start);
    dataset.write(values.data(), type, H5::DataSpace(1, &count), space);
    dataset.close();
}

} // namespace

H5::H5File open_unlocked(const std::filesystem::path& file, unsigned flags)
{
    H5::FileAccPropList access;
    H5Pset_file_locking(access.getId(), false, true);
    return H5::H5File(file.string(), flags, H5::FileCreatPropList::DEFAULT, access);
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

std::string read_text_attribute(const H5::H5Object& object, const std::string& name)
{
    std::string text;
    const H5::Attribute attribute = object.openAttribute(name);
    attribute.read(attribute.getStrType(), text);
    return text;
}

std::int64_t read_integer_attribute(const H5::H5Object& object, const std::string& name)
{
    return read_number<std::int64_t>(object, name, H5::PredType::NATIVE_INT64);
}

double read_real_attribute(const H5::H5Object& object, const std::string& name)
{
    return read_number<double>(object, name, H5::PredType::NATIVE_DOUBLE);
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

void create_column(const H5::Group& group, const std::string& name, const H5::PredType& type, const std::string& unit,
                   const std::string& description)
{
    const hsize_t empty = 0;
    const hsize_t unlimited = H5S_UNLIMITED;
    H5::DSetCreatPropList properties;
    properties.setChunk(1, &column_chunk);
    const H5::DataSet dataset = group.createDataSet(name, type, H5::DataSpace(1, &empty, &unlimited), properties);
    write_attribute(dataset, "unit", unit);
    write_attribute(dataset, "description", description);
}

void append_to_column(const H5::Group& group, const std::string& name, std::span<const double> values)
{
    append_values(group, name, H5::PredType::NATIVE_DOUBLE, values);
}

void append_to_column(const H5::Group& group, const std::string& name, std::span<const std::int64_t> values)
{
    append_values(group, name, H5::PredType::NATIVE_INT64, values);
}

hsize_t column_length(const H5::Group& group, const std::string& name)
{
    hsize_t length = 0;
    group.openDataSet(name).getSpace().getSimpleExtentDims(&length);
    return length;
}

void cut_column(const H5::Group& group, const std::string& name, hsize_t length)
{
    group.openDataSet(name).extend(&length);
}

} // namespace periporo::output
