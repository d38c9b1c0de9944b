// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The energy of water that comes to the points of a body.
#pragma once

namespace periporo {

/// Energy of the mass dm that points take up where they are and with their velocity, negative where mass leaves [J].
struct ArrivedEnergy {
    double kinetic = 0.0; ///< sum dm v^2/2
    double gravity = 0.0; ///< -sum dm g.x
};

} // namespace periporo
