// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the energy went.
#pragma once

#include <algorithm>
#include <cmath>

namespace periporo {

/// The power of a force with the velocities at the end of a step, and what the half kick of the net force there adds to
/// it within a time dt/2.
struct ForcePower {
    double at_end = 0.0; ///< sum f.v [W]
    double growth = 0.0; ///< sum f.F/m; 0 for forces on what moves at a prescribed velocity [W/s]

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("at_end", self.at_end);
        visit("growth", self.growth);
    }
};

/// Work of a force in a step of velocity Verlet, (f_n + f_n+1)/2 . dt v_n+1/2 [J]: with all forces summed so, the
/// kinetic energy and `EnergyLedger::verlet` together change by exactly that. v_n+1/2 is v_n + dt F_n/(2m) and
/// v_n+1 - dt F_n+1/(2m).
inline double work_of_step(const ForcePower& before, const ForcePower& after, double time_step)
{
    return 0.5 * time_step * (before.at_end + after.at_end + 0.5 * time_step * (before.growth - after.growth));
}

/// Powers that the works of the next step begin with.
struct LedgerPowers {
    ForcePower boundary;  ///< of what moves points and obstacles
    ForcePower friction;  ///< on the slip of contacts
    ForcePower collision; ///< of what does not come from stored energy, on the approach

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit.part("boundary", self.boundary);
        visit.part("friction", self.friction);
        visit.part("collision", self.collision);
    }
};

/// Energies since the ledger was opened [J]. Each is found by its own way: kinetic and gravity from velocities and
/// positions, the work of stress from bond stresses and rates of deformation, contact from the laws' stored energy,
/// friction from forces and velocities. error() is then a check and not an identity.
struct EnergyLedger {
    double kinetic = 0.0;     ///< sum m v^2/2
    double gravity = 0.0;     ///< potential energy -sum m g.x relative to the opening, and to where later mass arrived
    double stress_work = 0.0; ///< stored and dissipated by the material
    double contact = 0.0;     ///< stored in contacts
    double friction = 0.0;    ///< dissipated by friction
    double collision = 0.0;   ///< dissipated in the normal direction of contacts
    /// Work of moving points, of moving obstacles and of the lift of standing water on the bodies; kinetic energy of
    /// water that came.
    double boundary = 0.0;
    double opening = 0.0; ///< kinetic + contact when opened
    /// What velocity Verlet lends to the kinetic energy within a period and takes back: minus dt^2 |F|^2/(8m) since the
    /// opening. A step from n to n+1 adds (F_n + F_n+1)/2 . dx to kinetic + verlet exactly.
    double verlet = 0.0;
    double turned_over = 0.0; ///< largest turnover() since the opening

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("kinetic", self.kinetic);
        visit("gravity", self.gravity);
        visit("stress_work", self.stress_work);
        visit("contact", self.contact);
        visit("friction", self.friction);
        visit("collision", self.collision);
        visit("boundary", self.boundary);
        visit("opening", self.opening);
        visit("verlet", self.verlet);
        visit("turned_over", self.turned_over);
    }

    /// What is missing or too much; 0 but for round-off while stress and contact are linear in the motion of a step.
    double error() const
    {
        return kinetic + verlet + gravity + stress_work + contact + friction + collision - boundary - opening;
    }
    /// Sum of all accounts whatever their sign, without the kinetic energy: it is where energy from nowhere shows.
    double turnover() const
    {
        return opening + std::abs(gravity) + std::abs(stress_work) + std::abs(contact) + std::abs(friction) +
               std::abs(collision) + std::abs(boundary);
    }
    /// Energy that there was for motion: sum of all accounts that gave.
    double given() const
    {
        return opening - std::min(gravity, 0.0) - std::min(stress_work, 0.0) - std::min(contact, 0.0) +
               std::max(boundary, 0.0);
    }
};

} // namespace periporo
