// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shape of van Genuchten's curve, over the ratio of suction and air-entry value.
#pragma once

#include "saturation_range.hpp"

namespace periporo {

/// S_r = S1 + (S2 - S1) [1 + x^n]^-m with x = s/s_a (van Genuchten 1980); m = 1 - 1/n when left out.
class VanGenuchtenShape {
public:
    static void append_records(std::vector<Parameter>& records)
    {
        records.push_back(
            Parameter::real("exponent", dimension::none, "n; small when pores are of many sizes").above(1.0));
        records.push_back(
            Parameter::real("m", dimension::none, "Second exponent m; 1 - 1/n when left out").above(0.0).optional());
        SaturationRange::append_records(records);
    }

    /// @throws std::invalid_argument as SaturationRange does.
    explicit VanGenuchtenShape(const Parameters& parameters)
        : n_(parameters.real("exponent")), m_(parameters.has("m") ? parameters.real("m") : 1.0 - 1.0 / n_),
          range_(parameters)
    {
    }

    /// S_r at x = s/s_a. A ratio of zero or below is that of saturated soil, and so is none at all (0 times infinity:
    /// no suction or no voids).
    double saturation(double ratio) const
    {
        return ratio > 0.0 ? range_.at(std::pow(1.0 + std::pow(ratio, n_), -m_)) : range_.full();
    }

private:
    double n_;
    double m_;
    SaturationRange range_;
};

} // namespace periporo
