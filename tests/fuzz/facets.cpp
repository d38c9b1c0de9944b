// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fuzz target: a surface mesh. The first byte tells the format, the others are the file.
#include "fuzz_input.hpp"
#include "surface_mesh/facet_file.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace periporo;
    static const std::array files{test::FuzzFile("mesh.stl"), test::FuzzFile("mesh.off"), test::FuzzFile("mesh.obj"),
                                  test::FuzzFile("mesh.ply")};
    if (size == 0)
        return 0;
    const test::FuzzFile& file = files[data[0] % files.size()];
    return test::read_or_refuse([&] {
        const auto facets = geometry::read_facets(file.write(test::text_of(data + 1, size - 1)).string());
        for (const auto& polygon : facets.polygons)
            for (const std::size_t corner : polygon)
                if (corner >= facets.points.size())
                    std::abort();
    });
}
