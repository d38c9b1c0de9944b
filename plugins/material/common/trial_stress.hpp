// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What every elastoplastic law does with its trial stress: refuse one that is not finite, and return it lane by lane.
#pragma once

#include "periporo/tensor.hpp"

#include <array>

namespace periporo {

/// Why a lane that is not `usable` fails.
inline constexpr const char* not_finite = "stress, strain increment, state or time step is not a finite number";

/// The lanes whose trial stress [Pa] and state a law can work with; none when the time step [s] is negative or not
/// finite. What is so large that products of it would overflow counts as not finite: no soil, but a diverged run.
template <class Real, std::size_t state_count>
Mask<Real> usable(const SymmetricTensor<Real>& trial, const std::array<Real, state_count>& state, double time_step)
{
    constexpr double largest = 1e30;
    // comparisons with NaN are false
    Mask<Real> result = double_contraction(trial, trial) <= Real(largest * largest);
    for (const Real& variable : state)
        result = result && absolute(variable) <= Real(largest);
    return result && Mask<Real>(time_step >= 0.0 && time_step <= largest);
}

} // namespace periporo
