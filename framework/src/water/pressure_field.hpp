// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pore pressure that a case describes, at any place.
#pragma once

#include "case/description.hpp"

#include <memory>

namespace periporo {

class PressureField {
public:
    virtual ~PressureField() = default;

    /// Pore pressure p at a place, compression positive: suction is -p above a water table [Pa].
    virtual double at(const Vector3& place) const = 0;
};

/// Zero for a dry body. Around a water table it is that of water at rest, p = -rho_w g z with z the height above the
/// table; above the table it is bounded by the largest suction.
/// @throws std::runtime_error that names the file of a field and the line when it cannot be used
std::unique_ptr<PressureField> make_pressure_field(const WaterDescription& water, const Vector3& gravity);

} // namespace periporo
