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
    virtual double saturation(double suction, double porosity) const = 0;
};

} // namespace periporo
