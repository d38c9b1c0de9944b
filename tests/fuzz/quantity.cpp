// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fuzz target: a quantity with its unit, "12.5 kN/m2".
#include "fuzz_input.hpp"
#include "periporo/units.hpp"

#include <cmath>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace periporo;
    return test::read_or_refuse([&] {
        if (!std::isfinite(parse_quantity(test::text_of(data, size)).value))
            std::abort(); // a quantity of a case is a number
    });
}
