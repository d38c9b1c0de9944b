// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The functions that HDF5 calls for a file of this driver.
#include "hdf5_driver.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <new>

namespace periporo::output {
namespace {

/// HDF5 keeps its own members in front of those of the driver.
struct OpenFile {
    H5FD_t base = {};
    int descriptor = -1;
    haddr_t end_of_addresses = 0;
    haddr_t end_of_file = 0;
    WriteFault* fault = nullptr;
};

/// What a list of access properties carries.
struct DriverInfo {
    WriteFault* fault;
};

OpenFile& file_of(H5FD_t* file)
{
    return *reinterpret_cast<OpenFile*>(file);
}

const OpenFile& file_of(const H5FD_t* file)
{
    return *reinterpret_cast<const OpenFile*>(file);
}

void note(OpenFile& file, int error)
{
    if (file.fault->error == 0)
        file.fault->error = error;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t)
{
    const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
    if (info == nullptr)
        return nullptr;
    int mode = (flags & H5F_ACC_RDWR) != 0u ? O_RDWR : O_RDONLY;
    if ((flags & H5F_ACC_CREAT) != 0u)
        mode |= O_CREAT;
    if ((flags & H5F_ACC_TRUNC) != 0u)
        mode |= O_TRUNC;
    const int descriptor = ::open(name, mode | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) {
        info->fault->error = errno;
        return nullptr;
    }
    auto* file = new (std::nothrow) OpenFile;
    if (file == nullptr) {
        ::close(descriptor);
        info->fault->error = ENOMEM;
        return nullptr;
    }
    file->descriptor = descriptor;
    file->fault = info->fault;
    file->end_of_file = static_cast<haddr_t>(std::max<off_t>(::lseek(descriptor, 0, SEEK_END), 0));
    return &file->base;
}

herr_t close_file(H5FD_t* handle)
{
    OpenFile& file = file_of(handle);
    if (::close(file.descriptor) != 0)
        note(file, errno);
    delete &file;
    return 0;
}

herr_t query(const H5FD_t*, unsigned long* features)
{
    *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

herr_t read_bytes(H5FD_t* handle, H5FD_mem_t, hid_t, haddr_t place, size_t size, void* buffer)
{
    OpenFile& file = file_of(handle);
    char* to = static_cast<char*>(buffer);
    while (size > 0) {
        const ssize_t count = ::pread(file.descriptor, to, size, static_cast<off_t>(place));
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0) {
            note(file, errno);
            return -1;
        }
        if (count == 0) { // beyond the end of the file
            std::memset(to, 0, size);
            return 0;
        }
        to += count;
        place += static_cast<haddr_t>(count);
        size -= static_cast<size_t>(count);
    }
    return 0;
}

herr_t write_bytes(H5FD_t* handle, H5FD_mem_t, hid_t, haddr_t place, size_t size, const void* buffer)
{
    OpenFile& file = file_of(handle);
    const char* from = static_cast<const char*>(buffer);
    file.end_of_file = std::max(file.end_of_file, place + size);
    while (size > 0 && file.fault->error == 0) {
        const ssize_t count = ::pwrite(file.descriptor, from, size, static_cast<off_t>(place));
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0) {
            note(file, errno);
            break;
        }
        from += count;
        place += static_cast<haddr_t>(count);
        size -= static_cast<size_t>(count);
    }
    return 0;
}

herr_t truncate_file(H5FD_t* handle, hid_t, hbool_t)
{
    OpenFile& file = file_of(handle);
    if (file.end_of_file == file.end_of_addresses)
        return 0;
    if (file.fault->error == 0 && ::ftruncate(file.descriptor, static_cast<off_t>(file.end_of_addresses)) != 0)
        note(file, errno);
    file.end_of_file = file.end_of_addresses;
    return 0;
}

haddr_t get_end_of_addresses(const H5FD_t* file, H5FD_mem_t)
{
    return file_of(file).end_of_addresses;
}

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t place)
{
    file_of(file).end_of_addresses = place;
    return 0;
}

haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t)
{
    return file_of(file).end_of_file;
}

hid_t register_driver()
{
    H5FD_class_t driver = {};
#if H5_VERSION_GE(1, 14, 0)
    driver.version = H5FD_CLASS_VERSION;
    driver.value = static_cast<H5FD_class_value_t>(520); // of the range that HDF5 leaves to drivers for private use
#endif
    driver.name = "periporo";
    driver.maxaddr = (static_cast<haddr_t>(1) << (8 * sizeof(off_t) - 1)) - 1;
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.fapl_size = sizeof(DriverInfo);
    driver.open = open_file;
    driver.close = close_file;
    driver.query = query;
    driver.get_eoa = get_end_of_addresses;
    driver.set_eoa = set_end_of_addresses;
    driver.get_eof = get_end_of_file;
    driver.read = read_bytes;
    driver.write = write_bytes;
    driver.truncate = truncate_file;
    const H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(free_lists), std::end(free_lists), std::begin(driver.fl_map));
    return H5FDregister(&driver);
}

} // namespace

H5::H5File create_hdf5_file(const std::filesystem::path& file, WriteFault& fault)
{
    static const hid_t driver = register_driver();
    const DriverInfo info{&fault};
    H5::FileAccPropList access;
    if (driver < 0 || H5Pset_driver(access.getId(), driver, &info) < 0)
        throw H5::FileIException("create_hdf5_file", "the file driver cannot be registered");
    return {file.string(), H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access};
}

} // namespace periporo::output
