// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every kind of stage as one thing: components under control of stress or of strain, and the water beside them.
#pragma once

#include "drive/path_description.hpp"
#include "periporo/material_point.hpp"

namespace periporo {

/// A tensor by its components xx yy zz xy yz xz.

/// What is prescribed at one moment.
struct StageValues {
    /// Effective stress where it is controlled [Pa], else the strain since the start of the stage [-].
    std::array<double, 6> components{};
    double suction = 0.0;    ///< [Pa]
    double saturation = 0.0; ///< [-]
};

/// A stage from its start to its target; what lies between is in proportion.
struct StagePlan {
    std::array<bool, 6> stress_controlled{};
    bool total_stress = false; ///< are the normal stresses total ones, effective + S_r s?
    bool simple_shear = false; ///< does the point turn with the shear xz, as MixedStep says?
    bool wet = false;          ///< is there water, with a saturation by the retention curve where there is one?
    StageValues start;
    StageValues target;

    /// @param way 0 at the start, 1 at the target, -1 at its mirror image.
    StageValues at(double way) const;
};

/// The plan of a stage that begins at `point`.
StagePlan plan_stage(const StageKind& kind, const MaterialPoint& point);

} // namespace periporo
