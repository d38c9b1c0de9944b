// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs a fuzz target once on each file in the folders given as arguments, without a fuzzer.
#include "fuzz_input.hpp"

#include <cstdio>
#include <iterator>

int main(int count, char** arguments)
{
    int files = 0;
    for (int n = 1; n < count; ++n)
        for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[n])) {
            if (!entry.is_regular_file())
                continue;
            std::ifstream stream(entry.path(), std::ios::binary);
            const std::string content{std::istreambuf_iterator<char>(stream), {}};
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
            ++files;
        }
    std::printf("%d files\n", files);
    return files == 0 && count > 1 ? 1 : 0;
}
