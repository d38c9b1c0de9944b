// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fuzz target: a case file, from its text to its description. Its plugins are stand-ins that take parameters.
#define DOCTEST_CONFIG_DISABLE // the stand-ins are those of tests
#include "fuzz_input.hpp"
#include "unit/case/case_support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace periporo;
    static const test::FuzzFile file("case.toml");
    static PluginRegistry registry = test::test_registry();
    const std::string text = test::text_of(data, size);
    if (text.find("include") != std::string::npos || text.find("paths") != std::string::npos)
        return 0; // a fuzzer must not choose the files that the reader opens
    return test::read_or_refuse([&] { read_case(file.write(text), {}, registry); });
}
