// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The yield surface of any law, found by asking the law.
#pragma once

#include "periporo/material_point.hpp"

#include <vector>

namespace periporo {

/// A point of the triaxial plane: axial compression along z, so q = axial minus lateral pressure.
struct TriaxialStress {
    double p = 0.0; ///< compression positive [Pa]
    double q = 0.0; ///< [Pa]
};

/// Where the elastic domain of a point in its present state ends, in triaxial compression, from the side of high p to
/// the side of low p. The law is asked: a stress is inside when one strain increment, the elastic one from the middle
/// of the domain, leads exactly there; it is held for long, so that a rate-dependent law shows its static surface.
/// Empty for a law that is elastic everywhere, that has no elastic domain, or whose moduli are not constant in it.
/// Directions in which the domain does not end within a thousand times `scale` have no point.
/// @param scale a stress of the size of those on the path [Pa]
std::vector<TriaxialStress> yield_surface(const MaterialPoint& point, double scale);

} // namespace periporo
