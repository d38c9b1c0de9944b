// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All that an HDF5 file holds, as one table, so that two files can be compared.
#pragma once

#include <H5Cpp.h>

#include <filesystem>
#include <map>
#include <string>

namespace periporo::test {

/// Values and attributes by their path; values as class, extent and raw bytes (texts as they are).
class ResultContent {
public:
    explicit ResultContent(const std::filesystem::path& path)
    {
        const H5::H5File file(path.string(), H5F_ACC_RDONLY);
        walk(file.openGroup("/"), "");
    }

    std::map<std::string, std::string> take() { return std::move(entries_); }

private:
    void walk(const H5::Group& group, const std::string& path)
    {
        entries_[path + "/"] = "group";
        add_attributes(group, path + "/");
        for (hsize_t i = 0; i < group.getNumObjs(); ++i) {
            const std::string name = group.getObjnameByIdx(i);
            if (group.childObjType(name) == H5O_TYPE_GROUP) {
                walk(group.openGroup(name), path + "/" + name);
            } else {
                const H5::DataSet dataset = group.openDataSet(name);
                entries_[path + "/" + name] = value(dataset);
                add_attributes(dataset, path + "/" + name);
            }
        }
    }

    void add_attributes(const H5::H5Object& object, const std::string& path)
    {
        for (int i = 0; i < object.getNumAttrs(); ++i) {
            const H5::Attribute attribute = object.openAttribute(static_cast<unsigned>(i));
            std::string bytes;
            if (attribute.getTypeClass() == H5T_STRING) {
                attribute.read(attribute.getStrType(), bytes);
            } else {
                bytes.resize(attribute.getInMemDataSize());
                attribute.read(attribute.getDataType(), bytes.data());
            }
            entries_[path + "@" + attribute.getName()] = bytes;
        }
    }

    static std::string value(const H5::DataSet& dataset)
    {
        const H5::DataSpace space = dataset.getSpace();
        std::string text = std::to_string(dataset.getTypeClass());
        hsize_t extent[H5S_MAX_RANK] = {};
        for (int d = 0, rank = space.getSimpleExtentDims(extent); d < rank; ++d)
            text += " x " + std::to_string(extent[d]);
        std::string bytes;
        if (dataset.getTypeClass() == H5T_STRING) {
            dataset.read(bytes, dataset.getStrType());
        } else if (space.getSimpleExtentNpoints() > 0) {
            bytes.resize(dataset.getInMemDataSize());
            dataset.read(bytes.data(), dataset.getDataType());
        }
        return text + ": " + bytes;
    }

    std::map<std::string, std::string> entries_;
};

inline std::map<std::string, std::string> content_of(const std::filesystem::path& path)
{
    return ResultContent(path).take();
}

} // namespace periporo::test
