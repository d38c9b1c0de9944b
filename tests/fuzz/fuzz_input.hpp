// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Shared parts of the fuzz targets: the input as text or as a file, and the exceptions that a reader may throw.
#pragma once

#include "support/temporary_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

namespace periporo::test {

inline std::string text_of(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

/// A file in a folder of the process, written anew for each input.
class FuzzFile {
public:
    explicit FuzzFile(const std::string& name) : file_(folder_ / name) {}
    const std::filesystem::path& path() const { return file_; }
    const std::filesystem::path& write(const std::string& content) const
    {
        std::ofstream(file_, std::ios::binary | std::ios::trunc) << content;
        return file_;
    }

private:
    TemporaryFolder folder_;
    std::filesystem::path file_;
};

/// Calls a reader. It refuses an input by a std::runtime_error or a std::invalid_argument; any other exception ends the
/// process, and is a finding.
template <class Read>
int read_or_refuse(Read&& read)
{
    try {
        read();
    } catch (const std::runtime_error&) {
    } catch (const std::invalid_argument&) {
    }
    return 0;
}

} // namespace periporo::test

/// The entry of libFuzzer, and of replay.cpp. @return 0
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
