// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Velocity Verlet on a model, with the refresh of families, contact, constraints and the energy ledger.
#pragma once

#include "contact/contact_forces.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "time/energy_ledger.hpp"
#include "time/phases.hpp"
#include "water/arrived_energy.hpp"

#include <cstdint>
#include <vector>

namespace periporo {

struct DynamicsSettings {
    double skin = 0.0;           ///< relative displacement of a bond after which families are found anew [m]
    bool refresh_always = false; ///< find families in every step
};

/// A prescribed velocity component: that of `point` along `direction`.
struct HeldDirection {
    std::uint32_t point;
    Vector3 direction;  ///< unit vector
    double speed = 0.0; ///< [m/s]
};

struct StepOptions {
    double time_step = 0.0; ///< [s]
    MaterialResponse response = MaterialResponse::full;
    double local_damping = 0.0; ///< coefficient of the combined local damping; 0 none [-]
};

class Dynamics {
public:
    Dynamics(Model& model, const ForceState& force_state, ContactForces& contact, DynamicsSettings settings);

    /// Forces of the stress as it is, for the first half kick. To be called whenever stress, families or constraints
    /// were changed from outside.
    void start();

    /// One step. Points end with positions, velocities and forces at its end.
    /// @throws MaterialFailure
    void step(const StepOptions& options);

    /// Families anew, now: after symmetry planes came or went.
    void refresh();

    /// What is held from the next start() on.
    void hold(std::vector<HeldDirection> held) { held_ = std::move(held); }

    /// Sets all energies to zero at the present state.
    void open_ledger();
    const EnergyLedger& ledger() const { return state_.ledger; }
    /// The masses of the points changed: what came has its kinetic energy from outside, and gravity works on it from
    /// now on.
    void book(const ArrivedEnergy& arrived);

    /// What lives from step to step besides the model.
    struct State {
        EnergyLedger ledger;
        double gravity_datum = 0.0; ///< gravity energy at the opening, and of later mass where it arrived [J]
        double residual = 0.0;
        double force_scale = 0.0;            ///< that the residual is relative to [N]
        double force_squared_per_mass = 0.0; ///< sum |F|^2/m at the last evaluation [N2/kg]
        LedgerPowers powers;                 ///< at the last evaluation
        std::uint64_t refreshes = 0;
        std::vector<double> buoyancy;        ///< of each point at the last evaluation, empty: never any [N]
        std::vector<Vector3> undamped_force; ///< of each point in the last damped step since start(), or none [N]

        template <class Self, class Visit>
        static void members(Self& self, Visit& visit, std::size_t points)
        {
            visit.part("ledger", self.ledger);
            visit("gravity_datum", self.gravity_datum);
            visit("residual", self.residual);
            visit("force_scale", self.force_scale);
            visit("force_squared_per_mass", self.force_squared_per_mass);
            visit.part("powers", self.powers);
            visit("refreshes", self.refreshes);
            visit("buoyancy", empty_or(self.buoyancy, points));
            visit("undamped_force", empty_or(self.undamped_force, points));
        }
    };
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        State::members(self.state_, visit, self.model_.size());
    }

    /// |internal + contact + friction + gravity force|/|gravity force|, root sums over all points, without damping [-].
    /// Without gravity it is relative to the largest unbalanced force since start().
    double residual() const { return state_.residual; }
    /// The force that the residual is relative to, per mass, as a root mean square over the points [m/s2].
    double acceleration_scale() const;
    /// sqrt(2 E_kin/m) of the body that has most of it: what stands under a heap, however heavy, does not slow it
    /// [m/s].
    double mean_speed() const;
    std::uint64_t refreshes() const { return state_.refreshes; }
    const ContactForces& contact() const { return contact_; }

    /// Where the time of step() and refresh() went; others may add theirs.
    PhaseTimes& times() { return times_; }
    const PhaseTimes& times() const { return times_; }

private:
    /// First half kick and motion of the points.
    void drift(double time_step);
    void sum_forces(const StepOptions& options);
    /// Takes half of coefficient*|F| (sign v - sign dF/dt) from each component F of the force: combined local damping
    /// (Itasca Consulting Group, FLAC, Theory and Background, of Cundall 1987's local damping, which has 2 sign v).
    /// Both terms brake a vibration alike. Where points tremble more slowly than their body creeps, the sign of v says
    /// nothing of the tremble: damped by it alone the tremble lives on and, its force rectified, holds the creep (a
    /// cantilever twelve points thick had not come to rest after 20,000 steps, with both terms after 11,400).
    /// @param coefficient below 1, so that no force is turned round [-]
    void damp_forces(double coefficient);
    /// Second half kick and volumes.
    void kick(double time_step);
    void update_ledger(double time_step);
    void hold_velocities();
    /// Takes away the forces along held directions; returns the power of what holds the points against them [W].
    double hold_forces();
    double force_squared_per_mass() const;
    /// Powers of the forces of the last evaluation, with the velocities at hand.
    LedgerPowers ledger_powers() const;
    double kinetic_energy() const;
    double gravity_energy() const;

    Model& model_;
    const ForceState& force_state_;
    ContactForces& contact_;
    DynamicsSettings settings_;
    std::vector<HeldDirection> held_;
    double held_power_ = 0.0;     ///< at the last evaluation [W]
    double buoyancy_power_ = 0.0; ///< of the lift of standing water, mean over the last step [W]
    State state_;
    struct BodyMotion {
        double mass = 0.0;         ///< [kg]
        double twice_energy = 0.0; ///< [J]
    };
    mutable std::vector<BodyMotion> body_motion_; ///< of mean_speed(), kept for its memory
    PhaseTimes times_;
};

} // namespace periporo
