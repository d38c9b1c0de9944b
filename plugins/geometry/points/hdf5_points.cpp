// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Material points from HDF5.
#include "point_file.hpp"

#include <H5Cpp.h>
#include <fmt/format.h>

namespace periporo::geometry {

namespace {

/// The numbers of a dataset of the given width, row by row; a width of 1 stands for one dimension.
std::vector<double> numbers(const PointFile& file, const H5::H5File& content, const std::string& name, hsize_t width)
{
    const std::string shape = width == 1 ? "n numbers" : fmt::format("n x {} numbers", width);
    if (!content.nameExists(name) || content.childObjType(name) != H5O_TYPE_DATASET)
        file.refuse(fmt::format("there is no dataset \"{}\" of {}", name, shape));
    const H5::DataSet dataset = content.openDataSet(name);
    const H5::DataSpace space = dataset.getSpace();
    const H5T_class_t type = dataset.getTypeClass();
    const int rank = width == 1 ? 1 : 2;
    hsize_t extent[2] = {0, 1};
    if ((type != H5T_FLOAT && type != H5T_INTEGER) || space.getSimpleExtentNdims() != rank ||
        space.getSimpleExtentDims(extent) != rank || extent[1] != width)
        file.refuse(fmt::format("dataset \"{}\" must hold {}", name, shape));
    std::vector<double> values(extent[0] * width);
    if (!values.empty())
        dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE);
    return values;
}

} // namespace

void read_hdf5(PointFile& file)
{
    try {
        H5::Exception::dontPrint();
        const H5::H5File content(file.path, H5F_ACC_RDONLY);
        const std::vector<double> positions = numbers(file, content, "position", 3);
        file.points.volumes = numbers(file, content, "volume", 1);
        if (positions.size() != 3 * file.points.volumes.size())
            file.refuse(fmt::format("dataset \"position\" holds {} points, and \"volume\" {}", positions.size() / 3,
                                    file.points.volumes.size()));
        for (std::size_t p = 0; p < file.points.volumes.size(); ++p)
            file.points.positions.emplace_back(positions[3 * p], positions[3 * p + 1], positions[3 * p + 2]);
    } catch (const H5::Exception& error) { // which is no std::exception
        file.refuse("HDF5: " + error.getDetailMsg());
    }
}

} // namespace periporo::geometry
