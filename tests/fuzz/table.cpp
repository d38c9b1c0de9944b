// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fuzz target: a CSV table with units in its header.
#include "fuzz_input.hpp"
#include "periporo/csv_table.hpp"

#include <cmath>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace periporo;
    static const test::FuzzFile file("table.csv");
    return test::read_or_refuse([&] {
        const CsvTable table = read_csv_table(file.write(test::text_of(data, size)),
                                              {{"x", dimension::length}, {"suction", dimension::pressure}});
        for (const std::vector<double>& column : table.columns)
            for (const double value : column)
                if (!std::isfinite(value) || column.size() != table.rows())
                    std::abort();
    });
}
