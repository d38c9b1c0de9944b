// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Exact arithmetic on coordinates as given, and the bound below which double arithmetic must not decide.
#pragma once

#include "periporo/tensor.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <limits>

namespace periporo::geometry {

/// CGAL's kernel over rational numbers: every double is one, and sums, products and comparisons are exact.
using ExactKernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Exact = ExactKernel::FT;
using ExactPoint = ExactKernel::Point_3;
using ExactVector = ExactKernel::Vector_3;

inline ExactPoint exact_point(const Vector3& p)
{
    return {p.x(), p.y(), p.z()};
}

inline ExactVector exact_vector(const Vector3& v)
{
    return {v.x(), v.y(), v.z()};
}

/// A relative bound on the rounding of the short sums of products in this folder, with room to spare: none of them
/// takes more than a dozen operations in a row. Doubles nearer to a surface than this times the size of their terms
/// leave the decision to exact arithmetic.
inline constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

} // namespace periporo::geometry
