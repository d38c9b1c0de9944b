// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the energy went.
#pragma once

namespace periporo {

/// Energies since the ledger was opened [J]. Each is found by its own way: kinetic and gravity from velocities and
/// positions, the work of stress from bond stresses and rates of deformation, contact from the laws' stored energy,
/// friction from forces and velocities. error() is then a check and not an identity.
struct EnergyLedger {
    double kinetic = 0.0;     ///< sum m v^2/2
    double gravity = 0.0;     ///< potential energy -sum m g.x relative to the opening
    double stress_work = 0.0; ///< stored and dissipated by the material
    double contact = 0.0;     ///< stored in contacts
    double friction = 0.0;    ///< dissipated by friction
    double collision = 0.0;   ///< dissipated in the normal direction of contacts
    double opening = 0.0;     ///< kinetic + contact when opened

    /// What is missing or too much; 0 for an exact time integration.
    double error() const { return kinetic + gravity + stress_work + contact + friction + collision - opening; }
};

} // namespace periporo
