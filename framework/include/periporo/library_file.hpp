// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Looks at a shared library before it is loaded: the loader of the system ends the program on a damaged one.
#pragma once

#include <filesystem>
#include <string>

namespace periporo {

/// Why the file cannot be loaded as a shared library: it is no regular file, no ELF library of 64 bits, or shorter than
/// its own headers say. An empty text when none of this is so. To be called before dlopen() of any file that a user
/// names.
std::string library_objection(const std::filesystem::path& file);

} // namespace periporo
