// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The suction that a case describes, at any place.
#pragma once

#include "case/description.hpp"

#include <memory>

namespace periporo {

class SuctionField {
public:
    virtual ~SuctionField() = default;

    /// Suction s >= 0 at a place [Pa].
    virtual double at(const Vector3& place) const = 0;
};

/// Zero for a dry body. Above a water table it is that of water at rest, s = rho_w g z with z the height above; below
/// it is zero: positive pore pressures are not part of the model.
/// @throws std::runtime_error that names the file of a field and the line when it cannot be used
std::unique_ptr<SuctionField> make_suction_field(const WaterDescription& water, const Vector3& gravity);

} // namespace periporo
