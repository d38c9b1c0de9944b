// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A deformable body: what all its points have in common.
#pragma once

#include "periporo/material.hpp"

#include <limits>
#include <memory>
#include <string>

namespace periporo {

struct Body {
    std::string name;
    std::shared_ptr<const Material> material;
    double overconsolidation_ratio = 1.0; ///< OCR, for the initial state of the material [-]
    double porosity = 0.0;                ///< phi0 [-]
    bool ground = false;                  ///< do points of another body stand on its smoothed surface?
    /// Two pieces of the body join when they come nearer than this; 0 where a contact law holds pieces apart
    /// [spacings].
    double joining_distance = 1.0;
    /// Height along -gravity of the surface of the water that stands around it; minus infinity: none does [m].
    double water_level = -std::numeric_limits<double>::infinity();

    bool has_standing_water() const { return water_level > -std::numeric_limits<double>::infinity(); }
    /// Numbers in the state of a point or a bond: six of stress, then the state variables.
    std::size_t rows() const { return 6 + material->state_variables().size(); }
};

} // namespace periporo
