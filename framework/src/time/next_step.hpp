// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Steps that end exactly where a stage ends.
#pragma once

namespace periporo {

struct NextStep {
    double length = 0.0; ///< [s]
    bool last = false;   ///< it ends at the end
};

/// Longer than `step` by this part at most is one step still: round-off of a sum of steps, far below any safety factor.
inline constexpr double stretch_of_step = 1e-9;

/// The step from `time` towards `end` that is no longer than `step` and leaves no sliver: what is left between one and
/// two steps is halved, so that no step but that of a stage shorter than `step` lasts less than half of it.
inline NextStep next_step(double time, double end, double step)
{
    const double left = end - time;
    if (left <= step * (1.0 + stretch_of_step))
        return {left, true};
    return {left < 2.0 * step ? 0.5 * left : step, false};
}

} // namespace periporo
