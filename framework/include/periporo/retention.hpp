// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of retention plugins: the water retention curve.
#pragma once

#include "periporo/plugin.hpp"

namespace periporo {

class Retention {
public:
    virtual ~Retention() = default;

    /// Degree of saturation S_r [-] at a suction s >= 0 [Pa] and a porosity [-].
    /// @return a number within 0..1 that, at a fixed porosity, does not rise with the suction
    virtual double saturation(double suction, double porosity) const = 0;

    /// False lets the framework evaluate the curve only when the suction changes. True is always right.
    virtual bool depends_on_porosity() const { return true; }
};

} // namespace periporo
