// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The degree of saturation between its residual and its full value.
#pragma once

#include "periporo/parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace periporo {

/// S_r = S1 + (S2 - S1) S_e, with the effective saturation S_e in 0..1: S1 is what the driest soil keeps, S2 what the
/// wettest takes up.
class SaturationRange {
public:
    static void append_records(std::vector<Parameter>& records)
    {
        records.push_back(
            Parameter::real("residual_saturation", dimension::none, "S1, which no suction falls below; less than S2")
                .at_least(0.0)
                .at_most(1.0)
                .by_default(0.0));
        records.push_back(
            Parameter::real("full_saturation", dimension::none, "S2 without suction; less than 1 with trapped air")
                .at_least(0.0)
                .at_most(1.0)
                .by_default(1.0));
    }

    /// @throws std::invalid_argument unless S1 < S2.
    explicit SaturationRange(const Parameters& parameters)
        : residual_(parameters.real("residual_saturation")), full_(parameters.real("full_saturation"))
    {
        if (residual_ >= full_)
            throw std::invalid_argument(
                fmt::format("residual_saturation ({:g}) must be less than full_saturation ({:g})", residual_, full_));
    }

    double full() const { return full_; }

    /// S_r at an effective saturation in 0..1; exactly S1 at 0 and S2 at 1, and never beyond.
    double at(double effective) const { return std::lerp(residual_, full_, effective); }

private:
    double residual_; // S1
    double full_;     // S2
};

} // namespace periporo
