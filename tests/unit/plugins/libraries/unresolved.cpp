// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A shared library that needs a function nobody provides.
extern "C" int periporo_nobody_provides_this();

extern "C" __attribute__((visibility("default"))) int periporo_answer()
{
    return periporo_nobody_provides_this();
}
