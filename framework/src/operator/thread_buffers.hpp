// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Buffers that each thread keeps for itself.
#pragma once

namespace periporo {

/// The buffers of this thread, which outlive an evaluation, so that no step allocates. Not inlined: where the compiler
/// sees a variable of a thread, it asks for its address again in inner loops, and saves all registers before it does.
template <class Buffers>
[[gnu::noinline]] Buffers& thread_buffers()
{
    thread_local Buffers buffers;
    return buffers;
}

} // namespace periporo
