// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Widths that follow from the machine which the compiler compiles for. Program and plugins must agree in them.
#pragma once

#include <cstddef>

namespace periporo {

/// Number of doubles in one vector register, and of lanes in a Pack (pack.hpp holds the two together).
inline constexpr std::size_t pack_width =
#if defined(__AVX512F__)
    8;
#elif defined(__AVX__)
    4;
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__VSX__)
    2;
#else
    1;
#endif

/// Alignment of Eigen's matrices [bytes] (vector.hpp holds the two together).
inline constexpr std::size_t eigen_alignment =
#if defined(EIGEN_MAX_ALIGN_BYTES)
    EIGEN_MAX_ALIGN_BYTES;
#elif defined(__AVX512F__)
    64;
#elif defined(__AVX__)
    32;
#else
    16;
#endif

} // namespace periporo
