// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The utility routines of Abaqus that a user routine may call: XIT, XPLB_EXIT, STDB_ABQERR, XPLB_ABQERR, SINV, SPRINC,
// SPRIND, ROTSIG and VSPRINC, as their published interfaces describe them.
#pragma once

#include <string>

namespace periporo::abaqus {

/// The provided routines, for messages.
inline constexpr const char* utility_routine_names =
    "XIT, XPLB_EXIT, STDB_ABQERR, XPLB_ABQERR, SINV, SPRINC, SPRIND, ROTSIG, VSPRINC";

/// Makes them visible to libraries that are loaded from now on; to be called again does nothing.
/// @throws std::runtime_error when the dynamic linker refuses
void share_utility_routines();

/// Forgets the error of this thread.
void forget_reported_error();
/// What this thread's routine reported by STDB_ABQERR or XPLB_ABQERR as an error (LOP = -2 or -3), or ended with, as by
/// STOP; empty when it did neither.
const std::string& reported_error();

/// Keeps the text as the error of this thread and leaves the routine that it is in.
[[noreturn]] void leave_with_error(std::string text);

/// Ends the process with a message and exit status 1 when a routine calls exit(). To be called again does nothing.
void watch_end_of_process();

} // namespace periporo::abaqus
