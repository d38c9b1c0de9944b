// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fuzz target: a grid of heights. The first byte tells the format, the others are the file.
#include "common/height_grid.hpp"
#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace periporo;
    static const test::FuzzFile esri("grid.asc"), csv("grid.csv");
    if (size == 0)
        return 0;
    const std::string content = test::text_of(data + 1, size - 1);
    return test::read_or_refuse(
        [&] { geometry::read_height_grid((data[0] % 2 == 0 ? esri : csv).write(content).string()); });
}
