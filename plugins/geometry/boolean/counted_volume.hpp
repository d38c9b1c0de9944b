// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The volume of a region that no formula gives.
#pragma once

#include "periporo/geometry.hpp"

#include <functional>
#include <optional>

namespace periporo::geometry {

/// A region as the count sees it. Both are called from several threads at once.
struct CountedRegion {
    Bounds bounds;
    std::function<bool(const Vector3&)> contains;
    /// True when a ball of this centre and radius [m] lies inside as a whole, false when it lies outside, nothing when
    /// that is not known.
    std::function<std::optional<bool>(const Vector3&, double)> decided;
};

struct CountedVolume {
    double volume = 0.0; ///< [m3]
    double error = 0.0;  ///< of it, exceeded once in twenty times at most [m3]
};

/// Halves the bounds again and again. Cells that `decided` knows count as a whole; in each of the others, 4 x 4 x 4
/// samples, one at random in each part of the cell, tell which part is inside. Sampling at random in every cell makes
/// the mean right however thin the region is and however its faces lie to the axes, and the error one of chance: twice
/// the standard error, which is reckoned from the spread of the samples of each cell as if they were anywhere in it and
/// so comes out too large rather than too small, or what all samples may well have missed. Cells are halved until the
/// error is below 1e-4 of the volume, or the samples reach 2e7. The answer is the same with any number of threads.
CountedVolume count_volume(const CountedRegion& region);

} // namespace periporo::geometry
