// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A shared library that is no plugin.
extern "C" __attribute__((visibility("default"))) int periporo_answer()
{
    return 42;
}
