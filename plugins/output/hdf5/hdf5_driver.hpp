// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A file driver of HDF5 that keeps the system's reason when a write fails.
//
// HDF5 passes on that it could not write and not why, and a file whose last writes fail cannot be closed: at the end of
// the program HDF5 tries again and crashes. This driver stores the error of the first call that fails, drops what is
// written after it, and reports success to HDF5, which then closes the file in order. Whoever wrote the file asks for
// the error when it is closed, and throws the file away.
#pragma once

#include <H5Cpp.h>

#include "periporo/file.hpp"

#include <filesystem>
#include <utility>

namespace periporo::output {

/// The first error of the system while HDF5 wrote a file, or 0.
struct WriteFault {
    int error = 0;
};

/// Creates an HDF5 file, in place of any that is there; no lock is taken, and a symbolic link is not followed.
/// @param fault must live as long as the file
/// @throws H5::Exception when it cannot be created; `fault` then has the reason
H5::H5File create_hdf5_file(const std::filesystem::path& file, WriteFault& fault);

/// Writes an HDF5 file by fill(H5::H5File&), within guarded() of hdf5_objects.hpp. After an error nothing is left of
/// it.
/// @throws FileError with the system's reason; H5::Exception when HDF5 has one of its own
template <class Fill>
void write_hdf5_file(const std::filesystem::path& file, Fill&& fill)
{
    WriteFault fault;
    const auto throw_away = [&] {
        std::error_code ignored;
        std::filesystem::remove(file, ignored);
    };
    try {
        H5::H5File stream = create_hdf5_file(file, fault);
        std::forward<Fill>(fill)(stream);
        stream.close();
    } catch (...) {
        throw_away();
        if (fault.error != 0) // what HDF5 met is a consequence of it
            throw FileError("cannot write", file, fault.error);
        throw;
    }
    if (fault.error != 0) {
        throw_away();
        throw FileError("cannot write", file, fault.error);
    }
}

} // namespace periporo::output
