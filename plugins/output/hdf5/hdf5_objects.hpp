// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The few HDF5 objects a result file is made of: texts, numbers, arrays, columns, and links to other files.
#pragma once

#include "periporo/file.hpp"

#include <H5Cpp.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace periporo::output {

/// While it lives HDF5 prints no errors, and it finds out whether one of them is a want of memory: the exceptions of
/// HDF5 do not say so, and its stack of errors is empty again when one is caught.
class Hdf5Errors {
public:
    Hdf5Errors();
    ~Hdf5Errors();
    Hdf5Errors(const Hdf5Errors&) = delete;
    Hdf5Errors& operator=(const Hdf5Errors&) = delete;
    bool out_of_memory() const { return out_of_memory_; }

private:
    bool out_of_memory_ = false;
};

/// Runs `action` and turns what HDF5 throws, which is no std::exception, into an error with `what` and the file.
template <class Action>
auto guarded(const std::string& what, const std::filesystem::path& file, Action&& action)
{
    const Hdf5Errors errors;
    try {
        return action();
    } catch (const H5::Exception& error) {
        if (errors.out_of_memory())
            throw FileError(what, file, ENOMEM);
        throw std::runtime_error(what + " " + file.string() + ": HDF5: " + error.getDetailMsg() + " (" +
                                 error.getFuncName() + ")");
    }
}

/// Opens a file for reading without locking it: a run must not stop another that looks at its results.
/// @throws FileError when the system does not let it be read
H5::H5File open_unlocked(const std::filesystem::path& file);

void write_attribute(const H5::H5Object& object, const std::string& name, const std::string& text);
void write_attribute(const H5::H5Object& object, const std::string& name, std::int64_t value);
void write_attribute(const H5::H5Object& object, const std::string& name, double value);

double read_real_attribute(const H5::H5Object& object, const std::string& name);
std::int64_t read_whole_attribute(const H5::H5Object& object, const std::string& name);

/// A scalar text of any length in UTF-8.
void write_text(const H5::Group& group, const std::string& name, const std::string& text);

/// Points x components values with their unit and description, point by point; one dimension when there is one
/// component.
/// @param compression deflate level, 0 for none
void write_array(const H5::Group& group, const std::string& name, std::span<const double> values,
                 std::size_t components, const std::string& unit, const std::string& description, int compression);
void write_array(const H5::Group& group, const std::string& name, std::span<const std::int64_t> values,
                 std::size_t components, const std::string& unit, const std::string& description, int compression);

/// Makes `name` in a group stand for `object` in another file.
/// @param file relative to the folder of the file that has the link
void link_to_file(const H5::Group& group, const std::string& name, const std::string& file, const std::string& object);

/// Copies `object` of a file with everything in it, as it is stored.
void copy_object(const H5::H5File& from, const std::string& object, const H5::Group& to, const std::string& name);

} // namespace periporo::output
